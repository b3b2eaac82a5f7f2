"""The figures that papers on soft grains show, from one comparison.

    PYTHONPATH=python python3 python/examples/paper_figures.py results/default figures

Cells (# %%) run one by one in editors that know them; the two folders are then those below. Each figure is written as
PDF, for the paper, and as PNG. They are the kinds of Mollon 2022 (figures 9, 10 and 12) and of Nezamabadi et al. 2017
(figures 8 to 11); docs/replicability.md and docs/bpm_replicability.md show those papers' own samples.
"""
# %% What to draw, and how
import sys
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import ListedColormap
from matplotlib.ticker import MaxNLocator

import softgrain_reader as sg

comparison_folder, figure_folder = sys.argv[1:] if len(sys.argv) == 3 else ("results/default", "figures")
comparison = sg.open_comparison(comparison_folder)
Path(figure_folder).mkdir(parents=True, exist_ok=True)

# One column of a journal; colours of Okabe and Ito, and a line of its own for each method, for grey prints.
plt.rcParams.update({"figure.figsize": (3.35, 2.6), "figure.constrained_layout.use": True, "font.size": 8,
                     "axes.linewidth": 0.6, "lines.linewidth": 1.2, "legend.frameon": False, "savefig.dpi": 300,
                     "xtick.direction": "in", "ytick.direction": "in", "pdf.fonttype": 42})
LOOK = {"sdem": ("SDEM", "#0072B2", "-", "o"), "bpm": ("BPM", "#D55E00", "--", "s"),
        "rigid_dem": ("rigid DEM", "#009E73", "-.", "^"), "mpm": ("MPM", "#000000", ":", "D")}


def line_of(method: str) -> dict:
    label, colour, line, _ = LOOK[method]
    return {"label": label, "color": colour, "linestyle": line}


def save(figure: matplotlib.figure.Figure, name: str) -> None:
    for suffix in ("pdf", "png"):
        figure.savefig(Path(figure_folder) / f"{name}.{suffix}")
    plt.close(figure)


def loaded(run: sg.Run) -> pd.DataFrame:
    """The history without what comes before the first contacts, where the stress is rounding."""
    return run.history[run.history["mean_stress"] > 1e-4 * largest_stress]


largest_stress = max(run.history["mean_stress"].max() for run in comparison.values())

# %% Mean stress over packing fraction
figure, axes = plt.subplots()
for method, run in comparison.items():
    axes.semilogy(loaded(run)["packing_fraction"], loaded(run)["mean_stress"], **line_of(method))
axes.set(xlabel=r"packing fraction $\phi$", ylabel=r"mean stress $\sigma$ [N/m]")
axes.xaxis.set_major_locator(MaxNLocator(5))
axes.legend()
save(figure, "stress")

# %% Coordination number over packing fraction
figure, axes = plt.subplots()
for method, run in comparison.items():
    axes.plot(run.history["packing_fraction"], run.history["coordination_number_no_rattlers"], **line_of(method))
axes.set(xlabel=r"packing fraction $\phi$", ylabel="$Z$, without rattlers", ylim=(0, None))
axes.xaxis.set_major_locator(MaxNLocator(5))
axes.legend()
save(figure, "coordination")

# %% Distribution of normal forces between grains: each over the mean of its frame, all loaded frames together
figure, axes = plt.subplots()
edges = np.arange(0.0, 5.01, 0.25)
for method, run in comparison.items():
    scaled = []
    for frame in run.frames:
        if frame.history["mean_stress"] < 1e-2 * run.history["mean_stress"].max():
            continue
        forces = frame.contacts.query("not is_wall and normal_force > 0")["normal_force"]
        scaled.extend(forces / forces.mean())
    counts, _ = np.histogram(scaled, edges)
    enough = counts >= 5  # the scatter of fewer is as large as their number
    density = counts[enough] / (max(len(scaled), 1) * np.diff(edges)[enough])
    axes.semilogy((edges[:-1] + edges[1:])[enough] / 2, density, marker=LOOK[method][3], markersize=3,
                  **line_of(method) | {"label": f"{LOOK[method][0]}, {len(scaled)} forces"})
axes.set(xlabel=r"normal force $f_n / \langle f_n \rangle$", ylabel="probability density", xlim=(0, None),
         ylim=(None, 1.2))
axes.legend(loc="lower left")
save(figure, "force_distribution")

# %% Stress over strain, along x and y
figure, axes = plt.subplots()
for method, run in comparison.items():
    strain = 100 * loaded(run)["axial_strain"]
    axes.semilogy(strain, loaded(run)["stress_xx"], **line_of(method))
    axes.semilogy(strain, loaded(run)["stress_yy"], **line_of(method) | {"label": None}, linewidth=0.5)
axes.set(xlabel="axial strain [%]", ylabel=r"stress [N/m], $\sigma_{xx}$ thick, $\sigma_{yy}$ thin", xlim=(0, None))
axes.legend(loc="lower right")
save(figure, "stress_strain")

# %% Grains at equal packing fraction: outlines coloured by mean stress, forces between grains as lines
# whose width is the force over the mean of its frame.
COLOURS = ListedColormap(matplotlib.colormaps["YlOrBr"](np.linspace(0.0, 0.75, 256)))  # light enough for black lines
reached = {method: run.history["packing_fraction"].max() for method, run in comparison.items()}
stages = np.unique([min(reached.values()), max(reached.values())])
figure, grid = plt.subplots(len(stages), len(comparison), squeeze=False,
                            figsize=(0.7 + 1.55 * len(comparison), 1.75 * len(stages)))
for phi, axes_row in zip(stages, grid):
    frames = {method: run.frames.nearest(phi) for method, run in comparison.items() if reached[method] > phi - 0.02}
    top_stress = np.percentile(np.concatenate([frame.grains["mean_stress"] for frame in frames.values()]), 95)
    for method, axes in zip(comparison, axes_row):
        axes.set_aspect("equal")
        axes.axis("off")
        if method not in frames:
            axes.set_title(rf"{LOOK[method][0]} ends at $\phi$ = {reached[method]:.3f}", fontsize=8)
            continue
        frame = frames[method]
        colours = axes.add_collection(
            PolyCollection(frame.outlines, array=frame.grains["mean_stress"], cmap=COLOURS, clim=(0, top_stress),
                           edgecolors="0.4", linewidths=0.3))
        walls = frame.walls[["x0", "y0", "x1", "y1"]].to_numpy().reshape(-1, 2, 2)
        forces = frame.contacts.query("not is_wall and normal_force > 0")
        centres, points = frame.grains[["x", "y"]].to_numpy(), forces[["x", "y"]].to_numpy()
        ends = centres[forces["grain_j"]]
        across = np.linalg.norm(ends - points, axis=1) > np.ptp(walls[:, :, 0]) / 2  # a periodic cell
        ends[across] = points[across]
        widths = 0.9 * forces["normal_force"] / forces["normal_force"].mean()
        axes.add_collection(LineCollection(np.stack([centres[forces["grain_i"]], points, ends], axis=1),
                                           colors="black", linewidths=widths, capstyle="round"))
        axes.add_collection(LineCollection(walls, colors="black", linewidths=0.8))
        axes.autoscale()
        axes.set_title(rf"{LOOK[method][0]}, $\phi$ = {frame.packing_fraction:.3f}", fontsize=8)
    figure.colorbar(colours, ax=axes_row, label="mean stress [N/m]", extend="both", aspect=15, pad=0.01)
save(figure, "grains")
