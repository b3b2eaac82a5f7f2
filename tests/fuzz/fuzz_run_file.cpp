// The reader of checkpoints. Any bytes as a file: its checksum keeps HDF5 from what it did not write. And a
// loop's state whose arrays have other sizes and values, as if another program had written the file.
#include <cstring>
#include <stdexcept>

#include "common/errors.hpp"
#include "common/io/run_file.hpp"
#include "common/observables/observable.hpp"
#include "tests/fuzz/in_memory_file.hpp"

namespace {

using namespace softgrain;

void read_as_file(const std::uint8_t* data, std::size_t size) {
    const fuzz::InMemoryFile file(data, size);
    try {
        read_run_file(file.path());
        std::abort();  // 64 bits of checksum are not met by chance
    } catch (const InputError&) {
    }
}

/// `bytes`: which array, its new size, and what it is filled with.
template <class Arrays>
void change(Arrays& arrays, const std::uint8_t* bytes) {
    auto array = std::next(arrays.begin(), bytes[0] % static_cast<int>(arrays.size()));
    array->second.resize(bytes[1]);
    for (std::size_t k = 0; k < array->second.size(); k += 1 + bytes[2])
        std::memcpy(&array->second[k], bytes + 3, 8);
}

void load_changed(const std::uint8_t* data, std::size_t size) {
    RunState state;
    state.history = {std::vector<double>(observables().size(), 1.0)};
    Checkpoint checkpoint;
    state.save(checkpoint);
    constexpr std::size_t each = 12;
    for (; size >= each; data += each, size -= each)
        data[0] % 2 == 0 ? change(checkpoint.numbers, data + 1) : change(checkpoint.integers, data + 1);
    try {
        state.load(checkpoint);
        Checkpoint again;
        state.save(again);
    } catch (const InputError&) {
    } catch (const std::out_of_range&) {  // read_run_file says then that the checkpoint is incomplete
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    read_as_file(data, size);
    load_changed(data, size);
    return 0;
}
