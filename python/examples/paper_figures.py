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
from matplotlib.collections import LineCollection, PolyCollection

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


# %% Mean stress over packing fraction
figure, axes = plt.subplots()
largest = max(run.history["mean_stress"].max() for run in comparison.values())
for method, run in comparison.items():
    loaded = run.history[run.history["mean_stress"] > 1e-4 * largest]  # rounding before the first contact is no stress
    axes.semilogy(loaded["packing_fraction"], loaded["mean_stress"], **line_of(method))
axes.set(xlabel=r"packing fraction $\phi$", ylabel=r"mean stress $\sigma$ [N/m]")
axes.legend()
save(figure, "stress")

# %% Coordination number over packing fraction
figure, axes = plt.subplots()
for method, run in comparison.items():
    axes.plot(run.history["packing_fraction"], run.history["coordination_number_no_rattlers"], **line_of(method))
axes.set(xlabel=r"packing fraction $\phi$", ylabel="coordination number $Z$, without rattlers", ylim=(0, None))
axes.legend()
save(figure, "coordination")

# %% Distribution of normal forces, over all loaded frames: each force over the mean of its frame
figure, axes = plt.subplots()
edges = np.arange(0.0, 4.01, 0.25)
for method, run in comparison.items():
    scaled = []
    for frame in run.frames:
        between = frame.contacts[~frame.contacts["is_wall"]]
        forces = between["normal_force"][between["normal_force"] > 0]
        if frame.history["mean_stress"] > 1e-2 * run.history["mean_stress"].max() and len(forces):
            scaled.extend(forces / forces.mean())
    counts, _ = np.histogram(scaled, edges)
    density = counts / (max(len(scaled), 1) * np.diff(edges))
    seen = counts > 0
    axes.semilogy((edges[:-1] + edges[1:])[seen] / 2, density[seen], marker=LOOK[method][3], markersize=3,
                  **line_of(method))
axes.set(xlabel=r"normal force $f_n / \langle f_n \rangle$", ylabel="probability density", xlim=(0, 4))
axes.legend()
save(figure, "force_distribution")

# %% Stress over strain, along x and y
figure, axes = plt.subplots()
for method, run in comparison.items():
    strain = 100 * run.history["axial_strain"]
    axes.plot(strain, run.history["stress_xx"], **line_of(method))
    axes.plot(strain, run.history["stress_yy"], **{**line_of(method), "label": None}, alpha=0.45)
axes.set(xlabel="axial strain [%]", ylabel=r"stress [N/m]: $\sigma_{xx}$ dark, $\sigma_{yy}$ pale", xlim=(0, None))
axes.legend()
save(figure, "stress_strain")

# %% Grains at equal packing fraction: outlines coloured by mean stress, force chains on top
reached = {method: run.history["packing_fraction"].max() for method, run in comparison.items()}
stages = np.linspace(min(reached.values()), max(reached.values()), 2)
figure, grid = plt.subplots(len(stages), len(comparison), figsize=(6.9, 1.95 * len(stages)), squeeze=False)
frames = [[run.frames.nearest(phi) for run in comparison.values()] for phi in stages]
top_stress = np.percentile(np.concatenate([f.grains["mean_stress"] for row in frames for f in row]), 98)
top_force = np.percentile(np.concatenate([f.contacts["normal_force"] for row in frames for f in row]), 98)
for row, phi, axes_row in zip(frames, stages, grid):
    for frame, method, axes in zip(row, comparison, axes_row):
        walls, contacts = frame.walls, frame.contacts
        axes.set_aspect("equal")
        axes.axis("off")
        if reached[method] < phi - 0.02:
            axes.set_title(f"{LOOK[method][0]} ends at {reached[method]:.3f}", fontsize=8)
            continue
        colours = PolyCollection(frame.outlines, array=frame.grains["mean_stress"], cmap="viridis",
                                 clim=(0, top_stress), edgecolors="white", linewidths=0.3)
        axes.add_collection(colours)
        between = contacts[~contacts["is_wall"] & (contacts["normal_force"] > 0)]
        centres = frame.grains[["x", "y"]].to_numpy()
        ends = np.stack([centres[between["grain_i"]], between[["x", "y"]], centres[between["grain_j"]]], axis=1)
        axes.add_collection(LineCollection(ends, colors="black", linewidths=2.5 * between["normal_force"] / top_force))
        axes.add_collection(LineCollection(walls[["x0", "y0", "x1", "y1"]].to_numpy().reshape(-1, 2, 2),
                                           colors="black", linewidths=0.8))
        axes.autoscale()
        axes.set_title(rf"{LOOK[method][0]}, $\phi$ = {frame.packing_fraction:.3f}", fontsize=8)
figure.colorbar(colours, ax=grid, label="mean stress of a grain [N/m]", extend="both", aspect=30, pad=0.01)
save(figure, "grains")
