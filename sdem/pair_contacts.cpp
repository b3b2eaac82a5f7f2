#include "sdem/pair_contacts.hpp"

#include "sdem/geometry/polygon_reference.hpp"
#include "sdem/pair_lanes.hpp"

namespace softgrain::sdem {
namespace {

constexpr int lanes = ChordBatch::capacity;

/// One grain's side of a lane.
struct SideOfLane {
    double *axx, *axy, *ayx, *ayy, *rxx, *rxy, *ryx, *ryy, *mass, *radius, *E, *plane_E;
};

inline void put_side(const SideOfLane& to, int l, const Grain& g, const GrainMaterial& m, bool with_rates) {
    to.axx[l] = g.a * g.F.xx;
    to.axy[l] = g.b * g.F.xy;
    to.ayx[l] = g.a * g.F.yx;
    to.ayy[l] = g.b * g.F.yy;
    if (with_rates) {
        to.rxx[l] = g.a * g.F_rate.xx;
        to.rxy[l] = g.b * g.F_rate.xy;
        to.ryx[l] = g.a * g.F_rate.yx;
        to.ryy[l] = g.b * g.F_rate.yy;
    }
    to.mass[l] = g.mass;
    to.radius[l] = g.radius;
    to.E[l] = m.E;
    to.plane_E[l] = m.plane_E;
}

/// One batch in the making.
class Work {
  public:
    Work(const PairInput& in, const PairOutput& out) : in_(in), out_(out) {}

    void add(std::size_t k, double dx, double dy) {
        const auto i = static_cast<std::size_t>(in_.pair[k].i), j = static_cast<std::size_t>(in_.pair[k].j);
        const bool swapped = in_.grains.grain[i].radius < in_.grains.grain[j].radius;
        const std::size_t a = swapped ? j : i, b = swapped ? i : j;
        const Grain &ga = in_.grains.grain[a], &gb = in_.grains.grain[b];
        PairLanes& w = batch_;
        ChordBatch& c = w.chord;
        const int l = c.count++;
        w.pair[l] = k;
        w.swapped[l] = swapped;
        const double sign = swapped ? -1.0 : 1.0;
        c.dx[l] = sign * dx;
        c.dy[l] = sign * dy;
        if (in_.with_rates) {
            double vx = gb.vx - ga.vx, vy = gb.vy - ga.vy;
            if (!in_.image.empty()) {
                const Vec2 offset = in_.motion.image_velocity(in_.image[k]);
                vx += sign * offset.x();
                vy += sign * offset.y();
            }
            w.dvx[l] = vx;
            w.dvy[l] = vy;
        }
        put_side({c.a_xx, c.a_xy, c.a_yx, c.a_yy, w.a_rxx, w.a_rxy, w.a_ryx, w.a_ryy, w.mass_a, w.radius_a,
                  w.E_a, w.plane_E_a},
                 l, ga, in_.grains.material_of(a), in_.with_rates);
        put_side({c.b_xx, c.b_xy, c.b_yx, c.b_yy, w.b_rxx, w.b_rxy, w.b_ryx, w.b_ryy, w.mass_b, w.radius_b,
                  w.E_b, w.plane_E_b},
                 l, gb, in_.grains.material_of(b), in_.with_rates);
        const ChordGuess& guess = out_.guess[k];
        c.end_ax[l] = guess.ax;
        c.end_ay[l] = guess.ay;
        c.end_bx[l] = guess.bx;
        c.end_by[l] = guess.by;
        if (c.count == lanes) finish();
    }

    void finish() {
        if (batch_.chord.count == 0) return;
        if (in_.geometry == Geometry::batch)
            solve_chords(batch_.chord);
        else
            std::fill_n(batch_.chord.sound, lanes, 0.0);
        keep_touching();
        answer_lanes(batch_, in_.law, in_.with_rates, in_.contact_damping);
        for (int l = 0; l < batch_.chord.count; ++l) store(l);
        batch_.chord.count = 0;
    }

    PairNews take_news() { return std::move(news_); }

  private:
    /// Solves by the careful way what the batch could not; lanes without a contact are closed up.
    void keep_touching() {
        ChordBatch& c = batch_.chord;
        int kept = 0;
        for (int l = 0; l < c.count; ++l) {
            const std::size_t k = batch_.pair[l];
            if (c.sound[l] != 0.0) {
                out_.guess[k] = {static_cast<float>(c.end_ax[l]), static_cast<float>(c.end_ay[l]),
                                 static_cast<float>(c.end_bx[l]), static_cast<float>(c.end_by[l])};
            } else if (!solve_alone(l)) {
                out_.contact[k] = Contact{};
                continue;
            }
            if (kept != l) move_lane(l, kept);
            ++kept;
        }
        c.count = kept;
    }

