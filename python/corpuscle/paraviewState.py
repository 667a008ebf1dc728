"""A script that opens a case in ParaView, with everything that its results hold.

    corpuscle.paraviewState(corpuscle.Case("myCell"))        # writes myCell/postProcessing/paraviewState.py

The script is `paraviewScript.py` beside this file, with what is found here as its CASE; it needs ParaView alone. Ranges, times and strains come from
the heads of the result files, so that no data are read. The program `paraviewState` calls this.
"""
import difflib
import math
import os
import pathlib
import pprint
import re
import xml.etree.ElementTree

from . import results

HERE = pathlib.Path(__file__).resolve().parent
FIELDS = ("areaStrain", "tension1", "stretch")  # colours of the surfaces, the first that there is
FLUID_FIELDS = ("velocity", "pressure", "density")
COMPONENTS = {"u": "X", "v": "Y", "w": "Z", "speed": "Magnitude"}
TITLES = {"areaStrain": "area strain", "tension1": "tension T1, N/m", "tension2": "tension T2, N/m", "force": "force, N", "velocity": "speed, m/s",
          "pores": "share of pores", "concentration": "concentration, kg/m^3", "pressure": "pressure, Pa", "meanPressure": "mean pressure, Pa",
          "density": "density, kg/m^3", "speed": "speed, m/s", "u": "velocity u, m/s", "v": "velocity v, m/s", "w": "velocity w, m/s"}
DIVERGING, SEQUENTIAL = "Cool to Warm", "Viridis (matplotlib)"
LENGTHS = {"m": 1, "mm": 1e-3, "um": 1e-6, "nm": 1e-9}


class StateError(ValueError):
    """A choice that the case does not have, in a sentence for the user."""


class Stream:
    """What the heads of all files of results/NAME.pvd say: times [s], arrays {(association, name): [components, low, high]} (of vectors the
    magnitude), field data of each time."""

    def __init__(self, path):
        self.times, self.arrays, self.fields = [], {}, []
        for time, file in results.entries(path):
            pieces = [file]
            if file.suffix == ".pvtp":
                pieces = [file.parent / one.get("Source") for one in _head(file).iter("Piece")]
            heads = [_head(piece) for piece in pieces]
            self.times.append(time)
            self.fields.append({one.get("Name"): float(one.get("RangeMin")) for one in heads[0].iter("DataArray") if one.get("NumberOfTuples") == "1"} if heads else {})
            for head in heads:
                for association, tag in (("POINTS", "PointData"), ("CELLS", "CellData")):
                    for data in head.iter(tag):
                        for one in data:
                            self._add((association, one.get("Name")), int(one.get("NumberOfComponents", 1)), float(one.get("RangeMin", "nan")), float(one.get("RangeMax", "nan")))

    def _add(self, key, components, low, high):
        known = self.arrays.setdefault(key, [components, math.inf, -math.inf])
        if -1e290 < low <= high < 1e290:  # a piece without points has a range that is none
            known[1:] = min(known[1], low), max(known[2], high)

    def find(self, name):
        """(association, components, low, high) of an array, of triangles if both have it; or None."""
        for association in ("CELLS", "POINTS"):
            if (association, name) in self.arrays:
                return association, *self.arrays[association, name]
        return None


def _head(path):
    """The XML of a VTK file before its data."""
    with open(path, "rb") as file:
        text = b""
        while b"<AppendedData" not in text:
            more = file.read(16384)
            if not more:
                return xml.etree.ElementTree.fromstring(text)
            text += more
    return xml.etree.ElementTree.fromstring(text[:text.index(b"<AppendedData")] + b"</VTKFile>")


def paraviewState(case, output=None, field=None, slice_=None, fluidField=None):
    """Writes the script and returns its path.

    output      file; postProcessing/paraviewState.py of the case if none is given
    field       colours cells and bodies: an array of their results, or "none"
    slice_      the plane through the fluid: "y", "y=2 um", or "none"
    fluidField  what it shows: u, v, w, speed, or an array of the fluid
    """
    output = pathlib.Path(output) if output else case.folder / "postProcessing" / "paraviewState.py"
    if output.suffix != ".py" or output.name == "paraview.py":  # which would stand for ParaView's own package
        raise StateError(f"-output {output}: a script is written; its name ends in .py and is not paraview.py")
    if not case.streams:
        raise FileNotFoundError(f"{case.folder} has no results, which ParaView would show: run its solver first ({', '.join(case.programs)})")
    facts = _facts(case, field, slice_, fluidField)
    facts["folder"] = os.path.relpath(case.folder.resolve(), output.resolve().parent)
    facts |= {"place": str(case.folder.resolve()), "first": next(iter(facts["surfaces"]), "fluid")}
    text = (HERE / "paraviewScript.py").read_text(encoding="utf-8")
    text = re.sub(r"^CASE = \{\}.*$", lambda _: "CASE = " + pprint.pformat(facts, width=148, compact=True, sort_dicts=False), text, count=1, flags=re.M)
    output.parent.mkdir(parents=True, exist_ok=True)
    output.write_text(text, encoding="utf-8")
    return output


