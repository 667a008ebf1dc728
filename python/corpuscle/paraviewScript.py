"""The case in ParaView at all times: cells, bodies, the fluid in a plane, walls and box. Written by paraviewState (Corpuscle).

    paraview --script=postProcessing/paraviewState.py                                    or File > Load State...
    pvpython --force-offscreen-rendering postProcessing/paraviewState.py postProcessing/picture.png     without a display, the latest time
    pvpython --force-offscreen-rendering postProcessing/paraviewState.py postProcessing/picture.png 0   the first time, 1 the second, ...

It needs ParaView alone and finds the results by its own place, so that the folder of the case may be copied to another machine. Numbers are in SI
units. Particles of the fluid and of walls that are not shown at first are in the pipeline browser: click the eye beside them.
"""
import builtins  # a ProgrammableFilter puts numpy's max, min, number, ... in place of the global names of this script
import os
import sys

import paraview.simple as pv

CASE = {}  # what paraviewState has found in the case

COLOURS = [(0.84, 0.37, 0.0), (0.34, 0.71, 0.91), (0.0, 0.62, 0.45), (0.8, 0.47, 0.65), (0.94, 0.89, 0.26)]  # of Okabe and Ito
GREY, BLACK = (0.72, 0.75, 0.8), (0.0, 0.0, 0.0)
AXES = {"x": (0, 1, 2), "y": (1, 0, 2), "z": (2, 0, 1)}  # of a plane: its normal, right and up on the screen

# Moves each cell as a whole so that the mean of its nodes lies in the box. ParaView runs this where the data are.
WRAP = """
import numpy
points = numpy.array(inputs[0].Points)
if points.ndim == 2:
    ofCell = inputs[0].PointData["cell"] if "cell" in inputs[0].PointData.keys() else numpy.zeros(len(points))
    _, which = numpy.unique(numpy.asarray(ofCell), return_inverse=True)
    middle = numpy.stack([numpy.bincount(which, points[:, k]) / numpy.bincount(which) for k in range(3)], axis=1)
    size, move = numpy.array(CASE["box"]), numpy.zeros_like(middle)
    if CASE["sliding"]:  # the next image along this axis is displaced along x
        now = inputs[0].VTKObject.GetInformation().Get(inputs[0].VTKObject.DATA_TIME_STEP()) or 0
        nearest = numpy.abs(numpy.array(CASE["times"]) - now).argmin()
        axis = CASE["sliding"]["axis"]
        images = numpy.floor(middle[:, axis] / size[axis] + 0.5)
        move[:, axis] -= images * size[axis]
        move[:, 0] -= images * CASE["sliding"]["offsets"][nearest]
    for k in range(3):
        if CASE["periodic"][k]:
            move[:, k] -= size[k] * numpy.floor((middle[:, k] + move[:, k]) / size[k] + 0.5)
    output.Points = points + move[which]
"""


def folder():
    """Of the case, from the place of this script, which ParaView 5.11 started with --script does not say; its command line does on Linux."""
    scripts = [globals()["__file__"]] if "__file__" in globals() else []
    if not scripts and os.path.exists("/proc/self/cmdline"):
        with open("/proc/self/cmdline") as words:
            scripts = [word.partition("=")[2] for word in words.read().split("\0") if word.startswith("--script=")]
    places = [os.path.join(os.path.dirname(os.path.abspath(one)), CASE["folder"]) for one in scripts] + [os.getcwd(), CASE["place"]]
    for place in places:
        if os.path.exists(os.path.join(place, "results", CASE["first"] + ".pvd")):
            return os.path.normpath(place)
    raise RuntimeError("the results of the case are not there; start ParaView in the folder of the case. Looked for: " + ", ".join(places))


def results(name):
    return pv.PVDReader(registrationName=name, FileName=os.path.join(folder(), "results", name + ".pvd"))


def between(source, association, array, low, high, name):
    """The parts of `source` in which an array lies between two values."""
    chosen = pv.Threshold(registrationName=name, Input=source, Scalars=[association, array])
    if hasattr(chosen, "LowerThreshold"):
        chosen.LowerThreshold, chosen.UpperThreshold = low, high
    else:  # before ParaView 5.10
        chosen.ThresholdRange = [low, high]
    return chosen


def plain(source, view, colour):
    display = pv.Show(source, view)
    display.ColorArrayName = ["POINTS", ""]
    display.DiffuseColor = display.AmbientColor = colour
    return display


