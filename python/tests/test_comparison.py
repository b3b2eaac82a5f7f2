"""Comparisons: values at equal packing fraction beside the program's own table, and errors beside sums by hand."""
import csv
import unittest

import made_runs
import numpy as np
import pandas as pd
import softgrain_reader as sg


class Comparisons(unittest.TestCase):
    def setUp(self):
        self.comparison = sg.open_comparison(made_runs.comparison())

    def test_runs_by_method(self):
        self.assertEqual(sorted(self.comparison), ["bpm", "rigid_dem", "sdem"])
        for method, run in self.comparison.items():
            self.assertEqual(run.method, method)

    def test_values_at_packing_fractions_are_those_of_the_program(self):
        self.values_beside_the_table(self.comparison, 5)

    def test_values_are_those_of_the_first_loading(self):
        comparison = sg.open_comparison(made_runs.cycle())
        steps = np.sign(np.diff(comparison["sdem"].history["packing_fraction"]))
        self.assertEqual(np.count_nonzero(np.diff(steps)), 2)
        self.values_beside_the_table(comparison, 3)

    def values_beside_the_table(self, comparison, least):
        with open(comparison.folder / "comparison.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertGreater(len(rows), least)
        self.assertEqual(len(comparison.table), len(rows))
        for row, read in zip(rows, comparison.table.to_dict("records")):
            self.assertEqual(row.pop("method"), read.pop("method"))
            self.assertEqual({k: float(v) for k, v in row.items()}, read)
        for column, tolerance in (("mean_stress", 1e-6), ("coordination_number", 1e-6)):
            found = comparison.at(sorted({float(row["packing_fraction"]) for row in rows}), column)
            self.assertEqual(int(found.notna().sum().sum()), len(rows))
            for row, read in zip(rows, comparison.table.to_dict("records")):
                value = found[read["method"]][float(row["packing_fraction"])]
                self.assertAlmostEqual(value, float(row[column]), delta=tolerance * max(1e-6, abs(value)))

    def test_values_outside_a_run_are_nan(self):
        found = self.comparison.at([0.1, 0.815])
        self.assertTrue(found.loc[0.1].isna().all())
        self.assertTrue(np.isnan(found["rigid_dem"][0.815]))
        self.assertFalse(np.isnan(found["sdem"][0.815]))
        self.assertEqual(found.attrs["units"], "N/m")
        self.assertEqual(self.comparison.at(0.8).shape, (1, 3))

    def test_initial_packing(self):
        with open(made_runs.comparison() / "initial_packing.csv") as file:
            box = file.readline().replace(",", "").split()
            rows = list(csv.DictReader(file))
        packing = self.comparison.initial_packing
        self.assertEqual(packing.to_dict("records"), [{k: float(v) for k, v in row.items()} for row in rows])
        self.assertEqual(packing.attrs["box"], (float(box[3]), float(box[6])))
        area = np.pi * np.sum(packing["r"] ** 2)
        first = self.comparison["sdem"].history.iloc[0]
        self.assertAlmostEqual(area / np.prod(packing.attrs["box"]), first["packing_fraction_undeformed"], 12)

    def test_error_of_a_curve_that_is_a_tenth_too_high(self):
        history = self.comparison["sdem"].history
        lower = history.assign(mean_stress=history["mean_stress"] / 1.1)
        self.assertAlmostEqual(self.comparison.error(lower)["error"]["sdem"], 0.1, 12)

    def test_error_beside_an_integral_by_hand(self):
        # Both curves as straight pieces between all samples of both, squares integrated exactly.
        one, other = (self.comparison[m].history for m in ("sdem", "rigid_dem"))
        for history in (one, other):
            self.assertTrue((np.diff(history["packing_fraction"]) > 0).all())
        x1, x2 = one["packing_fraction"], other["packing_fraction"]
        low, high = max(x1.iloc[0], x2.iloc[0]), min(x1.iloc[-1], x2.iloc[-1])
        x = np.unique(np.clip(np.concatenate([x1, x2]), low, high))
        y1, y2 = np.interp(x, x1, one["mean_stress"]), np.interp(x, x2, other["mean_stress"])

        def integral_of_square(y):
            return np.sum(np.diff(x) * (y[1:]**2 + y[1:] * y[:-1] + y[:-1]**2) / 3)

        expected = np.sqrt(integral_of_square(y2 - y1) / integral_of_square(y1))
        row = self.comparison.error("sdem").loc["rigid_dem"]
        self.assertAlmostEqual(row["error"] / expected, 1, 3)
        self.assertEqual((row["from"], row["to"]), (low, high))
        self.assertNotIn("sdem", self.comparison.error("sdem").index)

    def test_error_without_a_common_range_is_nan(self):
        far = pd.DataFrame({"packing_fraction": [0.1, 0.2], "mean_stress": [1.0, 2.0]})
        self.assertTrue(self.comparison.error(far)["error"].isna().all())

    def test_what_is_not_there_is_named(self):
        with self.assertRaisesRegex(sg.RunError, "holds no run of 'mpm'; there are bpm, rigid_dem, sdem"):
            self.comparison.error("mpm")
        with self.assertRaisesRegex(sg.RunError, "no column 'stress'; there are time, step"):
            self.comparison.at(0.8, "stress")
        with self.assertRaisesRegex(sg.RunError, "is one run, not a comparison; open it with open_run"):
            sg.open_comparison(made_runs.comparison() / "sdem")
        with self.assertRaisesRegex(sg.RunError, "no such folder; name the folder that softgrain compare"):
            sg.open_comparison(made_runs.folder() / "nothing")
        folder = made_runs.copy_of(made_runs.comparison(), "broken_comparison")
        (folder / "comparison.csv").unlink()
        with self.assertRaisesRegex(sg.RunError, "comparison.csv: missing; .*--resume"):
            sg.open_comparison(folder).table


if __name__ == "__main__":
    unittest.main()
