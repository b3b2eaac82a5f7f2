"""Files that are missing, cut off or damaged: each time one line that names the file and the cure."""
import shutil
import unittest

import made_runs
import softgrain_reader as sg


class Damage(unittest.TestCase):
    def setUp(self):
        self.folder = made_runs.copy_of(made_runs.comparison() / "rigid_dem", self._testMethodName)

    def refused(self, pattern: str, read=lambda run: None):
        with self.assertRaisesRegex(sg.RunError, pattern) as caught:
            read(sg.open_run(self.folder))
        self.assertNotIn("\n", str(caught.exception))
        self.assertIn(str(self.folder), str(caught.exception))

    def cut(self, name: str, keep: int | float):
        raw = (self.folder / name).read_bytes()
        (self.folder / name).write_bytes(raw[:keep if isinstance(keep, int) else int(keep * len(raw))])

    def test_no_folder_and_no_run(self):
        shutil.rmtree(self.folder)
        self.refused("no such folder; name the folder that softgrain run")
        self.folder.mkdir()
        self.refused("history.csv: missing; this is not the folder of a run")

    def test_history_cut_within_a_row_of_a_finished_run(self):
        self.cut("history.csv", -20)
        self.refused("history.csv: its last line is cut off; softgrain run --resume")

    def test_history_that_lacks_rows(self):
        lines = (self.folder / "history.csv").read_text().splitlines(True)
        (self.folder / "history.csv").write_text("".join(lines[:-2]))
        self.refused(f"history.csv: {len(lines) - 3} rows, but run.json says {len(lines) - 1}; .*--resume")
        (self.folder / "run.json").unlink()  # now like a run that was killed
        self.refused(f"history.csv: {len(lines) - 3} rows, but run.h5 says {len(lines) - 1}; .*--resume")

    def test_the_cure_for_a_history_works(self):
        self.cut("history.csv", 0.5)
        made_runs.softgrain("run", made_runs.folder() / "scenario.toml", "--method", "rigid_dem", "--out", self.folder,
                            "--resume", "--quiet")
        restored = sg.open_run(self.folder).history
        self.assertTrue(restored.equals(sg.open_run(made_runs.comparison() / "rigid_dem").history))

    def test_a_row_being_written_is_left_out_while_the_run_goes_on(self):
        whole = sg.open_run(self.folder).history
        for name in ("run.json", "run.h5"):
            (self.folder / name).unlink()
        with open(self.folder / "history.csv", "a") as file:
            file.write("12.5,700,0.0")
        run = sg.open_run(self.folder)
        self.assertFalse(run.is_finished)
        self.assertTrue(run.history.equals(whole))
        self.assertEqual(len(run.frames), 4)

    def test_history_with_rows_of_another_length_or_words(self):
        text = (self.folder / "history.csv").read_text()
        (self.folder / "history.csv").write_text(text.replace(",nan", "", 1))
        self.refused("history.csv:2: 39 values, expected 40")
        (self.folder / "history.csv").write_text(text.replace(",nan", ",", 1))
        self.refused("history.csv: column .*: could not convert string to float: ''")
        (self.folder / "history.csv").write_text(text.replace(",nan", ",fast", 1))
        self.refused("history.csv: column .*: could not convert string to float: 'fast'")
        (self.folder / "history.csv").write_text("")
        self.refused("history.csv: it has no line of column names")

    def test_run_file_cut_or_with_a_wrong_bit(self):
        raw = (self.folder / "run.h5").read_bytes()
        for keep in (0, 7, 600, len(raw) // 2, len(raw) - 1):
            (self.folder / "run.h5").write_bytes(raw[:keep])
            self.refused("run.h5: damaged or cut off .*remove this file")
        # A bit within the numbers of the column mean_stress, which its checksum tells.
        values = sg.open_run(made_runs.comparison() / "rigid_dem").history["mean_stress"].to_numpy().tobytes()
        at = raw.index(values) + 11
        (self.folder / "run.h5").write_bytes(raw[:at] + bytes([raw[at] ^ 1]) + raw[at + 1:])
        self.refused("run.h5: damaged or cut off")
        (self.folder / "run.h5").unlink()
        self.assertEqual(sg.open_run(self.folder).units, {})

    def test_report_cut_or_incomplete(self):
        self.cut("run.json", 0.5)
        self.refused("run.json: damaged or cut off .*--resume")
        (self.folder / "run.json").write_text('{"method": "sdem"}')
        self.refused("run.json: damaged: ended, exit_code, frames, samples missing")

    def test_scenario_cut(self):
        (self.folder / "scenario.toml").write_text("[material\n")
        self.refused("scenario.toml: damaged", lambda run: run.scenario)
        (self.folder / "scenario.toml").unlink()
        self.refused("scenario.toml: cannot be read", lambda run: run.scenario)

    def test_list_of_frames_cut_short_or_missing(self):
        lines = (self.folder / "walls.pvd").read_text().splitlines(True)
        (self.folder / "walls.pvd").write_text("".join(lines[:-3] + lines[-2:]))
        self.refused("3 frames of 4 are listed", lambda run: run.frames)
        self.cut("walls.pvd", 0.7)
        self.refused("walls.pvd: damaged or cut off")
        for path in self.folder.glob("*.pvd"):
            path.unlink()
        self.refused("0 frames of 4 are listed", lambda run: run.frames)

    def fresh_frame(self) -> sg.Frame:
        """The third frame, of which nothing has been read yet."""
        return sg.Frame(self.folder, 2, self.row)

    def test_a_frame_is_cut_anywhere(self):
        self.row = sg.open_run(self.folder).frames[2].history
        for name in ("grains", "contacts", "walls"):
            path = self.folder / f"{name}/{name}_000002.vtp"
            raw = path.read_bytes()
            for keep in [*range(0, len(raw) - 1, len(raw) // 200), len(raw) - 2]:
                path.write_bytes(raw[:keep])
                with self.assertRaisesRegex(sg.RunError, f"{name}_000002.vtp: damaged or cut off .*make the run again"):
                    getattr(self.fresh_frame(), name)
            path.unlink()
            self.refused(f"{name}_000002.vtp: cannot be read", lambda run: getattr(run.frames[2], name))

    def test_a_wrong_bit_in_the_data_of_a_frame(self):
        path = self.folder / "grains/grains_000002.vtp"
        raw = path.read_bytes()
        true = sg.open_run(self.folder).frames[2]
        self.row, grains, outlines = true.history, true.grains, true.outlines
        told = 0
        positions = range(raw.index(b"<AppendedData") + 33, len(raw) - 40, 61)
        for at in positions:
            path.write_bytes(raw[:at] + bytes([raw[at] ^ 16]) + raw[at + 1:])
            read = self.fresh_frame()
            try:  # a bit that is not told must not count: of arrays that are not read
                self.assertTrue(read.grains.equals(grains), at)
                self.assertTrue(all((a == b).all() for a, b in zip(read.outlines, outlines)), at)
            except sg.RunError:
                told += 1
        self.assertGreater(told, 0.9 * len(positions))

    def test_a_frame_of_another_run(self):
        path = self.folder / "grains/grains_000002.vtp"
        path.write_bytes((self.folder / "grains/grains_000001.vtp").read_bytes())
        self.refused("grains_000002.vtp: is of another time", lambda run: run.frames[2].grains)

    def test_measures_with_a_gap_or_cut(self):
        self.cut("measures/chains_000003.csv", -3)
        self.refused("chains_000003.csv: its last line is cut off", lambda run: run.measures["chains"][3])
        (self.folder / "measures/forces_000003.csv").unlink()
        self.refused("forces_000002.csv: is the last of 3 frames of 4", lambda run: run.measures)
        (self.folder / "measures/forces_000001.csv").unlink()
        self.refused("forces_000002.csv: the frame before it is missing", lambda run: run.measures)


if __name__ == "__main__":
    unittest.main()
