"""Opens the runs of this folder side by side in ParaView (5.11 or later).

    paraview --script=view.py                            the window, last time step first
    pvbatch view.py [--out picture.png] [--at last|0.5]  a picture; --at is a fraction of the list of frames

softgrain writes this file anew with its results: copy it under another name to keep your changes.
"""
import argparse
import csv
import json
import math
import sys
import xml.etree.ElementTree
from pathlib import Path

import numpy
from paraview import servermanager
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDataArray

# ---- What may be changed -----------------------------------------------------------------------------------
RUNS = ["."]                   # folders of runs, relative to this file
FIELD = "mean_stress"          # any cell data of grains.pvd; a vector is coloured by its magnitude
COLOUR_RANGE = None            # (least, largest); None: up to the 98th percentile of all runs
COLOURS = "Viridis (matplotlib)"  # a preset of ParaView that colour-blind readers can use
STEP_BY = "frame"              # "frame": runs side by side at the same strain; "time": at the same time [s]
FORCE_CHAINS = True            # contacts as tubes, thick where the normal force is large
WIDEST_CHAIN = 0.12            # tube diameter of the 98th percentile of all normal forces / mean grain diameter
MOST_CHAINS = 100_000          # a run with more contacts is opened with its force chains hidden
PICTURE_WIDTH = 1600           # [pixels], pvbatch only
# ------------------------------------------------------------------------------------------------------------

BLACK, GREY, WHITE = [0.0, 0.0, 0.0], [0.75, 0.75, 0.75], [1.0, 1.0, 1.0]
LOOKED_AT = 6                  # frames of each run that colours, widths and places are chosen from
BAR_SHARE = 0.13               # of the width, for the colour bar
IN_WINDOW = not sys.argv[0]    # ParaView's window gives its scripts no name


def stop(reason, exit_code):
    if IN_WINDOW:
        raise RuntimeError(reason)  # sys.exit would close ParaView
    print(reason, file=sys.stderr)
    sys.exit(exit_code)


def fraction_of_frames(text):
    share = 1.0 if text == "last" else float(text)
    if not 0.0 <= share <= 1.0:
        raise ValueError
    return share


def own_folder():
    """The folder of this file, which --script= does not tell to the script."""
    if "__file__" in globals():
        return Path(__file__).resolve().parent
    try:
        words = Path("/proc/self/cmdline").read_text().split("\0")
    except OSError:
        words = []
    for word, after in zip(words, words[1:]):
        script = after if word == "--script" else word[len("--script="):] if word.startswith("--script=") else ""
        if script:
            return Path(script).resolve().parent
    return Path.cwd()


def frames_of(pvd):
    """Times [s] and files of a .pvd."""
    sets = xml.etree.ElementTree.parse(pvd).getroot().findall("./Collection/DataSet")
    return [float(s.get("timestep")) for s in sets], [pvd.parent / s.get("file") for s in sets]


def open_series(pvd, name):
    times, files = frames_of(pvd)
    if STEP_BY == "time":
        return PVDReader(registrationName=name, FileName=str(pvd))
    return XMLPolyDataReader(registrationName=name, FileName=[str(f) for f in files], TimeArray="None")


