"""Frames beside what the program itself computed from the same grains, contacts and walls for its other files."""
import unittest

import made_runs
import numpy as np
import softgrain_reader as sg


class FramesOfRuns(unittest.TestCase):
    def frames(self):
        folders = {name: made_runs.comparison() / name for name in ("sdem", "bpm", "rigid_dem")}
        for name, folder in (folders | {"periodic": made_runs.periodic()}).items():
            run = sg.open_run(folder)
            for frame in run.frames:
                yield name, run, frame

    def test_times_and_packing_fractions_are_those_of_the_history(self):
        for _, run, frame in self.frames():
            last = len(run.history) - 1
            row = run.history.iloc[min(5 * frame.number, last)]  # sampling.frame_every
            self.assertEqual((frame.time, frame.packing_fraction), (row["time"], row["packing_fraction"]))
        self.assertEqual(run.frames.nearest(2.0).number, int(run.history["packing_fraction"].iloc[[0, 5, -1]].argmax()))

    def test_grains_beside_the_measure_of_grains(self):
        rough = {"bpm": 0.02, "sdem": 5e-3}
        for name, run, frame in self.frames():
            measured, grains = run.measures["grains"][frame.number], frame.grains
            self.assertEqual(len(grains), 30)
            self.assertEqual(grains.index.tolist(), measured["grain"].tolist())
            np.testing.assert_array_equal(grains["velocity_x"], measured["vx"])
            np.testing.assert_array_equal(grains["velocity_y"], measured["vy"])
            np.testing.assert_allclose(np.sqrt(grains["reference_area"] / np.pi), measured["radius"], rtol=1e-14)
            apart = grains[["x", "y"]].to_numpy() - measured[["x", "y"]].to_numpy()
            box = frame.history[["box_width", "box_height"]].to_numpy()
            if name == "periodic":  # drawn in the cell, which the measure is not
                apart -= box * np.round(apart / box)
            self.assertLess((np.linalg.norm(apart, axis=1) / measured["radius"]).max(), rough.get(name, 1e-13))

    def test_outlines_beside_shapes_that_the_writer_found_from_them(self):
        for _, _, frame in self.frames():
            self.assertEqual(len(frame.outlines), 30)
            for outline, grain in zip(frame.outlines, frame.grains.itertuples()):
                after = np.roll(outline, -1, axis=0)
                area = np.sum(outline[:, 0] * after[:, 1] - after[:, 0] * outline[:, 1]) / 2
                perimeter = np.sum(np.linalg.norm(after - outline, axis=1))
                self.assertAlmostEqual(4 * np.pi * area / perimeter**2, grain.circularity, 12)

    def test_the_tensor_and_its_invariants(self):
        for _, _, frame in self.frames():
            grains = frame.grains
            np.testing.assert_array_equal(grains["stress_xy"], grains["stress_yx"])
            mean = (grains["stress_xx"] + grains["stress_yy"]) / 2
            np.testing.assert_allclose(mean, grains["mean_stress"], rtol=1e-15)
            shear = np.hypot((grains["stress_xx"] - grains["stress_yy"]) / 2, grains["stress_xy"])
            np.testing.assert_allclose(shear, grains["deviatoric_stress"], rtol=1e-14, atol=1e-300)
            self.assertEqual(grains.attrs["units"]["stress_xx"], "N/m")
            self.assertEqual(grains.attrs["units"]["x"], "m")
            self.assertEqual(grains.attrs["units"]["aspect_ratio"], "")

    def test_contacts_beside_coordination_number_and_unbalanced_force(self):
        crossing = 0
        for name, _, frame in self.frames():
            contacts, grains = frame.contacts, frame.grains
            between = contacts[~contacts["is_wall"]]
            self.assertAlmostEqual(2 * len(between) / len(grains), frame.history["coordination_number"], 12)
            self.assertEqual((contacts["grain_j"] < 0).tolist(), contacts["is_wall"].tolist())
            net = np.zeros((len(grains), 2))
            forces = contacts[["force_x", "force_y"]].to_numpy()
            np.add.at(net, contacts["grain_i"], forces)
            np.add.at(net, between["grain_j"], -between[["force_x", "force_y"]].to_numpy())
            if len(contacts) and np.linalg.norm(forces, axis=1).mean() > 0:
                unbalanced = np.linalg.norm(net, axis=1).mean() / np.linalg.norm(forces, axis=1).mean()
                self.assertAlmostEqual(unbalanced / frame.history["unbalanced_force"], 1, 10)
            pushing = -np.sum(forces * contacts[["normal_x", "normal_y"]].to_numpy(), axis=1)
            np.testing.assert_allclose(pushing, contacts["normal_force"], rtol=1e-12, atol=1e-18)
            if name == "periodic":
                centres = grains[["x", "y"]].to_numpy()
                apart = centres[between["grain_j"]] - centres[between["grain_i"]]
                crossing += np.sum(np.linalg.norm(apart, axis=1) > frame.history["box_width"] / 2)
        self.assertGreater(crossing, 5)  # each of them is drawn as two lines

    def test_places_of_contacts_beside_the_love_weber_stress(self):
        for name, _, frame in self.frames():
            if name not in ("rigid_dem", "periodic"):  # whose outlines have the centres of mass
                continue
            contacts = frame.contacts
            centres, points = frame.grains[["x", "y"]].to_numpy(), contacts[["x", "y"]].to_numpy()
            box = frame.history[["box_width", "box_height"]].to_numpy()
            branch = points - centres[contacts["grain_i"]]
            self.assertLess(np.linalg.norm(branch, axis=1).max(initial=0.0), 1.4)
            between = ~contacts["is_wall"].to_numpy()
            other = centres[contacts["grain_j"][between]] - centres[contacts["grain_i"][between]]
            branch[between] = other - (box * np.round(other / box) if name == "periodic" else 0.0)
            stress = -contacts[["force_x", "force_y"]].to_numpy().T @ branch / np.prod(box)
            expected = frame.history[["love_weber_xx", "love_weber_xy", "love_weber_yy"]].to_numpy()
            found = [stress[0, 0], (stress[0, 1] + stress[1, 0]) / 2, stress[1, 1]]
            np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-12)

    def test_walls(self):
        for name, _, frame in self.frames():
            walls = frame.walls
            self.assertEqual(walls.index.tolist(), ["left", "right", "bottom", "top"])
            self.assertAlmostEqual(walls["x0"]["right"] - walls["x0"]["left"], frame.history["box_width"], 12)
            self.assertAlmostEqual(walls["y0"]["top"] - walls["y0"]["bottom"], frame.history["box_height"], 12)
            self.assertEqual(walls.attrs["periodic"], name == "periodic")
            if name == "periodic":
                continue
            wall_contacts = frame.contacts[frame.contacts["is_wall"]]
            for wall, name_of_wall in enumerate(walls.index):
                force = -wall_contacts[wall_contacts["grain_j"] == -1 - wall][["force_x", "force_y"]].sum()
                on_wall = walls.loc[name_of_wall, ["wall_force_x", "wall_force_y"]]
                np.testing.assert_allclose(force, on_wall.astype(float), rtol=1e-9, atol=1e-12)

    def test_parts_are_the_discs_of_aggregates(self):
        run = sg.open_run(made_runs.comparison() / "bpm")
        for frame in run.frames:
            counts = frame.parts["grain"].value_counts().sort_index()
            np.testing.assert_array_equal(counts, frame.grains["discs"])
            self.assertEqual(frame.parts.attrs["units"]["radius"], "m")
        with self.assertRaisesRegex(sg.RunError, "parts.pvd: missing; grains of this method have no parts"):
            sg.open_run(made_runs.comparison() / "sdem").frames[0].parts

    def test_arrays_of_several_blocks(self):
        outlines = sg.open_run(made_runs.comparison() / "bpm").frames[0].outlines
        self.assertGreater(sum(map(len, outlines)) * 24, 2 * 32768)  # VTK's blocks have 32768 bytes

    def test_without_outlines_positions_are_those_of_the_same_run_with_them(self):
        bare = sg.open_run(made_runs.bare())
        full = sg.open_run(made_runs.comparison() / "rigid_dem")
        self.assertEqual(len(bare.frames), len(full.frames))
        for one, other in zip(bare.frames, full.frames):
            np.testing.assert_allclose(one.grains[["x", "y"]], other.grains[["x", "y"]], rtol=1e-13)


if __name__ == "__main__":
    unittest.main()