def _facts(case, field, slice_, fluidField):
    names = [name for name in case.streams if name not in ("walls", "holes") and not name.startswith("fault")]
    streams = {name: Stream(case.folder / "results" / f"{name}.pvd") for name in names}
    surfaces = {name: one for name, one in streams.items() if name != "fluid"}
    used = case.used if (case.folder / "used.yaml").is_file() else {}
    domain = (used.get("system/mesh.yaml") or {}).get("domain")
    flow = used.get("constant/flow.yaml") or {}
    walls = flow.get("walls")
    planes = isinstance(walls, dict) and walls.get("type", "planes") == "planes"
    fluid = streams.get("fluid") if domain else None
    longest = max(streams.values(), key=lambda one: len(one.times))
    box = [float(str(one).split()[0]) for one in domain["size"]] if domain else None
    facts = {"surfaces": list(surfaces), "torn": [name for name, one in surfaces.items() if (one.find("broken") or [0])[-1] > 0]}
    facts |= {"box": box, "periodic": domain["periodic"] if domain else [False] * 3}
    facts |= _surfaceColours(surfaces, field)
    axis = "z" if planes and walls.get("normal") == "y" else "y"
    facts["slice"] = _plane(slice_, axis, box)
    facts["spacing"] = fluid.find("spacing")[-1] if fluid else None
    facts["fluid"] = _fluidColours(fluid, fluidField, flow.get("type") in ("shear", "leesEdwards")) if fluid and slice_ != "none" else None
    facts |= {"walls": (case.folder / "0/walls.vtp").is_file(), "vessel": bool(walls) and not planes and walls != "none"}
    facts |= {"times": longest.times, "sliding": _sliding(longest), "label": _label(longest, not (case.folder / "system/control.yaml").is_file())}
    return facts


def _nearest(option, wanted, known):
    near = difflib.get_close_matches(wanted, known, 1)
    hint = f"; did you mean '{near[0]}'?" if near else ""
    return StateError(f"{option} {wanted}: the results have no such array{hint or '.'} There are {', '.join(known) or 'none'}")


def _surfaceColours(surfaces, asked):
    known = sorted({name for one in surfaces.values() for _, name in one.arrays})
    if asked and asked != "none" and asked not in known:
        raise _nearest("-field", asked, known)
    field = None if asked == "none" else asked or next((name for name in FIELDS if name in known), None)
    having = {name: one.find(field) for name, one in surfaces.items() if field and one.find(field)}
    if not having:
        return {"field": None, "coloured": []}
    association = next(iter(having.values()))[0]
    having = {name: one for name, one in having.items() if one[0] == association}
    low, high = min(one[2] for one in having.values()), max(one[3] for one in having.values())
    return {"field": _scale(field, field, association, None, low, high, field == "areaStrain"), "coloured": list(having)}


def _fluidColours(fluid, asked, sheared):
    known = sorted(name for _, name in fluid.arrays)
    words = [*(COMPONENTS if "velocity" in known else ()), *known]
    if asked and asked not in words:
        raise _nearest("-fluidField", asked, words)
    name = asked or next((one for one in FLUID_FIELDS if one in known), known[0])
    if name == "velocity":
        name = "speed" if asked or not sheared else "u"
    array = "velocity" if name in COMPONENTS else name
    association, components, low, high = fluid.find(array)
    isSigned = name in ("u", "v", "w")
    component = COMPONENTS.get(name, "Magnitude" if components > 1 else "")
    return _scale(name, array, association, component, -high if isSigned else low, high, isSigned or (name.lower().endswith("pressure") and low < 0 < high))


def _scale(name, array, association, component, low, high, aboutZero):
    if not low <= high:
        low, high = 0.0, 0.0
    if aboutZero:
        high = max(abs(low), abs(high))
        low = -high
    if high - low <= 1e-12 * max(abs(low), abs(high)):  # one colour for all
        low, high = low - (0.1 * abs(low) if low or not aboutZero else 0.01), high + (0.1 * abs(high) or 0.01)
    return {"array": array, "association": association, "component": component, "title": TITLES.get(name, name), "range": [low, high],
            "colours": DIVERGING if aboutZero else SEQUENTIAL}


def _plane(asked, axis, box):
    """Normal and place of the plane, from "y" or "y=2 um"."""
    if asked in (None, "none"):
        return {"axis": axis, "at": 0.0}
    match = re.fullmatch(r"\s*([xyz])\s*(?:=\s*([-+0-9.eE]+)\s*([a-z]*))?\s*", asked)
    try:
        at = float(match[2] or 0) * (LENGTHS[match[3]] if match[3] or float(match[2] or 0) else 1)
    except (TypeError, KeyError, ValueError):
        raise StateError(f"-slice {asked}: an axis is expected, or an axis and a position with a unit, or none (like y or 'y=2 um')") from None
    half = box["xyz".index(match[1])] / 2 if box else math.inf
    if abs(at) > half:
        raise StateError(f"-slice {asked}: the box reaches from {-half:g} to {half:g} m")
    return {"axis": match[1], "at": at}


def _sliding(stream):
    """Axis whose images slide along x, and their offsets [m] at each time; or None."""
    fields = [one for one in stream.fields if "slidingAxis" in one]
    return {"axis": int(fields[0]["slidingAxis"]), "offsets": [one.get("imageOffset", 0.0) for one in stream.fields]} if fields else None


def _label(stream, areStages):
    """The expression that ParaView evaluates for the text above the picture."""
    if areStages:
        return "'stage %g' % time_value"
    longest = max(stream.times)
    unit, factor = next(((unit, factor) for unit, factor in (("s", 1), ("ms", 1e3), ("us", 1e6)) if longest * factor >= 1 or longest == 0), ("ns", 1e9))
    strains = [one.get("strain", 0.0) for one in stream.fields]
    if not any(strains):
        return f"'t = %.4g {unit}' % ({factor:g} * time_value)"
    return f"'strain %.4g, t = %.4g {unit}' % (np.interp(time_value, {stream.times!r}, {strains!r}), {factor:g} * time_value)"