    bool solve_alone(int l) {
        ChordBatch& c = batch_.chord;
        const std::size_t k = batch_.pair[l];
        const auto i = static_cast<std::size_t>(in_.pair[k].i), j = static_cast<std::size_t>(in_.pair[k].j);
        const Grain& ga = in_.grains.grain[batch_.swapped[l] ? j : i];
        const Grain& gb = in_.grains.grain[batch_.swapped[l] ? i : j];
        Ellipse a = ga.ellipse(), b = gb.ellipse();
        a.center.setZero();
        b.center = Vec2{c.dx[l], c.dy[l]};
        WarmStart warm = out_.guess[k].warm_start();
        const Chord chord = in_.geometry == Geometry::polygon ? polygon_chord(a, b) : chord_of(a, b, warm);
        out_.guess[k] = ChordGuess::of(warm);
        if (!chord.touching()) {
            if (chord.overlap != Overlap::none) report(k, chord.overlap);
            return false;
        }
        c.chord_x[l] = chord.length * chord.normal.x();
        c.chord_y[l] = chord.length * chord.normal.y();
        c.mid_x[l] = chord.point.x();
        c.mid_y[l] = chord.point.y();
        c.cap_a[l] = chord.cap_i;
        c.cap_b[l] = chord.cap_j;
        c.cover_a[l] = chord.psi_i;
        c.cover_b[l] = chord.psi_j;
        c.depth[l] = chord.depth_i + chord.depth_j;
        return true;
    }

    void move_lane(int from, int to) {
        PairLanes& w = batch_;
        ChordBatch& c = w.chord;
        w.pair[to] = w.pair[from];
        w.swapped[to] = w.swapped[from];
        for (double* array :
             {c.dx,       c.dy,      c.a_xx,    c.a_xy,      c.a_yx,     c.a_yy,   c.b_xx,   c.b_xy,
              c.b_yx,     c.b_yy,    c.chord_x, c.chord_y,   c.mid_x,    c.mid_y,  c.cap_a,  c.cap_b,
              c.cover_a,  c.cover_b, c.depth,   w.dvx,       w.dvy,      w.a_rxx,  w.a_rxy,  w.a_ryx,
              w.a_ryy,    w.b_rxx,   w.b_rxy,   w.b_ryx,     w.b_ryy,    w.mass_a, w.mass_b, w.radius_a,
              w.radius_b, w.E_a,     w.E_b,     w.plane_E_a, w.plane_E_b})
            array[to] = array[from];
    }

    void store(int l) {
        const PairLanes& w = batch_;
        const ChordBatch& c = w.chord;
        const std::size_t k = w.pair[l];
        Contact& to = out_.contact[k];
        if (!to.touching()) news_.closed.push_back(k);
        if (w.swapped[l]) {
            to.chord_x = -c.chord_x[l];
            to.chord_y = -c.chord_y[l];
            to.arm_ix = c.mid_x[l] - c.dx[l];
            to.arm_iy = c.mid_y[l] - c.dy[l];
            to.arm_jx = c.mid_x[l];
            to.arm_jy = c.mid_y[l];
            to.cap_i = c.cap_b[l];
            to.cap_j = c.cap_a[l];
            to.psi_i = static_cast<float>(c.cover_b[l]);
            to.psi_j = static_cast<float>(c.cover_a[l]);
            to.share_i = 1.0 - w.share_a[l];
        } else {
            to.chord_x = c.chord_x[l];
            to.chord_y = c.chord_y[l];
            to.arm_ix = c.mid_x[l];
            to.arm_iy = c.mid_y[l];
            to.arm_jx = c.mid_x[l] - c.dx[l];
            to.arm_jy = c.mid_y[l] - c.dy[l];
            to.cap_i = c.cap_a[l];
            to.cap_j = c.cap_b[l];
            to.psi_i = static_cast<float>(c.cover_a[l]);
            to.psi_j = static_cast<float>(c.cover_b[l]);
            to.share_i = w.share_a[l];
        }
        to.q = w.q[l];
        to.q_damping = w.q_damping[l];
        to.stiffness = static_cast<float>(w.stiffness[l]);
        to.depth = static_cast<float>(c.depth[l]);
        if (!out_.slip_rate.empty()) out_.slip_rate[k] = w.slip[l];
        if (!(w.stiffness[l] > 0.0)) report(k, Overlap::chord);
    }

    void report(std::size_t k, Overlap overlap) {
        if (k < news_.bad.pair) news_.bad = {k, overlap};
    }

    const PairInput& in_;
    const PairOutput& out_;
    PairLanes batch_;
    PairNews news_;
};

}  // namespace

PairNews evaluate_pairs(const PairInput& in, const PairOutput& out, std::size_t begin, std::size_t end) {
    Work work(in, out);
    for (std::size_t k = begin; k < end; ++k) {
        const auto i = static_cast<std::size_t>(in.pair[k].i), j = static_cast<std::size_t>(in.pair[k].j);
        const Vec2 &xi = in.grains.center[i], &xj = in.grains.center[j];
        double dx = xj.x() - xi.x(), dy = xj.y() - xi.y();
        if (!in.image.empty()) {
            const Vec2 offset = in.motion.box.image(in.image[k]);
            dx += offset.x();
            dy += offset.y();
        }
        const double reach = in.grains.reach[i] + in.grains.reach[j];
        if (dx * dx + dy * dy < reach * reach) {
            work.add(k, dx, dy);
        } else if (out.contact[k].touching()) {
            out.contact[k] = Contact{};
            out.guess[k] = ChordGuess{};
        }
    }
    work.finish();
    return work.take_news();
}

}  // namespace softgrain::sdem
