// The scenario reader: any text is refused in good order, or read; what is read is written and read again as
// it is.
#include <cstdint>
#include <cstdlib>

#include "common/errors.hpp"
#include "common/io/scenario_file.hpp"
#include "tests/scenario/support.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace softgrain;
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    std::string written;
    try {
        written = write_scenario(parse_scenario(text, "fuzz.toml", {}, test::methods(), NamedFiles::inside),
                                 test::methods());
    } catch (const InputError&) {
        return 0;
    }
    if (write_scenario(parse_scenario(written, "again.toml", {}, test::methods()), test::methods()) !=
        written)
        std::abort();
    return 0;
}
