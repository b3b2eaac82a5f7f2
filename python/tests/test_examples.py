"""The README's lines and the script of figures, as a reader would run them."""
import os
import re
import subprocess
import sys
import unittest

import made_runs

try:
    import matplotlib.image
except ImportError:
    matplotlib = None

PYTHON = made_runs.ROOT / "python"
FIGURES = ("stress", "coordination", "force_distribution", "stress_strain", "grains")


@unittest.skipIf(matplotlib is None, "needs matplotlib (Debian: python3-matplotlib)")
class Examples(unittest.TestCase):
    def test_the_lines_of_the_readme(self):
        results = made_runs.folder() / "results"
        results.mkdir()
        (results / "default").symlink_to(made_runs.comparison())
        blocks = re.findall(r"```python\n(.*?)```", (PYTHON / "README.md").read_text(), re.DOTALL)
        self.assertGreaterEqual(len(blocks), 2)
        self.python("-c", "\n".join(blocks), cwd=made_runs.folder())

    def test_the_script_of_figures(self):
        out = made_runs.folder() / "figures"
        self.python(PYTHON / "examples/paper_figures.py", made_runs.comparison(), out)
        for name in FIGURES:
            with self.subTest(name):
                self.assertGreater((out / f"{name}.pdf").stat().st_size, 1000)
                picture = matplotlib.image.imread(out / f"{name}.png")[:, :, :3]
                self.assertGreater(picture.shape[1], 900)
                if name == "grains":
                    continue
                for method, colour in {"sdem": "#0072B2", "bpm": "#D55E00", "rigid_dem": "#009E73"}.items():
                    wanted = [int(colour[k:k + 2], 16) / 255 for k in (1, 3, 5)]
                    pixels = (abs(picture - wanted).max(axis=2) < 0.02).sum()
                    self.assertGreater(pixels, 1000, method)  # its key alone has about 300

    def python(self, *arguments, cwd=None):
        environment = os.environ | {"PYTHONPATH": str(PYTHON), "MPLBACKEND": "Agg"}
        done = subprocess.run([sys.executable, "-W", "error::RuntimeWarning", *map(str, arguments)], env=environment,
                              cwd=cwd, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    unittest.main()
