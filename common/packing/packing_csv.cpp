#include "common/packing/packing_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/errors.hpp"
#include "common/io/atomic_file.hpp"
#include "common/neighbors.hpp"
#include "common/packing/overlap.hpp"

namespace softgrain {
namespace {

constexpr std::size_t most_discs = 1'000'000;
constexpr std::uintmax_t largest_file = std::uintmax_t{1} << 28;
constexpr std::array<std::string_view, 3> more_columns{"class", "aspect_ratio", "angle"};

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view blank = " \t\r";
    const auto first = text.find_first_not_of(blank);
    if (first == text.npos) return {};
    return text.substr(first, text.find_last_not_of(blank) - first + 1);
}

class Reader {
  public:
    Reader(const std::filesystem::path& path, const Box& box, std::size_t classes,
           std::vector<ClumpShape> clumps)
        : path_(path), box_(box), classes_(classes) {
        packing_.clumps = std::move(clumps);
    }

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
                add_grain(content);
            else
                read_header(content);
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

    void read_header(std::string_view content) {
        const std::vector<std::string_view> names = fields_of(content);
        static constexpr std::array<std::string_view, 3> first{"x", "y", "r"};
        if (names.size() < first.size() || !std::equal(first.begin(), first.end(), names.begin()))
            fail(line_, "expected the header x,y,r");
        for (std::size_t k = 0; k < names.size(); ++k) {
            if (k >= first.size() &&
                std::find(more_columns.begin(), more_columns.end(), names[k]) == more_columns.end())
                fail(line_, fmt::format("unknown column '{}', known after x,y,r are {}",
                                        names[k].substr(0, 40), fmt::join(more_columns, ", ")));
            if (column(names[k])) fail(line_, fmt::format("column '{}' stands twice", names[k]));
            columns_.emplace_back(names[k]);
        }
        if (!packing_.clumps.empty()) {
            if (!column("angle") || (classes_ > 1 && !column("class")))
                fail(line_,
                     "with grain_class.clump a column angle is needed, and class if there are several");
        } else if (column("aspect_ratio").has_value() != column("angle").has_value()) {
            fail(line_, "columns aspect_ratio and angle need each other");
        }
    }

    std::optional<std::size_t> column(std::string_view name) const {
        const auto it = std::find(columns_.begin(), columns_.end(), name);
        if (it == columns_.end()) return std::nullopt;
        return static_cast<std::size_t>(it - columns_.begin());
    }

    static std::vector<std::string_view> fields_of(std::string_view content) {
        std::vector<std::string_view> fields;
        for (std::size_t start = 0; start <= content.size();) {
            const std::size_t end = std::min(content.find(',', start), content.size());
            fields.push_back(trimmed(content.substr(start, end - start)));
            start = end + 1;
        }
        return fields;
    }

    double number(std::string_view text) const {
        double value = 0.0;
        const char* const end = text.data() + text.size();
        const bool plus = text.starts_with('+') && !text.starts_with("+-");  // from_chars knows only minus
        const auto result = std::from_chars(text.data() + (plus ? 1 : 0), end, value);
        if (result.ec != std::errc{} || result.ptr != end || !std::isfinite(value))
            fail(line_, fmt::format("'{}' is not a finite number", text.substr(0, 40)));
        return value;
    }

    void add_grain(std::string_view content) {
        std::vector<double> value;
        for (const std::string_view field : fields_of(content)) {
            if (value.size() < columns_.size())
                value.push_back(number(field));
            else
                value.push_back(0.0);  // only counted
        }
        if (value.size() != columns_.size())
            fail(line_, fmt::format("expected {} values {}, got {}", columns_.size(),
                                    fmt::join(columns_, ","), value.size()));
        const double radius = value[2];
        if (!(radius > 0.0)) fail(line_, fmt::format("r must be > 0, got {}", radius));
        if (packing_.size() == most_discs) fail(line_, fmt::format("more than {} discs", most_discs));
        packing_.center.emplace_back(value[0], value[1]);
        packing_.radius.push_back(radius);
        line_of_.push_back(line_);
        if (const auto k = column("class")) add_class(value[*k]);
        if (const auto k = column("aspect_ratio")) {
            if (!(value[*k] >= 1.0 && value[*k] <= most_elongated))
                fail(line_,
                     fmt::format("aspect_ratio must be >= 1 and <= {}, got {}", most_elongated, value[*k]));
            packing_.aspect_ratio.push_back(value[*k]);
        }
        if (const auto k = column("angle")) packing_.angle.push_back(value[*k]);
        box_.periodic ? wrap_last() : check_walls();
    }

