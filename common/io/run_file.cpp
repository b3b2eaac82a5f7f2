#include "common/io/run_file.hpp"

#include <H5Cpp.h>
#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/io/atomic_file.hpp"
#include "common/observables/observable.hpp"

namespace softgrain {
namespace {

const H5::PredType& type_of(const double*) {
    return H5::PredType::NATIVE_DOUBLE;
}
const H5::PredType& type_of(const std::int64_t*) {
    return H5::PredType::NATIVE_INT64;
}

template <class T>
void write_array(const H5::Group& group, const std::string& name, const std::vector<T>& values) {
    const hsize_t size = values.size();
    H5::DSetCreatPropList layout;
    if (size > 0) {  // a checksum needs a chunked layout, and chunks cannot be empty
        layout.setChunk(1, &size);
        layout.setFletcher32();
    }
    const T* first = nullptr;
    const H5::DataSpace space(1, &size);
    H5::DataSet set = group.createDataSet(name, type_of(first), space, layout);
    if (size > 0) set.write(values.data(), type_of(first));
}

template <class T>
std::vector<T> read_array(const H5::DataSet& set) {
    std::vector<T> values(static_cast<std::size_t>(set.getSpace().getSimpleExtentNpoints()));
    const T* first = nullptr;
    if (!values.empty()) set.read(values.data(), type_of(first));
    return values;
}

void write_text(const H5::Group& group, const std::string& name, const std::string& text) {
    const H5::StrType type(H5::PredType::C_S1, std::max<std::size_t>(1, text.size()));
    group.createDataSet(name, type, H5::DataSpace(H5S_SCALAR)).write(text, type);
}

std::string read_text(const H5::Group& group, const std::string& name) {
    const H5::DataSet set = group.openDataSet(name);
    std::string text;
    set.read(text, set.getStrType());
    return text;
}

void write_checkpoint(const H5::Group& group, const Checkpoint& checkpoint) {
    for (const auto& [name, values] : checkpoint.numbers) write_array(group, name, values);
    for (const auto& [name, values] : checkpoint.integers) write_array(group, name, values);
}

Checkpoint read_checkpoint(const H5::Group& group) {
    Checkpoint checkpoint;
    for (hsize_t k = 0; k < group.getNumObjs(); ++k) {
        const std::string name = group.getObjnameByIdx(k);
        const H5::DataSet set = group.openDataSet(name);
        if (set.getTypeClass() == H5T_FLOAT) {
            checkpoint.numbers[name] = read_array<double>(set);
        } else {
            checkpoint.integers[name] = read_array<std::int64_t>(set);
        }
    }
    return checkpoint;
}

void write_history(const H5::Group& group, const std::vector<std::vector<double>>& rows) {
    const auto columns = observables();
    for (std::size_t c = 0; c < columns.size(); ++c) {
        std::vector<double> values;
        for (const auto& row : rows) values.push_back(row[c]);
        write_array(group, std::string(columns[c].name), values);
        if (columns[c].unit.empty()) continue;
        const H5::StrType type(H5::PredType::C_S1, columns[c].unit.size());
        group.openDataSet(std::string(columns[c].name))
            .createAttribute("unit", type, H5::DataSpace(H5S_SCALAR))
            .write(type, std::string(columns[c].unit));
    }
}

/// The file as bytes: HDF5 builds it in memory, because it cannot be trusted on a disk that is full.
std::string file_image(const RunFile& content) {
    H5::FileAccPropList in_memory;
    in_memory.setCore(1U << 20U, false);
    const H5::H5File file("run", H5F_ACC_TRUNC, H5::FileCreatPropList::DEFAULT, in_memory);
    write_text(file, "version", content.version);
    write_text(file, "method", content.method);
    write_text(file, "scenario", content.scenario);
    write_array(file, "time_spent", std::vector<double>{content.wall_time, content.cpu_time});
    write_history(file.createGroup("history"), content.state.history);
    const H5::Group checkpoint = file.createGroup("checkpoint");
    Checkpoint loop;
    content.state.save(loop);
    write_checkpoint(checkpoint.createGroup("loop"), loop);
    write_checkpoint(checkpoint.createGroup("solver"), content.solver);
    file.flush(H5F_SCOPE_GLOBAL);
    const ssize_t size = H5Fget_file_image(file.getId(), nullptr, 0);
    std::string bytes(static_cast<std::size_t>(std::max<ssize_t>(size, 0)), '\0');
    if (size < 0 || H5Fget_file_image(file.getId(), bytes.data(), bytes.size()) != size)
        throw H5::FileIException("file_image", "H5Fget_file_image failed");
    return bytes;
}

}  // namespace

void write_run_file(const std::filesystem::path& path, const RunFile& content) {
    H5::Exception::dontPrint();
    try {
        write_file_atomically(path, file_image(content));
    } catch (const H5::Exception& error) {
        throw OutputError(fmt::format("{}: cannot make it: {}", path.string(), error.getDetailMsg()));
    }
}

RunFile read_run_file(const std::filesystem::path& path) {
    H5::Exception::dontPrint();
    try {
        const H5::H5File file(path.string(), H5F_ACC_RDONLY);
        RunFile content;
        content.version = read_text(file, "version");
        content.method = read_text(file, "method");
        content.scenario = read_text(file, "scenario");
        const auto spent = read_array<double>(file.openDataSet("time_spent"));
        content.wall_time = spent.at(0);
        content.cpu_time = spent.at(1);
        const H5::Group checkpoint = file.openGroup("checkpoint");
        content.state.load(read_checkpoint(checkpoint.openGroup("loop")));
        content.solver = read_checkpoint(checkpoint.openGroup("solver"));
        return content;
    } catch (const H5::Exception& error) {
        throw InputError(fmt::format("{}: not a readable run file: {}", path.string(), error.getDetailMsg()));
    } catch (const std::out_of_range&) {
        throw InputError(fmt::format("{}: its checkpoint is incomplete", path.string()));
    }
}

}  // namespace softgrain
