// The reader of histories, golden curves and references: any bytes are refused in good order, or give a
// table.
#include "common/errors.hpp"
#include "common/io/history_csv.hpp"
#include "tests/fuzz/in_memory_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace softgrain;
    const fuzz::InMemoryFile file(data, size);
    try {
        const History history = read_history(file.path());
        for (const auto& [name, values] : history.columns)
            if (values.size() != history.rows()) std::abort();
    } catch (const InputError&) {
    }
    return 0;
}
