#include "bpm/attraction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "common/errors.hpp"

namespace softgrain::bpm {
namespace {

constexpr std::size_t discs_worth_threads = 1000;

void check(const AttractionLaw& law, double skin) {
    if (!(law.exponent >= least_exponent && law.exponent <= largest_exponent))
        throw InputError(fmt::format("attraction: the exponent must be {} to {}, got {}", least_exponent,
                                     largest_exponent, law.exponent));
    if (!(law.range >= least_range && law.range <= largest_range))
        throw InputError(fmt::format("attraction: the range must be {} to {} a0, got {}", least_range,
                                     largest_range, law.range));
    if (!(law.maximum_force > 0.0) || !(skin > 0.0))
        throw InputError("attraction: the largest force and the skin must be > 0");
}

}  // namespace

Attraction::Attraction(const AttractionLaw& law, std::vector<int> grain_start, std::span<const double> radius,
                       double skin)
    : law_(law),
      grain_start_(std::move(grain_start)),
      skin_(skin),
      radius_(radius.begin(), radius.end()),
      grains_(grain_start_.size() - 1),
      lost_(grains_.size(), 0),
      energy_(radius.size(), 0.0) {
    check(law, skin);
}

void Attraction::forces(std::span<const Vec2> x, double time, std::span<Vec2> force, bool gathered,
                        bool threads) {
    const bool first = built_at_.empty();
    if (first) built_at_.assign(x.begin(), x.end());
    int lost = -1, rebuilt = 0;
#pragma omp parallel for schedule(static) if (threads && x.size() > discs_worth_threads) \
    reduction(max : lost) reduction(+ : rebuilt)
    for (std::size_t g = 0; g < grains_.size(); ++g) {
        DiscStripes& grain = grains_[g];
        const std::span<const Vec2> here = own(x, g);
        if (!first) grain.move_to(here);
        if (first || !(4.0 * grain.largest_square_move() < skin_ * skin_)) {
            std::copy(here.begin(), here.end(), built_at_.begin() + grain_start_[g]);
            rebuild(g);
            ++rebuilt;
            if (gathered) lost_[g] = grain.lost_discs();
            if (lost_[g] > most_lost * static_cast<double>(here.size()))
                lost = std::max(lost, static_cast<int>(g));
        }
        attract(law_, grain.discs(), own(force, g).data()->data());
    }
    rebuilds_ += rebuilt;
    if (lost >= 0)
        throw DivergedError(
            lost, "disc position", time,
            fmt::format("{} of its discs are out of reach of all others; load more slowly, use a "
                        "smaller bpm.step or a larger bpm.attraction_range",
                        lost_[static_cast<std::size_t>(lost)]));
}

double Attraction::energy(std::span<const Vec2> x) {
    if (built_at_.empty()) return 0.0;
#pragma omp parallel for schedule(static) if (x.size() > discs_worth_threads)
    for (std::size_t g = 0; g < grains_.size(); ++g) {
        grains_[g].move_to(own(x, g));
        find_potentials(law_, grains_[g].discs(), own(std::span<double>(energy_), g).data());
    }
    return std::accumulate(energy_.begin(), energy_.end(), 0.0);
}

void Attraction::rebuild(std::size_t grain) {
    grains_[grain].build(own(std::span<const Vec2>(built_at_), grain),
                         own(std::span<const double>(radius_), grain), law_.cut_off(), skin_);
}

void Attraction::save(Checkpoint& to, const std::string& prefix) const {
    to.put(prefix + "built_at", std::span<const Vec2>(built_at_));
}

void Attraction::load(const Checkpoint& from, const std::string& prefix) {
    from.get(prefix + "built_at", built_at_);
    if (built_at_.empty()) return;
    if (built_at_.size() != radius_.size())
        throw InputError("checkpoint: the attraction lists are for another number of discs");
    for (std::size_t g = 0; g < grains_.size(); ++g) {
        rebuild(g);
        lost_[g] = grains_[g].lost_discs();
    }
}

}  // namespace softgrain::bpm
