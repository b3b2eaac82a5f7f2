#include "bpm/aggregate_cache.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>

#include "common/errors.hpp"
#include "common/io/atomic_file.hpp"
#include "common/neighbors.hpp"

namespace softgrain::bpm {
namespace {

namespace fs = std::filesystem;

// First line of a file. To be changed with every change of the preparation's results or of the file.
constexpr std::string_view version = "softgrain aggregates 1\n";
constexpr std::string_view prefix = "aggregates-";

/// FNV-1a.
std::uint64_t hash_of(std::string_view bytes) {
    std::uint64_t hash = 0xCBF29CE484222325U;
    for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001B3U;
    return hash;
}

std::string description_of(std::span<const AggregateSpec> specs) {
    std::string text(version);
    for (const AggregateSpec& s : specs)
        text += fmt::format("{} {} {:a} {:a} {:a} {:a} {} {}\n", s.discs, static_cast<int>(s.sizes.law),
                            s.sizes.ratio, s.attraction_exponent, s.attraction_range, s.outline_rho, s.seed,
                            s.grain);
    return text + "\n";
}

void append(std::string& bytes, const double* numbers, std::size_t count) {
    bytes.append(reinterpret_cast<const char*>(numbers), count * sizeof(double));
}

/// Takes numbers off the front.
class Reader {
  public:
    explicit Reader(std::string_view bytes) : bytes_(bytes) {}
    void take(double* numbers, std::size_t count) {
        std::memcpy(numbers, bytes_.data(), count * sizeof(double));
        bytes_.remove_prefix(count * sizeof(double));
    }

