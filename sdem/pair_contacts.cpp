#include "sdem/pair_contacts.hpp"

#include "sdem/geometry/polygon_reference.hpp"
#include "sdem/pair_lanes.hpp"

namespace softgrain::sdem {
namespace {

/// True if a line is found that parts the two grains. With h(n) = |A^T n|, the half width of an ellipse along
/// n, touching ellipses fulfil d = (A A^T / h_a + B B^T / h_b) n: an iteration for the line's normal n that
/// ends at once for circles. (dx, dy) from i to j.
bool parted(const Grain& i, const Grain& j, double dx, double dy) {
    constexpr int most_tries = 5;
    constexpr double rounding = 1e-12;
    const auto square = [](const Grain& g) {
        const double xx = g.a * g.F.xx, xy = g.b * g.F.xy, yx = g.a * g.F.yx, yy = g.b * g.F.yy;
        return Tensor{xx * xx + xy * xy, xx * yx + xy * yy, xx * yx + xy * yy, yx * yx + yy * yy};
    };
    const Tensor a = square(i), b = square(j);
    double h_a = i.radius, h_b = j.radius;
    for (int k = 0; k < most_tries; ++k) {
        const Tensor sum = h_b * a + h_a * b;
        const double nx = sum.yy * dx - sum.xy * dy, ny = sum.xx * dy - sum.yx * dx;
        const auto half_width = [&](const Tensor& t) {
            return std::sqrt(nx * (t.xx * nx + t.xy * ny) + ny * (t.yx * nx + t.yy * ny));
        };
        h_a = half_width(a);
        h_b = half_width(b);
        if (nx * dx + ny * dy > (1.0 + rounding) * (h_a + h_b)) return true;
    }
    return false;
}

/// One batch of near pairs after the other.
class Work {
  public:
    Work(const PairInput& in, const PairOutput& out, PairLanes& batch) : in_(in), out_(out), batch_(batch) {
        batch_.count = 0;
        if (!many_classes())
            for (int l = 0; l < PairLanes::capacity; ++l) put_material(l, 0, 0);
    }

    void add(std::size_t k) {
        const auto i = static_cast<std::size_t>(in_.pair[k].i), j = static_cast<std::size_t>(in_.pair[k].j);
        const bool turned = in_.grains.grain[i].radius < in_.grains.grain[j].radius;
        const std::size_t a = turned ? j : i, b = turned ? i : j;
        const int l = batch_.count++;
        batch_.pair[l] = k;
        batch_.a[l] = in_.grains.grain[a];
        batch_.b[l] = in_.grains.grain[b];
        batch_.guess[l] = out_.guess[k];
        batch_.turn[l] = turned ? -1.0 : 1.0;
        if (!in_.image.empty()) {
            const Vec2 offset = batch_.turn[l] * in_.motion.box.image(in_.image[k]);
            const Vec2 velocity = batch_.turn[l] * in_.motion.image_velocity(in_.image[k]);
            batch_.offset_x[l] = offset.x();
            batch_.offset_y[l] = offset.y();
            batch_.offset_vx[l] = velocity.x();
            batch_.offset_vy[l] = velocity.y();
        }
        if (many_classes()) put_material(l, in_.grains.grain_class[a], in_.grains.grain_class[b]);
        if (batch_.count == PairLanes::capacity) finish();
    }

    void finish() {
        if (batch_.count == 0) return;
        if (in_.geometry == Geometry::batch)
            find_chords(batch_, in_.with_rates, !in_.image.empty());
        else
            skip_chords(batch_, in_.with_rates, !in_.image.empty());
        for (int l = 0; l < batch_.count; ++l)
            if (batch_.chord.sound[l] == 0.0) solve_alone(l);
        answer_lanes(batch_, in_.law, in_.with_rates, in_.contact_damping);
        for (int l = 0; l < batch_.count; ++l) {
            const std::size_t k = batch_.pair[l];
            if (batch_.contact[l].touching() && !out_.contact[k].touching()) news_.closed.push_back(k);
            out_.contact[k] = batch_.contact[l];
            out_.guess[k] = batch_.guess[l];
            if (!(batch_.stiffness[l] > 0.0)) report(k, Overlap::chord);
        }
        if (!out_.opening.empty())
            for (int l = 0; l < batch_.count; ++l) out_.opening[batch_.pair[l]] = batch_.opening[l];
        if (!out_.slip_rate.empty())
            for (int l = 0; l < batch_.count; ++l) out_.slip_rate[batch_.pair[l]] = batch_.slip[l];
        batch_.count = 0;
    }