def coloured(source, view, scale, place):
    """Shows `source` in the colours of an array, with their bar at a height of the view."""
    display = pv.Show(source, view)
    separate = scale["component"] is not None  # velocity may colour cells, too, by another component
    if separate:
        display.UseSeparateColorMap = True
    pv.ColorBy(display, (scale["association"], scale["array"], *([scale["component"]] if separate else [])), separate)
    table = pv.GetColorTransferFunction(scale["array"], display, separate)
    table.AutomaticRescaleRangeMode = "Never"
    table.ApplyPreset(scale["colours"], True)
    table.RescaleTransferFunction(*scale["range"])
    bar = pv.GetScalarBar(table, view)
    bar.Title, bar.ComponentTitle = scale["title"], ""
    bar.TitleColor = bar.LabelColor = BLACK
    bar.LabelFormat = bar.RangeLabelFormat = "%-#.3g"
    bar.WindowLocation, bar.Position, bar.ScalarBarLength = "Any Location", [0.87, place], 0.33
    display.SetScalarBarVisibility(view, True)
    return display


def showSurface(name, colour, view):
    """A type of cells or a body; what is broken is left out, and the rims of holes are drawn."""
    surface = source = results(name)
    if CASE["box"] and any(CASE["periodic"]):
        surface = pv.ProgrammableFilter(registrationName=name + " in the box", Input=surface, CopyArrays=1)
        surface.Script = "CASE = %r\n" % {key: CASE[key] for key in ("box", "periodic", "times", "sliding")} + WRAP
    if name in CASE["torn"]:
        surface = between(surface, "CELLS", "broken", -0.5, 0.5, name + " without broken triangles")
        rims = pv.FeatureEdges(registrationName=name + ", rims of holes", Input=pv.ExtractSurface(Input=surface))
        rims.FeatureEdges = rims.NonManifoldEdges = 0
        plain(rims, view, BLACK).LineWidth = 3
    if name in CASE["coloured"]:
        coloured(surface, view, CASE["field"], 0.1)
    else:
        plain(surface, view, colour)
    return source


def showFluid(view):
    """A plane through the fluid, interpolated from the particles around each of its points; particles are hidden."""
    fluid, axis, at = results("fluid"), CASE["slice"]["axis"], CASE["slice"]["at"]
    particles = pv.GetDisplayProperties(fluid, view)
    particles.SetRepresentationType("Point Gaussian")
    particles.GaussianRadius = CASE["spacing"] / 2
    pv.Hide(fluid, view)
    if not CASE["fluid"]:
        return fluid
    normal, right, up = AXES[axis]
    corner = [-length / 2 for length in CASE["box"]]
    corner[normal] = at
    plane = pv.Plane(registrationName="plane", Origin=corner)
    for k, which, resolution in ((right, "Point1", "XResolution"), (up, "Point2", "YResolution")):
        end = list(corner)
        end[k] += CASE["box"][k]
        setattr(plane, which, end)
        setattr(plane, resolution, builtins.max(1, builtins.min(400, builtins.round(2 * CASE["box"][k] / CASE["spacing"]))))
    slice_ = pv.PointDatasetInterpolator(registrationName="fluid interpolated", Input=fluid, Source=plane, Kernel="GaussianKernel")
    slice_.Kernel.Radius = 2 * CASE["spacing"]
    slice_.NullPointsStrategy = "Mask Points"
    inside = between(slice_, "POINTS", "vtkValidPointMask", 0.5, 1.5, "fluid in a plane")
    display = coloured(inside, view, CASE["fluid"], 0.56)
    display.Ambient, display.Diffuse = 1.0, 0.0  # the colours of the bar, whatever the light
    return fluid


def showWalls(view):
    """Particles of the walls: of a vessel those behind the plane; of plane walls none at first."""
    walls = pv.XMLPolyDataReader(registrationName="walls", FileName=[os.path.join(folder(), "0", "walls.vtp")])
    normal = AXES[CASE["slice"]["axis"]][0]
    half = pv.Clip(registrationName="walls behind the plane", Input=walls, ClipType="Plane")
    half.ClipType.Normal = [towardsEye()[k] if k == normal else 0.0 for k in range(3)]
    half.ClipType.Origin = [CASE["slice"]["at"] if k == normal else 0.0 for k in range(3)]
    display = plain(half, view, GREY)
    display.SetRepresentationType("Point Gaussian")
    display.GaussianRadius, display.Opacity = CASE["spacing"] / 3, 0.5
    if not CASE["vessel"]:
        pv.Hide(half, view)


def towardsEye():
    """The direction from the plane to the eye, in which right, up and this one are right-handed."""
    normal = AXES[CASE["slice"]["axis"]][0]
    return [(-1.0 if normal == 1 else 1.0) if k == normal else 0.0 for k in range(3)]