    void add_class(double value) {
        if (!(value >= 0.0 && value < static_cast<double>(classes_) && value == std::floor(value)))
            fail(line_,
                 fmt::format("class must be a whole number from 0 to {}, the last [[grain_class]], got {}",
                             classes_ - 1, value));
        packing_.grain_class.push_back(static_cast<std::uint8_t>(value));
    }

    void wrap_last() {
        Vec2& center = packing_.center.back();
        const Image image = box_.image_of(center);
        if (std::abs(image.x) > 1 || std::abs(image.y) > 1)
            fail(line_, fmt::format("the centre lies more than a cell away from the periodic cell "
                                    "0 <= x <= {}, 0 <= y <= {}: check box.width and box.height",
                                    box_.width(), box_.height()));
        center -= box_.image(image);
    }

    void check_walls() const {
        const std::size_t g = packing_.size() - 1;
        const Mat2 shape = packing_.shape_of(g);
        const std::vector<Disc> discs = packing_.discs_of(g);
        for (int wall = 0; wall < 4; ++wall) {
            double beyond = -box_.width();
            for (const Disc& disc : discs) {
                const double reach =
                    packing_.aspect_ratio.empty() ? disc.radius : shape.row(wall_axis(wall)).norm();
                beyond = std::max(beyond, reach - box_.distance(wall, disc.center));
            }
            if (beyond > tolerated_overlap * packing_.radius[g])
                fail(line_, fmt::format("the {} reaches {:.6g} m beyond the {} wall of the box "
                                        "0 <= x <= {}, 0 <= y <= {}: check box.width and box.height",
                                        grain_word(), beyond, wall_names[static_cast<std::size_t>(wall)],
                                        box_.width(), box_.height()));
        }
    }

    std::string_view grain_word() const {
        return !packing_.clumps.empty() ? "grain" : packing_.aspect_ratio.empty() ? "disc" : "ellipse";
    }

    void check_overlaps() const {
        std::vector<double> reach;
        for (std::size_t g = 0; g < packing_.size(); ++g) reach.push_back(packing_.reach(g));
        NeighborList near;
        near.build(packing_.center, reach, 1e-3 * packing_.smallest_radius(), box_);
        for (const Pair& pair : near.pairs()) {
            const auto i = static_cast<std::size_t>(pair.i);
            const auto j = static_cast<std::size_t>(pair.j);
            const double overlap = relative_overlap(packing_, i, j);
            if (overlap > tolerated_overlap)
                fail(line_of_[j],
                     fmt::format("the {} overlaps the one of line {} by {:.3g} % of their radii, at "
                                 "most {:.3g} % is accepted",
                                 grain_word(), line_of_[i], 100.0 * overlap, 100.0 * tolerated_overlap));
        }
    }

    const std::filesystem::path& path_;
    const Box& box_;
    std::size_t classes_;
    int line_ = 0;
    std::vector<std::string> columns_;
    Packing packing_;
    std::vector<int> line_of_;
};

}  // namespace

Packing read_packing_csv(const std::filesystem::path& path, const Box& box, std::size_t classes,
                         std::vector<ClumpShape> clumps) {
    return Reader(path, box, classes, std::move(clumps)).read();
}

void write_packing_csv(const std::filesystem::path& path, const Packing& packing) {
    const bool has_classes = !packing.grain_class.empty(), has_ellipses = !packing.aspect_ratio.empty(),
               has_angles = !packing.angle.empty();
    std::string text = fmt::format("# box.width = {}, box.height = {}{}\nx,y,r{}{}{}\n", packing.box.width(),
                                   packing.box.height(), packing.box.periodic ? ", box.periodic = true" : "",
                                   has_classes ? ",class" : "", has_ellipses ? ",aspect_ratio" : "",
                                   has_angles ? ",angle" : "");
    for (std::size_t k = 0; k < packing.free_size(); ++k) {
        text += fmt::format("{},{},{}", packing.center[k].x() - packing.box.position[0],
                            packing.center[k].y() - packing.box.position[2], packing.radius[k]);
        if (has_classes) text += fmt::format(",{}", packing.grain_class[k]);
        if (has_ellipses) text += fmt::format(",{}", packing.aspect_ratio[k]);
        if (has_angles) text += fmt::format(",{}", packing.angle[k]);
        text += '\n';
    }
    write_file_atomically(path, text);
}

}  // namespace softgrain
