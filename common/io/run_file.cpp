#include "common/io/run_file.hpp"

#include <H5Cpp.h>
#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "common/hash.hpp"
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

/// Arrays are stored as they are, so none is larger than the file: told before memory is asked for.
template <class T>
std::vector<T> read_array(const H5::DataSet& set, std::uintmax_t file_size) {
    const hssize_t size = set.getSpace().getSimpleExtentNpoints();
    if (size < 0 || static_cast<std::uintmax_t>(size) > file_size / sizeof(T))
        throw H5::DataSetIException("read_array", "an array is larger than the file");
    std::vector<T> values(static_cast<std::size_t>(size));
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

Checkpoint read_checkpoint(const H5::Group& group, std::uintmax_t file_size) {
    Checkpoint checkpoint;
    for (hsize_t k = 0; k < group.getNumObjs(); ++k) {
        const std::string name = group.getObjnameByIdx(k);
        const H5::DataSet set = group.openDataSet(name);
        if (set.getTypeClass() == H5T_FLOAT) {
            checkpoint.numbers[name] = read_array<double>(set, file_size);
        } else {
            checkpoint.integers[name] = read_array<std::int64_t>(set, file_size);
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

constexpr std::string_view head_start = "softgrain run file, format ";
constexpr std::size_t head_size = 512;  ///< a place where HDF5 looks for the begin of a file
constexpr std::string_view hdf5_start = "\x89HDF\r\n";

/// The same for every format, so that a later one is told from a damaged file.
std::string head_of(std::string_view image, std::string_view format) {
    Hash hash;
    hash.add(format);
    hash.add(image);
    std::string head = fmt::format("{}{}\n{} bytes follow this head of {}, with the checksum {:016x}\n",
                                   head_start, format, image.size(), head_size, hash.value());
    head.resize(head_size, '\0');
    return head;
}

/// The file as bytes: HDF5 builds it in memory, because it cannot be trusted on a disk that is full.
std::string file_bytes(const RunFile& content) {
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
    std::string bytes(head_size + static_cast<std::size_t>(std::max<ssize_t>(size, 0)), '\0');
    char* const image = bytes.data() + head_size;
    if (size < 0 || H5Fget_file_image(file.getId(), image, bytes.size() - head_size) != size)
        throw H5::FileIException("file_bytes", "H5Fget_file_image failed");
    bytes.replace(0, head_size, head_of({image, bytes.size() - head_size}, std::to_string(run_file_format)));
    return bytes;
}

std::string bytes_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file || !std::filesystem::is_regular_file(path))
        throw InputError(fmt::format("{}: there is no such run file", path.string()));
    std::string bytes(std::filesystem::file_size(path), '\0');
    file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!file) throw DamagedFileError(fmt::format("{}: reading stopped early", path.string()));
    return bytes;
}

/// Before HDF5 sees the file, which is not safe against files that are not its own.
void check_head(const std::filesystem::path& path) {
    const std::string bytes = bytes_of(path);
    const std::string_view whole = bytes;
    std::string format;
    if (whole.starts_with(hdf5_start)) {
        format = "1";
    } else if (whole.size() >= head_size && whole.starts_with(head_start)) {
        const std::string_view number = whole.substr(head_start.size(), head_size);
        format = number.substr(0, std::min(number.find('\n'), std::size_t{6}));
        if (head_of(whole.substr(head_size), format) != whole.substr(0, head_size)) format.clear();
    }
    if (format.empty())
        throw DamagedFileError(
            fmt::format("{}: damaged, its size or its checksum is not what was written", path.string()));
    if (format != std::to_string(run_file_format))
        throw InputError(fmt::format(
            "{}: is of format {}, this program knows {}; go on with the version of softgrain that "
            "wrote it, or start anew with --force",
            path.string(), format, run_file_format));
}

}  // namespace

void write_run_file(const std::filesystem::path& path, const RunFile& content,
                    const std::filesystem::path& old_file_to) {
    H5::Exception::dontPrint();
    try {
        write_file_atomically(path, file_bytes(content), old_file_to);
    } catch (const H5::Exception& error) {
        throw OutputError(fmt::format("{}: cannot make it: {}", path.string(), error.getDetailMsg()));
    }
}

RunFile read_run_file(const std::filesystem::path& path) {
    H5::Exception::dontPrint();
    check_head(path);
    try {
        const H5::H5File file(path.string(), H5F_ACC_RDONLY);
        const std::uintmax_t size = std::filesystem::file_size(path);
        RunFile content;
        content.version = read_text(file, "version");
        content.method = read_text(file, "method");
        content.scenario = read_text(file, "scenario");
        const auto spent = read_array<double>(file.openDataSet("time_spent"), size);
        content.wall_time = spent.at(0);
        content.cpu_time = spent.at(1);
        const H5::Group checkpoint = file.openGroup("checkpoint");
        content.state.load(read_checkpoint(checkpoint.openGroup("loop"), size));
        content.solver = read_checkpoint(checkpoint.openGroup("solver"), size);
        return content;
    } catch (const H5::Exception& error) {
        throw InputError(fmt::format("{}: not a readable run file: {}", path.string(), error.getDetailMsg()));
    } catch (const std::out_of_range&) {
        throw InputError(fmt::format("{}: its checkpoint is incomplete", path.string()));
    }
}

}  // namespace softgrain