def look(view, low, high):
    """A camera in front of the plane, a little above and to the left, that sees the whole of a box."""
    normal, right, up = AXES[CASE["slice"]["axis"]]
    unit = lambda k: [1.0 if j == k else 0.0 for j in range(3)]
    dot = lambda a, b: builtins.sum(x * y for x, y in zip(a, b))
    cross = lambda a, b: [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    scaled = lambda a, factor: [x * factor for x in a]
    normalised = lambda a: scaled(a, dot(a, a) ** -0.5)
    eye = normalised([a + 0.45 * b - 0.25 * c for a, b, c in zip(towardsEye(), unit(up), unit(right))])
    across = normalised(cross(unit(up), eye))
    upward = cross(eye, across)
    middle = [(a + b) / 2 for a, b in zip(low, high)]
    corners = [[(a, b)[number >> k & 1] - m for k, (a, b, m) in enumerate(zip(low, high, middle))] for number in range(8)]
    width, height = view.ViewSize
    reach = lambda direction: builtins.max(builtins.abs(dot(one, direction)) for one in corners)
    halfHeight = builtins.max(reach(upward), reach(across) * height / (0.82 * width))
    distance = 10 * builtins.max(dot(one, one) for one in corners) ** 0.5
    view.CameraParallelProjection = 1
    view.CameraParallelScale = (1.25 if CASE["vessel"] else 1.12) * halfHeight  # walls lie behind the surface of a vessel
    middle = [a + 0.08 * halfHeight * width / height * b for a, b in zip(middle, across)]  # room for the bars of colours
    view.CameraFocalPoint, view.CameraViewUp = middle, upward
    view.CameraPosition = [a + distance * b for a, b in zip(middle, eye)]


def extent(sources):
    """Of the box, or of all surfaces at the first and at the last time."""
    if CASE["box"]:
        return [-length / 2 for length in CASE["box"]], [length / 2 for length in CASE["box"]]
    bounds = []
    for time in (CASE["times"][0], CASE["times"][-1]):
        for source in sources:
            source.UpdatePipeline(time)
            bounds.append(source.GetDataInformation().GetBounds())
    return [builtins.min(one[2 * k] for one in bounds) for k in range(3)], [builtins.max(one[2 * k + 1] for one in bounds) for k in range(3)]


def open_():
    """Shows everything at the latest time; returns the view and the readers by name."""
    pv._DisableFirstRenderCameraReset()
    view = pv.GetActiveViewOrCreate("RenderView")
    if "picture" in CASE:
        view.ViewSize = [1600, 900]
    view.UseColorPaletteForBackground = 0
    view.Background = [1.0, 1.0, 1.0]
    view.OrientationAxesLabelColor = BLACK
    sources = {name: showSurface(name, COLOURS[k % len(COLOURS)], view) for k, name in enumerate(CASE["surfaces"])}
    surfaces = list(sources.values())
    if CASE["spacing"]:
        sources["fluid"] = showFluid(view)
    if CASE["walls"]:
        showWalls(view)
    if CASE["box"]:
        box = pv.Box(registrationName="box", **{key + "Length": length for key, length in zip("XYZ", CASE["box"])})
        plain(box, view, BLACK).SetRepresentationType("Outline")
    label = pv.PythonAnnotation(registrationName="time", Input=next(iter(sources.values())), Expression=CASE["label"])
    text = pv.Show(label, view)
    text.Color, text.FontSize, text.WindowLocation = BLACK, 18, "Upper Left Corner"
    look(view, *extent(surfaces))
    pv.Render(view)
    scene = pv.GetAnimationScene()  # last, since these calls wait until ParaView's welcome dialog is closed
    scene.UpdateAnimationUsingDataTimeSteps()
    scene.AnimationTime = CASE["times"][-1]
    return view, sources


def picture(path, number):
    """Draws one time without a window, and says what was read."""
    CASE["picture"] = path
    view, sources = open_()
    times = CASE["times"]
    if not -len(times) <= number < len(times):
        sys.exit("there are %d times, 0 to %d" % (len(times), len(times) - 1))
    pv.GetAnimationScene().AnimationTime = times[number]
    pv.SaveScreenshot(path, view, ImageResolution=[1600, 900])
    found = {name: source.GetDataInformation() for name, source in sources.items()}
    counts = ["%s: %d points, %d elements" % (name, one.GetNumberOfPoints(), one.GetNumberOfCells()) for name, one in found.items()]
    print("%s: t = %.9g, %s" % (path, times[number], ", ".join(counts)))


if len(sys.argv) > 1 and sys.argv[1].endswith(".png"):
    picture(sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else -1)
else:
    open_()
