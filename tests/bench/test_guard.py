#!/usr/bin/env python3
"""test_guard.py BENCH_GUARD: what the guard of instruction counts lets pass and what not."""
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, sys.argv.pop(1))
import guard  # noqa: E402
from instructions import Count  # noqa: E402


def counted(instructions: int, case: str = "sdem_packing", steps: int = 10) -> dict[str, Count]:
    return {case: Count(instructions, steps, 24, 0.0, {})}


class Guard(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.counts = Path(folder.name) / "counts.csv"
        guard.write(self.counts, counted(1_000_000), "a compiler")

    def fits(self, now: dict[str, Count]) -> bool:
        return guard.compare(self.counts, now, "a compiler")

    def test_lets_three_percent_pass_and_no_more(self) -> None:
        self.assertTrue(self.fits(counted(1_029_000)))
        self.assertTrue(self.fits(counted(971_000)))
        self.assertFalse(self.fits(counted(1_031_000)))

    def test_a_gain_must_be_committed_too(self) -> None:
        self.assertFalse(self.fits(counted(969_000)))

    def test_a_case_without_a_committed_count_fails(self) -> None:
        self.assertFalse(self.fits(counted(1_000_000, "another")))

    def test_what_is_committed_has_all_cases_and_every_case_has_a_scenario(self) -> None:
        _, committed = guard.read(guard.HERE / "counts.csv")
        self.assertEqual(set(committed), set(guard.METHOD))
        for case in guard.METHOD:
            self.assertTrue((guard.HERE / f"{case}.toml").exists(), case)


if __name__ == "__main__":
    unittest.main()