class Run:
    def __init__(self, folder):
        self.folder = folder
        self.name = folder.name
        if (folder / "run.json").is_file():
            self.name = json.loads((folder / "run.json").read_text())["method"]
        self.times, _ = frames_of(folder / "grains.pvd")
        self.series = {part: open_series(folder / f"{part}.pvd", f"{self.name} {part}")
                       for part in ("grains", "contacts", "walls") if not missing_file(folder, part)}
        for part in ("contacts", "walls"):
            if part not in self.series:
                print(f"{self.name}: without {part}: {missing_file(folder, part)}")
        self.grains = self.series["grains"]
        self.looked_at = self.look()

    def look(self):
        """Some frames of the grains and contacts, evenly spread, and what they cover."""
        last = len(self.times) - 1
        steps = sorted({round(last * k / (LOOKED_AT - 1)) for k in range(LOOKED_AT)})
        looked_at = {"grains": [], "contacts": []}
        low, high = numpy.full(2, math.inf), numpy.full(2, -math.inf)
        for step in steps:
            for part, reader in self.series.items():
                reader.UpdatePipeline(self.times[step] if STEP_BY == "time" else float(step))
                bounds = reader.GetDataInformation().GetBounds()
                if bounds[0] <= bounds[1]:
                    low, high = numpy.minimum(low, bounds[0:4:2]), numpy.maximum(high, bounds[1:4:2])
                if part in looked_at:
                    looked_at[part].append(servermanager.Fetch(reader))
        self.centre, self.size = (low + high) / 2.0, high - low
        return looked_at

    def are_points(self):
        return self.looked_at["grains"][-1].GetNumberOfPolys() == 0

    def has(self, field):
        return bool(self.looked_at["grains"][-1].GetCellData().HasArray(field))

    def values(self, part, field):
        """Of all frames looked at; magnitudes of vectors."""
        found = [vtk_to_numpy(frame.GetCellData().GetArray(field)) for frame in self.looked_at[part]
                 if frame.GetCellData().HasArray(field)]
        return numpy.concatenate([f if f.ndim == 1 else numpy.linalg.norm(f, axis=1) for f in found] or [[]])

    def unit(self, field):
        array = self.looked_at["grains"][-1].GetCellData().GetArray(field)
        return array.GetInformation().Get(vtkDataArray.UNITS_LABEL()) or "" if array.HasInformation() else ""

    def labels(self):
        """One text for each frame: name, time and packing fraction."""
        rows = []
        if (self.folder / "history.csv").is_file():
            with open(self.folder / "history.csv", newline="") as file:
                rows = [(float(r["time"]), float(r["packing_fraction"])) for r in csv.DictReader(file)]
        texts = []
        for time in self.times:
            phi = min(rows, key=lambda row: abs(row[0] - time))[1] if rows else None
            texts.append(f"{self.name}\nt = {time:.4g} s" + (f",  phi = {phi:.3f}" if rows else ""))
        return texts


def missing_file(folder, part):
    """What stands against opening this series, or nothing."""
    pvd = folder / f"{part}.pvd"
    if not pvd.is_file():
        return f"{pvd} is missing"
    try:
        times, files = frames_of(pvd)
    except xml.etree.ElementTree.ParseError as error:
        return f"{pvd} is damaged: {error}"
    return next((f"{file} is missing" for file in files if not file.is_file()), "" if times else f"{pvd} has no frames")


def open_runs(here):
    runs = []
    for folder in RUNS:
        reason = missing_file(here / folder, "grains")
        if reason:
            print(f"skipped {folder}: {reason}")
        else:
            runs.append(Run((here / folder).resolve()))
    return runs


def percentile(values, share):
    values = values[numpy.isfinite(values)]
    return float(numpy.percentile(values, share)) if len(values) else 0.0


def colour_range(runs):
    if COLOUR_RANGE:
        return COLOUR_RANGE
    values = numpy.concatenate([run.values("grains", FIELD) for run in runs])
    low, high = min(percentile(values, 2.0), 0.0), percentile(values, 98.0)
    return (low, high) if high > low else (low, low + 1.0)


