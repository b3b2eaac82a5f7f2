// Texts that are not TOML must give a message with a place, never an abort.
#include <gtest/gtest.h>

#include <random>

#include "tests/scenario/support.hpp"

namespace softgrain::test {
namespace {

TEST(Malformed, MessageNamesThePlace) {
    const std::vector<std::pair<std::string, std::string>> cases{
        {"[\n", "s.toml:1:1: not valid TOML: expected a table's name after '['"},
        {"a = 1\n[[x]]\n [\nb = 2\n[y]\n", "s.toml:3:2: not valid TOML: expected a table's name after '['"},
        {"title = \"a\"\n[[\n", "s.toml:2:1: not valid TOML: expected a table's name after '['"},
        {"[material]\ndensity = 1\ndensity = 2\n",
         "s.toml:3:11: not valid TOML: cannot redefine existing integer 'density'"},
        {"[material]\n[material]\n", "s.toml:2:1: not valid TOML: cannot redefine existing table 'material'"},
        {"title = \n", "s.toml:1:9: not valid TOML: expected value, saw '\\n'"},
        {"title\n", "s.toml:1:6: not valid TOML: expected '=', saw '\\n'"},
        {"title = \"\xFF\"\n", "s.toml:1:10: not UTF-8 text"},
        {"a = 1\n# \xC3\xA9\xE2\x82\n", "s.toml:2:4: not UTF-8 text"},
        {"# \xED\xA0\x80\n", "s.toml:1:3: not UTF-8 text"},
        {"# \xC0\xAF\n", "s.toml:1:3: not UTF-8 text"},
        {" \xCF\x98\n",
         "s.toml:1:2: not valid TOML: expected keys, tables, whitespace or comments, saw '\xCF\x98'"},
        {std::string("a = 1\n#").append(2000, '-'), "s.toml:2:2001: a line has at most 2000 bytes"},
        {std::string((1U << 20U) + 1, '\n'), "s.toml: a scenario has at most 1048576 bytes"},
    };
    for (const auto& [text, message] : cases) EXPECT_EQ(error_of(text), message) << text.substr(0, 60);
}

TEST(Malformed, EveryMessageHasAPlace) {
    for (const std::string text :
         {"[a", "a = [1", "a = {b = ", "a = \"x", "= 1", "a = 1 2", "a.b.c = 1979-13-40", "[a]]",
          "a = 99999999999999999999", "\x01", "a = '''", "a = 0x", "[a.]"}) {
        const std::string message = error_of(text);
        EXPECT_TRUE(message.starts_with("s.toml:1:")) << text << " gave " << message;
    }
}

TEST(Malformed, DeepNestingIsRefusedWithoutUsingUpTheStack) {
    EXPECT_NE(error_of(std::string("a = ").append(1900, '[')), "");
    // The deepest document that the limits on lines and on nesting let through.
    std::string text;
    const auto dotted = [] {
        std::string key = "a";
        for (int k = 0; k < 950; ++k) key += ".a";
        return key;
    };
    for (const std::string& part :
         {std::string("["), dotted(), std::string("]\n"), dotted(), std::string(" = [\n{"), dotted(),
          std::string(" = [\n{"), dotted(), std::string(" = 1}]}]\n")})
        text += part;
    EXPECT_NE(error_of(text), "");
}

TEST(Malformed, RandomDamageNeverAborts) {
    const std::string good =
        "title = \"a\"\n[material]\ndensity = 1.5e0 # note\n[packing]\nsize_law = 'single'\n"
        "[[loading]]\nkind = \"hold\"\nduration = 0x10\n[sampling]\noutlines = true\n[spring]\nlaw = "
        "\"hertz\"\n";
    ASSERT_EQ(error_of(good), "");
    const std::string bytes = "[]{}=\"'.,#\n\\ a0-+_:TZe\t\r\x7F\xC3\xA9";
    std::mt19937_64 random(7);
    const auto below = [&](std::size_t limit) { return static_cast<std::size_t>(random() % limit); };
    int refused = 0;
    for (int k = 0; k < 3000; ++k) {
        std::string text = good;
        for (std::size_t damage = 1 + below(4); damage > 0; --damage) {
            const std::size_t at = below(text.size());
            if (below(3) == 0)
                text.erase(at, 1 + below(5));
            else
                text.insert(at, 1, bytes[below(bytes.size())]);
        }
        if (const std::string message = error_of(text); !message.empty()) {
            ++refused;
            EXPECT_TRUE(message.starts_with("s.toml:")) << message;
        }
    }
    EXPECT_GT(refused, 1500);
}

}  // namespace
}  // namespace softgrain::test
