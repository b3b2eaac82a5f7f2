#include "common/packing/packing_csv.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <string>
#include <string_view>

#include "common/errors.hpp"
#include "common/neighbors.hpp"

namespace softgrain {
namespace {

constexpr std::size_t most_discs = 1'000'000;
constexpr std::uintmax_t largest_file = std::uintmax_t{1} << 28;

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view blank = " \t\r";
    const auto first = text.find_first_not_of(blank);
    if (first == text.npos) return {};
    return text.substr(first, text.find_last_not_of(blank) - first + 1);
}

class Reader {
  public:
    Reader(const std::filesystem::path& path, const Box& box) : path_(path), box_(box) {}

    Packing read() {
        std::ifstream file(path_);
        std::error_code status;
        if (!std::filesystem::is_regular_file(path_, status) || !file)
            throw InputError(fmt::format("{}: cannot be read as a packing file", path_.string()));
        if (std::filesystem::file_size(path_, status) > largest_file)
            throw InputError(
                fmt::format("{}: a packing file has at most {} bytes", path_.string(), largest_file));
        bool header_seen = false;
        for (std::string text; std::getline(file, text);) {
            ++line_;
            const std::string_view content = trimmed(text);
            if (content.empty() || content.front() == '#') continue;
            if (header_seen)
                add_disc(content);
            else
                check_header(content);
            header_seen = true;
        }
        if (file.bad()) fail(line_, "reading stopped early");
        if (packing_.size() == 0)
            fail(line_, "there is no disc: expected a header x,y,r and a line for each disc");
        packing_.box = box_;
        if (const double fraction = packing_.packing_fraction_undeformed(); fraction > 1.0)
            fail(line_, fmt::format("the discs have {:.4g} times the area of the box: check box.width and "
                                    "box.height",
                                    fraction));
        check_overlaps();
        return std::move(packing_);
    }

  private:
    [[noreturn]] void fail(int line, std::string_view why) const {
        throw InputError(fmt::format("{}:{}: {}", path_.string(), line, why));
    }

    void check_header(std::string_view content) const {
        std::string plain;
        for (const char c : content)
            if (c != ' ' && c != '\t') plain += c;
        if (plain != "x,y,r") fail(line_, "expected the header x,y,r");
    }

    double number(std::string_view field) const {
        const std::string_view text = trimmed(field);
        double value = 0.0;
        const char* const end = text.data() + text.size();
        const bool plus = text.starts_with('+') && !text.starts_with("+-");  // from_chars knows only minus
        const auto result = std::from_chars(text.data() + (plus ? 1 : 0), end, value);
        if (result.ec != std::errc{} || result.ptr != end || !std::isfinite(value))
            fail(line_, fmt::format("'{}' is not a finite number", text.substr(0, 40)));
        return value;
    }

    void add_disc(std::string_view content) {
        std::array<double, 3> value{};
        std::size_t fields = 0;
        for (std::size_t start = 0; start <= content.size(); ++fields) {
            const std::size_t end = std::min(content.find(',', start), content.size());
            if (fields < value.size()) value[fields] = number(content.substr(start, end - start));
            start = end + 1;
        }
        if (fields != value.size()) fail(line_, fmt::format("expected 3 values x,y,r, got {}", fields));
        const Vec2 center{value[0], value[1]};
        const double radius = value[2];
        if (!(radius > 0.0)) fail(line_, fmt::format("r must be > 0, got {}", radius));
        if (packing_.size() == most_discs) fail(line_, fmt::format("more than {} discs", most_discs));
        for (int wall = 0; wall < 4; ++wall) {
            const double beyond = radius - box_.distance(wall, center);
            if (beyond > tolerated_overlap * radius)
                fail(line_, fmt::format("the disc reaches {:.6g} m beyond the {} wall of the box "
                                        "0 <= x <= {}, 0 <= y <= {}: check box.width and box.height",
                                        beyond, wall_names[static_cast<std::size_t>(wall)], box_.width(),
                                        box_.height()));
        }
        packing_.center.push_back(center);
        packing_.radius.push_back(radius);
        line_of_.push_back(line_);
    }

    void check_overlaps() const {
        NeighborList near;
        near.build(packing_.center, packing_.radius, 1e-3 * packing_.smallest_radius());
        for (const Pair& pair : near.pairs()) {
            const auto i = static_cast<std::size_t>(pair.i);
            const auto j = static_cast<std::size_t>(pair.j);
            const double sum = packing_.radius[i] + packing_.radius[j];
            const double overlap = sum - (packing_.center[j] - packing_.center[i]).norm();
            if (overlap > tolerated_overlap * sum)
                fail(line_of_[j],
                     fmt::format("the disc overlaps the one of line {} by {:.3g} % of their radii, at "
                                 "most {:.3g} % is accepted",
                                 line_of_[i], 100.0 * overlap / sum, 100.0 * tolerated_overlap));
        }
    }

    const std::filesystem::path& path_;
    const Box& box_;
    int line_ = 0;
    Packing packing_;
    std::vector<int> line_of_;
};

}  // namespace

Packing read_packing_csv(const std::filesystem::path& path, const Box& box) {
    return Reader(path, box).read();
}

void write_packing_csv(const std::filesystem::path& path, const Packing& packing) {
    std::string text =
        fmt::format("# box.width = {}, box.height = {}\nx,y,r\n", packing.box.width(), packing.box.height());
    for (std::size_t k = 0; k < packing.size(); ++k)
        text += fmt::format("{},{},{}\n", packing.center[k].x() - packing.box.position[0],
                            packing.center[k].y() - packing.box.position[2], packing.radius[k]);
    std::ofstream file(path, std::ios::binary);
    file << text;
    file.close();
    if (!file) throw OutputError(fmt::format("{}: cannot be written", path.string()));
}

}  // namespace softgrain