def places(runs):
    """Where the middle of each run goes [m], size of a cell, columns and rows: as large as possible on a wide screen."""
    cell = numpy.max([run.size for run in runs], axis=0) * [1.05, 1.0] + [0.0, 0.13 * max(run.size[1] for run in runs)]
    columns = max(range(1, len(runs) + 1),
                  key=lambda n: min(1.6 / (n * cell[0]), 1.0 / (math.ceil(len(runs) / n) * cell[1])))
    spots = [numpy.array([(k % columns) * cell[0], -(k // columns) * cell[1]]) for k in range(len(runs))]
    return spots, cell, columns, math.ceil(len(runs) / columns)


def unshaded(display, colour):
    display.AmbientColor = display.DiffuseColor = colour
    display.Ambient, display.Diffuse, display.Specular = 1.0, 0.0, 0.0


def show_lines(source, view, offset, width):
    display = Show(source, view)
    display.SetRepresentationType("Wireframe")
    display.ColorArrayName = ["POINTS", ""]
    unshaded(display, BLACK)
    display.LineWidth = width
    display.Position = offset


def show_grains(run, view, offset, colours, line_width):
    if run.are_points():
        source = CellDatatoPointData(registrationName=f"{run.name} points", Input=run.grains)
        display = Show(source, view)
        display.SetRepresentationType("Point Gaussian")
        display.ShaderPreset = "Plain circle"
        display.ScaleByArray, display.SetScaleArray, display.UseScaleFunction = 1, ["POINTS", "radius"], 0
        display.GaussianRadius = 1.0
    else:
        display = Show(run.grains, view)
        # Surface With Edges is not true for concave grains: it fills them as if they were convex.
        display.SetRepresentationType("Surface")
        display.Triangulate = 1
        outlines = FeatureEdges(registrationName=f"{run.name} outlines", Input=run.grains, FeatureEdges=0)
        show_lines(outlines, view, offset, line_width)
    unshaded(display, GREY)
    display.Position = offset
    if run.has(FIELD):
        ColorBy(display, ("POINTS" if run.are_points() else "CELLS", FIELD))
        display.LookupTable = colours
    else:
        display.ColorArrayName = ["POINTS", ""]
        print(f"{run.name}: has no {FIELD}; drawn grey")


def show_chains(run, view, offset, strongest, widest_radius):
    contacts = run.series["contacts"]
    too_many = max(frame.GetNumberOfCells() for frame in run.looked_at["contacts"]) > MOST_CHAINS
    at_points = CellDatatoPointData(registrationName=f"{run.name} forces", Input=contacts)
    width = Calculator(registrationName=f"{run.name} chain radius", Input=at_points, ResultArrayName="chain_radius",
                       Function=f"{widest_radius!r}*max(0.1,min(1,abs(normal_force)/{strongest!r}))")
    tubes = Tube(registrationName=f"{run.name} force chains", Input=width, Scalars=["POINTS", "chain_radius"],
                 VaryRadius="By Absolute Scalar", NumberofSides=8)
    if too_many:
        print(f"{run.name}: force chains are hidden, there are more than {MOST_CHAINS}")
        return
    display = Show(tubes, view)
    display.SetRepresentationType("Surface")
    display.ColorArrayName = ["POINTS", ""]
    unshaded(display, BLACK)
    display.Position = offset


def show_label(run, view, place, size):
    text = PythonAnnotation(registrationName=f"{run.name} label", Input=run.grains, ArrayAssociation="Field Data",
                            Expression=f"dict({list(zip(run.times, run.labels()))!r})[float(TimeValue[0])]")
    display = Show(text, view)
    display.TextPropMode = "Billboard 3D Text"
    display.BillboardPosition = place
    display.Color, display.FontSize, display.LineSpacing = BLACK, size, 1.2


def show_colour_bar(colours, unit, view, font_size):
    bar = GetScalarBar(colours, view)
    bar.Title, bar.ComponentTitle = FIELD.replace("_", " ") + (f"\n[{unit}]" if unit else ""), ""
    bar.HorizontalTitle, bar.TitleJustification, bar.AddRangeLabels = 1, "Left", 0
    bar.TitleColor = bar.LabelColor = BLACK
    bar.TitleFontSize, bar.LabelFontSize = font_size, font_size
    bar.AutoOrient, bar.Orientation = 0, "Vertical"
    bar.WindowLocation, bar.Position = "Any Location", [1.0 - BAR_SHARE + 0.02, 0.2]
    bar.ScalarBarLength, bar.ScalarBarThickness = 0.55, font_size
    bar.Visibility = 1


def main():
    arguments = argparse.ArgumentParser(description="Draws the runs of this folder with ParaView.")
    arguments.add_argument("--out", help="picture (.png); view.png beside this file if not given")
    arguments.add_argument("--at", type=fraction_of_frames, default=1.0, metavar="last|FRACTION",
                           help="last, or a fraction of the list of frames from 0 to 1")
    given = arguments.parse_args([] if IN_WINDOW else sys.argv[1:])

    here = own_folder()
    picture = Path(given.out) if given.out else here / "view.png"
    if not IN_WINDOW:
        try:
            picture.write_bytes(b"")
            picture.unlink()
        except OSError as error:
            stop(f"{picture}: cannot be written: {error.strerror}", 4)
    runs = open_runs(here)
    if not runs:
        stop(f"{here}: none of the runs {', '.join(RUNS)} can be opened", 2)
    steps = sorted({t for run in runs for t in run.times}) if STEP_BY == "time" else \
        [float(k) for k in range(max(len(run.times) for run in runs))]

    view = GetActiveViewOrCreate("RenderView")
    view.UseColorPaletteForBackground, view.Background = 0, WHITE
    view.OrientationAxesVisibility = 0
    view.UseFXAA = 1
    view.InteractionMode, view.CameraParallelProjection = "2D", 1

    spots, cell, columns, rows = places(runs)
    size = numpy.array([columns * cell[0] / (1.0 - BAR_SHARE), (rows + 0.03) * cell[1]])
    if not IN_WINDOW:
        view.ViewSize = [PICTURE_WIDTH, round(PICTURE_WIDTH * min(max(size[1] / size[0], 0.3), 1.2))]
    pixels = min(numpy.array(view.ViewSize) / size)  # in a metre
    font_size = round(min(max(0.04 * cell[1] * pixels, 10), 36))

    low, high = colour_range(runs)
    unit = next((run.unit(FIELD) for run in runs if run.has(FIELD)), "")
    colours = GetColorTransferFunction(FIELD)
    colours.ApplyPreset(COLOURS, True)
    colours.AutomaticRescaleRangeMode = "Never"

    strongest = percentile(numpy.abs(numpy.concatenate([run.values("contacts", "normal_force") for run in runs])), 98.0)
    areas = numpy.concatenate([run.values("grains", "reference_area") for run in runs])
    mean_radius = float(numpy.mean(numpy.sqrt(areas / math.pi)))
    line_width = min(max(0.03 * mean_radius * pixels, 0.5), 1.5)
    for run, spot in zip(runs, spots):
        offset = [*(spot - run.centre), 0.0]
        show_grains(run, view, offset, colours, line_width)
        if "walls" in run.series:
            show_lines(run.series["walls"], view, offset, 1.0 + line_width)
        if FORCE_CHAINS and "contacts" in run.series and strongest > 0.0:
            show_chains(run, view, offset, strongest, WIDEST_CHAIN * mean_radius)
        show_label(run, view, [spot[0] - 0.5 * run.size[0], spot[1] + 0.52 * run.size[1], 0.0], font_size)
    show_colour_bar(colours, unit, view, min(font_size, 28))

    scene = GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    scene.AnimationTime = steps[round(given.at * (len(steps) - 1))]

    Render(view)  # the first time with a camera of its own choice
    colours.RescaleTransferFunction(low, high)
    largest = max(run.size[1] for run in runs)
    middle = [(size[0] - cell[0]) / 2.0, (cell[1] * (1.97 - rows) - largest) / 2.0]
    view.CameraFocalPoint, view.CameraPosition = [*middle, 0.0], [*middle, 10.0 * max(size)]
    view.CameraViewUp = [0.0, 1.0, 0.0]
    view.CameraParallelScale = 0.5 * view.ViewSize[1] / pixels
    Render(view)
    print("runs:", ", ".join(run.name for run in runs))
    print("time steps:", len(steps))
    print(f"colour range: {low:.6g} to {high:.6g} {unit}".rstrip())
    if not IN_WINDOW:
        SaveScreenshot(str(picture), view, ImageResolution=view.ViewSize)
        if not picture.is_file():  # it does not tell of a full disk
            stop(f"{picture}: cannot be written", 4)
        print("picture:", picture)


main()