  private:
    std::string_view bytes_;
};

constexpr std::size_t numbers_per_grain = 4, numbers_per_disc = 3;

std::string numbers_of(std::span<const Aggregate> aggregates) {
    std::string bytes;
    for (const Aggregate& a : aggregates) {
        const double head[numbers_per_grain] = {a.speed, a.overlap, a.internal_packing_fraction,
                                                static_cast<double>(a.steps)};
        append(bytes, head, numbers_per_grain);
        append(bytes, a.x.data()->data(), 2 * a.x.size());
        append(bytes, a.radius.data(), a.radius.size());
    }
    return bytes;
}

/// What a preparation ends with, checked anew.
bool is_sound(const Aggregate& a) {
    double mean_diameter = 0.0;
    for (std::size_t d = 0; d < a.x.size(); ++d) {
        if (!a.x[d].allFinite() || !(a.radius[d] > 0.0) || !(a.radius[d] <= 1.0 + 1e-9)) return false;
        if (!(a.x[d].norm() < 4.0)) return false;
        mean_diameter += 2.0 * a.radius[d] / static_cast<double>(a.x.size());
    }
    NeighborList near;
    near.build(a.x, a.radius, 1e-9);
    double overlap = 0.0;
    for (const Pair& p : near.pairs()) {
        const auto i = static_cast<std::size_t>(p.i), j = static_cast<std::size_t>(p.j);
        overlap = std::max(overlap, a.radius[i] + a.radius[j] - (a.x[j] - a.x[i]).norm());
    }
    // Its bound is in mean diameters of the size law, from which a few discs differ.
    return overlap < 2.0 * aggregate_overlap_bound * mean_diameter && a.speed < aggregate_speed_bound &&
           a.overlap < aggregate_overlap_bound && a.internal_packing_fraction > 0.0 &&
           a.internal_packing_fraction <= 1.0 + 1e-9;
}

std::optional<std::vector<Aggregate>> aggregates_in(std::string_view numbers,
                                                    std::span<const AggregateSpec> specs) {
    std::size_t expected = 0;
    for (const AggregateSpec& s : specs)
        expected += numbers_per_grain + numbers_per_disc * static_cast<std::size_t>(s.discs);
    if (numbers.size() != expected * sizeof(double)) return std::nullopt;
    Reader reader(numbers);
    std::vector<Aggregate> aggregates(specs.size());
    for (std::size_t g = 0; g < specs.size(); ++g) {
        Aggregate& a = aggregates[g];
        double head[numbers_per_grain];
        reader.take(head, numbers_per_grain);
        a.x.resize(static_cast<std::size_t>(specs[g].discs));
        a.radius.resize(a.x.size());
        reader.take(a.x.data()->data(), 2 * a.x.size());
        reader.take(a.radius.data(), a.radius.size());
        a.speed = head[0];
        a.overlap = head[1];
        a.internal_packing_fraction = head[2];
        if (!(head[3] >= 0.0 && head[3] < 1e9) || !is_sound(a)) return std::nullopt;
        a.steps = static_cast<int>(head[3]);
    }
    return aggregates;
}

}  // namespace

std::optional<fs::path> AggregateCache::file_of(std::span<const AggregateSpec> specs) const {
    long long discs = 0;
    for (const AggregateSpec& s : specs) discs += s.discs;
    if (!folder_ || discs < least_discs) return std::nullopt;
    return *folder_ / fmt::format("{}{:016x}.bin", prefix, hash_of(description_of(specs)));
}

std::optional<std::vector<Aggregate>> AggregateCache::find(std::span<const AggregateSpec> specs) const {
    const auto path = file_of(specs);
    if (!path) return std::nullopt;
    std::ifstream file(*path, std::ios::binary);
    if (!file) return std::nullopt;
    std::stringstream content;
    content << file.rdbuf();
    const std::string bytes = content.str();
    const std::string description = description_of(specs);
    constexpr std::size_t checksum_size = sizeof(std::uint64_t);
    if (bytes.size() < description.size() + checksum_size || !bytes.starts_with(description))
        return std::nullopt;
    const std::string_view guarded(bytes.data(), bytes.size() - checksum_size);
    std::uint64_t checksum = 0;
    std::memcpy(&checksum, bytes.data() + guarded.size(), checksum_size);
    if (checksum != hash_of(guarded)) return std::nullopt;
    auto aggregates = aggregates_in(guarded.substr(description.size()), specs);
    std::error_code ignored;
    if (aggregates) fs::last_write_time(*path, fs::file_time_type::clock::now(), ignored);
    return aggregates;
}

void AggregateCache::keep(std::span<const AggregateSpec> specs, std::span<const Aggregate> aggregates) const {
    const auto path = file_of(specs);
    if (!path) return;
    std::string bytes = description_of(specs) + numbers_of(aggregates);
    const std::uint64_t checksum = hash_of(bytes);
    bytes.append(reinterpret_cast<const char*>(&checksum), sizeof checksum);
    // Under a name of this process first: another may be writing the same.
    const fs::path aside = fmt::format("{}.{}", path->string(), ::getpid());
    try {
        make_directories(*folder_);
        write_file_atomically(aside, bytes);
        fs::rename(aside, *path);
        remove_oldest();
    } catch (const OutputError&) {
        return;
    } catch (const fs::filesystem_error&) {
        return;
    }
}

void AggregateCache::remove_oldest() const {
    struct File {
        fs::file_time_type used;
        fs::path path;
        std::uintmax_t size;
    };
    std::vector<File> files;
    std::uintmax_t total = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator(*folder_)) {
        if (!entry.path().filename().string().starts_with(prefix) || !entry.is_regular_file()) continue;
        files.push_back({entry.last_write_time(), entry.path(), entry.file_size()});
        total += files.back().size;
    }
    std::ranges::sort(files, {}, &File::used);
    for (const File& file : files) {
        if (total <= most_bytes) return;
        fs::remove(file.path);
        total -= file.size;
    }
}

std::optional<fs::path> cache_folder() {
    const auto given = [](const char* name) -> std::optional<std::string> {
        const char* value = std::getenv(name);
        return value == nullptr || *value == '\0' ? std::nullopt : std::optional<std::string>(value);
    };
    if (const auto own = given("SOFTGRAIN_CACHE"))
        return *own == "off" ? std::nullopt : std::optional<fs::path>(*own);
    if (const auto of_user = given("XDG_CACHE_HOME")) return fs::path(*of_user) / "softgrain";
    if (const auto home = given("HOME")) return fs::path(*home) / ".cache" / "softgrain";
    return std::nullopt;
}

}  // namespace softgrain::bpm
