#include "common/run_state.hpp"

#include "common/errors.hpp"
#include "common/observables/observable.hpp"

namespace softgrain {
namespace {

/// Names of the columns as numbers, as a checkpoint can hold them.
std::vector<int> history_columns() {
    std::vector<int> letters;
    for (const Observable& column : observables()) {
        letters.insert(letters.end(), column.name.begin(), column.name.end());
        letters.push_back(',');
    }
    return letters;
}

}  // namespace

void RunState::save(Checkpoint& to) const {
    to.put("counters", std::vector<std::int64_t>{step, stage, checks});
    to.put("scalars", std::vector<double>{time, initial_energy, stage_time, stage_packing_fraction,
                                          packing_fraction, impulse_time, rate});
    to.put("box", std::span<const double>(box.position));
    to.put("initial_box", std::span<const double>(initial_box.position));
    to.put("stage_box", std::span<const double>(stage_box.position));
    to.put("impulse", std::span<const Vec2>(impulse));
    to.put("mean_force", std::span<const Vec2>(mean_force));
    to.put("tilt", std::vector<double>{box.tilt, initial_box.tilt, stage_box.tilt});
    to.put("periodic", std::vector<int>{box.periodic ? 1 : 0});
    to.put("cell_stress", std::vector<Mat2>{stress_impulse, mean_cell_stress});
    to.put("frame_times", frame_times);
    std::vector<double> flat;
    for (const auto& row : history) flat.insert(flat.end(), row.begin(), row.end());
    to.put("history", flat);
    to.put("state_hashes", state_hashes);
    to.put("history_columns", history_columns());
    to.put("most_strain", most_strain);
    to.put("stage_stress", std::span<const double>(stage_stress));
    servo.save(to);
    watch.save(to);
    to.put("ended", std::vector<int>(ended.begin(), ended.end()));
}

void RunState::load(const Checkpoint& from) {
    std::vector<std::int64_t> counters;
    from.get("counters", counters);
    step = counters.at(0);
    stage = static_cast<int>(counters.at(1));
    checks = counters.at(2);
    std::vector<double> values;
    from.get("scalars", values);
    time = values.at(0);
    initial_energy = values.at(1);
    stage_time = values.at(2);
    stage_packing_fraction = values.at(3);
    packing_fraction = values.at(4);
    impulse_time = values.at(5);
    rate = values.at(6);
    const auto read_box = [&](std::string_view name, Box& into) {
        from.get(name, values);
        for (std::size_t w = 0; w < 4; ++w) into.position[w] = values.at(w);
    };
    read_box("box", box);
    read_box("initial_box", initial_box);
    read_box("stage_box", stage_box);
    std::vector<Vec2> vectors;
    from.get("impulse", vectors);
    for (std::size_t w = 0; w < 4; ++w) impulse[w] = vectors.at(w);
    from.get("mean_force", vectors);
    for (std::size_t w = 0; w < 4; ++w) mean_force[w] = vectors.at(w);
    from.get("tilt", values);
    box.tilt = values.at(0);
    initial_box.tilt = values.at(1);
    stage_box.tilt = values.at(2);
    std::vector<int> flags;
    from.get("periodic", flags);
    box.periodic = initial_box.periodic = stage_box.periodic = flags.at(0) != 0;
    std::vector<Mat2> stresses;
    from.get("cell_stress", stresses);
    stress_impulse = stresses.at(0);
    mean_cell_stress = stresses.at(1);
    from.get("frame_times", frame_times);
    std::vector<int> letters;
    from.get("history_columns", letters);
    if (letters != history_columns())
        throw InputError(
            "the checkpoint is of a version with other history columns; go on with that version, or start "
            "anew with "
            "--force");
    from.get("history", values);
    const std::size_t columns = observables().size();
    history.clear();
    for (std::size_t k = 0; k + columns <= values.size(); k += columns)
        history.emplace_back(values.begin() + static_cast<std::ptrdiff_t>(k),
                             values.begin() + static_cast<std::ptrdiff_t>(k + columns));
    from.get("state_hashes", state_hashes);
    most_strain = from.number("most_strain");
    from.get("stage_stress", values);
    for (std::size_t a = 0; a < 2; ++a) stage_stress[a] = values.at(a);
    servo.load(from);
    watch.load(from);
    from.get("ended", letters);
    ended.assign(letters.begin(), letters.end());
}

}  // namespace softgrain
