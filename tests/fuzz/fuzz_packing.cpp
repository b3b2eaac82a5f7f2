// The reader of packing files: any bytes are refused in good order, or give a packing whose arrays fit
// together.
#include "common/errors.hpp"
#include "common/packing/packing_csv.hpp"
#include "tests/fuzz/in_memory_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace softgrain;
    if (size == 0) return 0;
    const fuzz::InMemoryFile file(data + 1, size - 1);
    const Box box{{0.0, 50.0, 0.0, 50.0}, (data[0] & 1) != 0};
    try {
        const Packing packing = read_packing_csv(file.path(), box, 1 + data[0] % 3, {});
        const auto fits = [&](std::size_t n) { return n == 0 || n == packing.size(); };
        if (packing.size() == 0 || packing.radius.size() != packing.size() ||
            !fits(packing.grain_class.size()) || !fits(packing.aspect_ratio.size()) ||
            !fits(packing.angle.size()))
            std::abort();
    } catch (const InputError&) {
    }
    return 0;
}