    PairNews take_news() { return std::move(news_); }

  private:
    bool many_classes() const { return !in_.grains.grain_class.empty(); }

    void put_material(int l, std::size_t a, std::size_t b) {
        batch_.E_a[l] = in_.grains.material[a].E;
        batch_.E_b[l] = in_.grains.material[b].E;
    }

    /// The careful way, for a lane that the batch could not solve.
    void solve_alone(int l) {
        ChordBatch& c = batch_.chord;
        Ellipse a = ellipse_of(batch_.a[l]), b = ellipse_of(batch_.b[l]);
        a.center.setZero();
        b.center = Vec2{c.dx[l], c.dy[l]};
        WarmStart warm{Vec2{c.end_ax[l], c.end_ay[l]}, Vec2{c.end_bx[l], c.end_by[l]}};
        const Chord chord = in_.geometry == Geometry::polygon ? polygon_chord(a, b) : chord_of(a, b, warm);
        c.end_ax[l] = warm.a.x();
        c.end_ay[l] = warm.a.y();
        c.end_bx[l] = warm.b.x();
        c.end_by[l] = warm.b.y();
        if (!chord.touching()) {
            if (chord.overlap != Overlap::none) report(batch_.pair[l], chord.overlap);
            return;
        }
        c.sound[l] = 1.0;
        c.chord_x[l] = chord.length * chord.normal.x();
        c.chord_y[l] = chord.length * chord.normal.y();
        c.mid_x[l] = chord.point.x();
        c.mid_y[l] = chord.point.y();
        c.cap_a[l] = chord.cap_i;
        c.cap_b[l] = chord.cap_j;
        c.cover_a[l] = chord.psi_i;
        c.cover_b[l] = chord.psi_j;
        c.depth[l] = chord.depth_i + chord.depth_j;
    }

    void report(std::size_t k, Overlap overlap) {
        if (k < news_.bad.pair) news_.bad = {k, overlap};
    }

    const PairInput& in_;
    const PairOutput& out_;
    PairLanes& batch_;
    PairNews news_;
};

/// Asks for the second grain of pair k, which lies elsewhere in memory than the first.
SOFTGRAIN_INLINE void fetch_ahead(const PairInput& in, std::size_t k) {
    if (k >= in.pair.size()) return;
    const auto j = static_cast<std::size_t>(in.pair[k].j);
    const auto* grain = reinterpret_cast<const char*>(&in.grains.grain[j]);
    __builtin_prefetch(grain);
    __builtin_prefetch(grain + 64);
    __builtin_prefetch(&in.grains.center[j]);
    __builtin_prefetch(&in.grains.reach[j]);
}

}  // namespace

PairNews evaluate_pairs(const PairInput& in, const PairOutput& out, std::size_t begin, std::size_t end) {
    static thread_local PairLanes lanes;
    Work work(in, out, lanes);
    const bool periodic = !in.image.empty();
    for (std::size_t k = begin; k < end; ++k) {
        fetch_ahead(in, k + 16);
        const auto i = static_cast<std::size_t>(in.pair[k].i), j = static_cast<std::size_t>(in.pair[k].j);
        const Vec2 &xi = in.grains.center[i], &xj = in.grains.center[j];
        double dx = xj.x() - xi.x(), dy = xj.y() - xi.y();
        if (periodic) {
            const Vec2 offset = in.motion.box.image(in.image[k]);
            dx += offset.x();
            dy += offset.y();
        }
        const double reach = in.grains.reach[i] + in.grains.reach[j];
        const bool near = dx * dx + dy * dy < reach * reach, touching = out.contact[k].touching();
        if (near && (touching || !parted(in.grains.grain[i], in.grains.grain[j], dx, dy))) {
            work.add(k);
        } else if (touching) {
            out.contact[k] = Contact{};
            out.guess[k] = ChordGuess{};
            if (!out.opening.empty()) out.opening[k] = Opening{};
            if (!out.slip_rate.empty()) out.slip_rate[k] = 0.0;
        }
    }
    work.finish();
    return work.take_news();
}

}  // namespace softgrain::sdem
