"""Reads what softgrain writes.

    import softgrain_reader as sg
    run = sg.open_run("results/default/sdem")
    run.history.plot(x="packing_fraction", y="mean_stress")

SI units in two dimensions: lengths m, forces N, stresses N/m (compression positive), energies J, times s.
"""
from .comparison import Comparison, open_comparison
from .errors import RunError
from .frames import Frame, Frames
from .run import Run, open_run

__all__ = ["Comparison", "Frame", "Frames", "Run", "RunError", "open_comparison", "open_run"]
