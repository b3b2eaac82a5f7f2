"""Histories, reports, scenarios and measures: each number beside the same file read by other means."""
import csv
import json
import math
import signal
import struct
import subprocess
import time
import tomllib
import unittest

import made_runs
import softgrain_reader as sg


def bits(value: float) -> bytes:
    return b"nan" if math.isnan(value) else struct.pack("<d", value)


class FinishedRuns(unittest.TestCase):
    def runs(self):
        folders = [made_runs.periodic(), *(made_runs.comparison() / name for name in ("sdem", "bpm", "rigid_dem"))]
        for folder in folders:
            yield folder, sg.open_run(folder)

    def test_history_has_every_bit_of_the_csv(self):
        empty_values = 0
        for folder, run in self.runs():
            with open(folder / "history.csv", newline="") as file:
                rows = list(csv.DictReader(file))
            self.assertGreater(len(rows), 1)
            self.assertEqual(list(run.history), list(rows[0]))
            self.assertEqual(len(run.history), len(rows))
            for name in rows[0]:
                self.assertEqual([bits(v) for v in run.history[name]], [bits(float(row[name])) for row in rows], name)
                empty_values += sum(row[name] == "nan" for row in rows)
        self.assertGreater(empty_values, 0)

    def test_units_are_those_the_program_lists(self):
        listed = made_runs.softgrain("list").stdout.partition("History columns\n")[2].partition("\n\n")[0]
        expected = {words[0]: "" if words[1] == "-" else words[1] for words in map(str.split, listed.splitlines())}
        self.assertGreater(len(expected), 30)
        for _, run in self.runs():
            self.assertEqual(run.units, expected)
            self.assertEqual(run.history.attrs["units"], expected)

    def test_report_scenario_and_end(self):
        for folder, run in self.runs():
            report = json.loads((folder / "run.json").read_text())
            self.assertEqual(run.report, report)
            self.assertTrue(run.is_finished)
            self.assertEqual((run.method, run.ended), (report["method"], report["ended"]))
            self.assertEqual(len(run.history), report["samples"])
            self.assertEqual(run.committed_rows, report["samples"])
            self.assertEqual(len(run.frames), report["frames"])
            self.assertEqual(run.scenario, tomllib.loads((folder / "scenario.toml").read_text()))
            self.assertEqual(run.scenario["material"]["poisson_ratio"], 0.3)

    def test_measures_are_the_tables_of_each_frame(self):
        for folder, run in self.runs():
            self.assertEqual(tuple(sorted(run.measures)), made_runs.MEASURES)
            for name, tables in run.measures.items():
                self.assertEqual(len(tables), run.report["frames"])
                for frame, table in enumerate(tables):
                    with open(folder / "measures" / f"{name}_{frame:06d}.csv") as file:
                        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
                    self.assertEqual(len(table), len(rows))
                    for row, read in zip(rows, table.to_dict("records")):
                        self.assertEqual({k: float(v) for k, v in row.items()}, read)

    def test_a_run_without_measures_outlines_and_contacts_says_so(self):
        run = sg.open_run(made_runs.bare())
        self.assertEqual(dict(run.measures), {})
        with self.assertRaisesRegex(sg.RunError, "sampling.outlines = false"):
            run.frames[1].outlines
        with self.assertRaisesRegex(sg.RunError, "contacts.pvd: missing.*sampling.contacts = false"):
            run.frames[1].contacts


class UnfinishedRuns(unittest.TestCase):
    def test_a_run_that_goes_on_is_killed_and_another_one_stopped(self):
        for how, code in ((signal.SIGKILL, None), (signal.SIGINT, 130)):
            with self.subTest(how.name):
                folder = made_runs.folder() / f"live_{how.name}"
                settings = ("sampling.strain_interval=1e-6", "sampling.measures=''", "sampling.frame_every=50",
                            "rigid_dem.inertial_number=1e-5")
                process = subprocess.Popen(
                    [made_runs.EXECUTABLE, "run", str(made_runs.folder() / "scenario.toml"), "--method", "rigid_dem",
                     "--out", str(folder), "--threads", "1", *(w for s in settings for w in ("--set", s))],
                    stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
                try:
                    self.read_while_it_goes(folder, process)
                finally:
                    process.send_signal(how)
                    process.wait()
                run = sg.open_run(folder)
                self.assertFalse(run.is_finished)
                self.assertGreater(len(run.history), 100)
                self.assertEqual(len(run.frames[-1].grains), 30)
                if code:
                    self.assertEqual(run.report["exit_code"], code)
                    self.assertEqual(run.committed_rows, len(run.history))
                else:
                    self.assertEqual((run.committed_rows, run.units), (0, {}))

    def read_while_it_goes(self, folder, process):
        until = time.monotonic() + 30
        rows = 0
        while rows < 200:
            self.assertIsNone(process.poll())
            self.assertLess(time.monotonic(), until)
            try:
                run = sg.open_run(folder)
            except sg.RunError as error:  # before its first row
                self.assertEqual(rows, 0, error)
                time.sleep(0.05)
                continue
            self.assertGreaterEqual(len(run.history), rows)
            rows = len(run.history)
            self.assertFalse(run.is_finished)
            with self.assertRaisesRegex(sg.RunError, r"run.json: missing: the run goes on.*--resume"):
                run.report
            for frame in run.frames[-1:]:
                self.assertEqual(len(frame.grains), 30)


if __name__ == "__main__":
    unittest.main()
