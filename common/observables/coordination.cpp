#include "common/observables/coordination.hpp"

#include <vector>

namespace softgrain {

Coordination coordination(const GrainView& view) {
    const auto n = view.size();
    std::vector<int> touching(n, 0);
    int grain_contacts = 0;
    int wall_contacts = 0;
    for (const GrainContact& c : view.contacts) {
        ++touching[static_cast<std::size_t>(c.i)];
        if (c.with_wall()) {
            ++wall_contacts;
        } else {
            ++touching[static_cast<std::size_t>(c.j)];
            ++grain_contacts;
        }
    }
    std::vector<bool> rattler(n, false);
    int rattlers = 0;
    for (bool found = true; found;) {
        found = false;
        for (std::size_t g = 0; g < n; ++g) {
            if (rattler[g] || touching[g] >= 2) continue;
            rattler[g] = found = true;
            ++rattlers;
            for (const GrainContact& c : view.contacts) {
                if (c.with_wall()) continue;
                const auto i = static_cast<std::size_t>(c.i);
                const auto j = static_cast<std::size_t>(c.j);
                if (i == g) --touching[j];
                if (j == g) --touching[i];
            }
        }
    }
    int carrying = 0;
    for (const GrainContact& c : view.contacts)
        if (!c.with_wall() && !rattler[static_cast<std::size_t>(c.i)] &&
            !rattler[static_cast<std::size_t>(c.j)])
            ++carrying;
    const auto count = static_cast<double>(n);
    const double left = count - rattlers;
    return {2.0 * grain_contacts / count, left > 0.0 ? 2.0 * carrying / left : 0.0,
            (2.0 * grain_contacts + wall_contacts) / count, rattlers};
}

}  // namespace softgrain
