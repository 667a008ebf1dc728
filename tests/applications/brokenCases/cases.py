"""Faults of a case, and the problems that checkCase must report for them.

A case: name, edits of the base case, the problems expected in the order of their files, extra arguments, exit code. A problem: file and
key, the text at the reported line and column (None where no line is reported), words that the message must contain.
"""
from dataclasses import dataclass, field

CONTROL, NUMERICS, MESH, OBSERVERS = (f"system/{name}.yaml" for name in ("control", "numerics", "mesh", "observers"))
RELAX = "system/relax.yaml"  # of membraneRelax
FLUID, MEMBRANES, BODIES, FLOW = (f"constant/{name}.yaml" for name in ("fluid", "membranes", "bodies", "flow"))


@dataclass
class Problem:
    file: str
    key: str
    at: str | None
    words: list


@dataclass
class Case:
    name: str
    edits: list
    problems: list
    arguments: list = field(default_factory=list)
    code: int = 2
    program: str = "checkCase"


def replace(file, old, new):
    def edit(directory):
        text = (directory / file).read_text()
        assert text.count(old) == 1, f"{file} holds '{old}' {text.count(old)} times"
        (directory / file).write_text(text.replace(old, new))
    return edit


def append(file, text):
    return lambda directory: (directory / file).write_text((directory / file).read_text() + text)


def rewrite(file, text):
    return lambda directory: (directory / file).write_text(text)


def remove(file):
    return lambda directory: (directory / file).unlink()


def case(name, edit, file, key, at, *words):
    return Case(name, edit if isinstance(edit, list) else [edit], [Problem(file, key, at, list(words))])


def relax(name, edits, key, at, *words, file=RELAX):
    return Case(name, edits if isinstance(edits, list) else [edits], [Problem(file, key, at, list(words))], program="membraneRelax")


def setting(name, argument, file, key, *words, code=2):
    return Case(name, [], [Problem(file, key, None, list(words))], ["-set", argument], code)


NO_CELLS = [replace(MESH, """cells:
  - name: rbc
    shape: {type: kuchelFackerell, d: 8 um, h: 2.12 um, b: 1 um}
    edge: 0.8 um
    centre: [0 um, 0 um, 0 um]
    axis: [0, 0, 1]
""", ""), remove(MEMBRANES)]
# A fluid alone in a box periodic along every axis: no cells, no walls, no shear rate.
VORTICES = NO_CELLS + [replace(MESH, "[20 um, 16 um, 16 um]", "[16 um, 16 um, 16 um]"), replace(MESH, "[true, true, false]", "[true, true, true]"),
                       rewrite(FLOW, "{type: taylorGreen, speed: 1 mm/s}\n"), replace(CONTROL, "endStrain: 6", "endTime: 1 ms"),
                       replace(CONTROL, "strain: 0.5", "time: 0.1 ms"), remove(OBSERVERS)]

# A fluid alone between walls.
LAYERED = NO_CELLS + [rewrite(FLOW, "{type: shear, shearRate: 10 1/s}\n"), remove(OBSERVERS)]

# A fluid alone in a tube.
def tube(walls, drive="pressureDrop: 1 Pa"):
    return NO_CELLS + [rewrite(FLOW, f"type: poiseuille\n{drive}\nwalls: {walls}\n"), replace(CONTROL, "endStrain: 6", "endTime: 1 ms"),
                       replace(CONTROL, "strain: 0.5", "time: 0.1 ms"), remove(OBSERVERS), replace(MESH, "[20 um, 16 um, 16 um]", "[20 um, 16 um, 20 um]"),
                       replace(MESH, "[true, true, false]", "[true, false, false]")]


def vessel(half=10):
    """A square tube, 12 um wide and open at x = -half and half, as constant/vessel.off."""
    corners = [(x, y, z) for x in (-half, half) for y, z in ((-6, -6), (6, -6), (6, 6), (-6, 6))]
    sides = [(k, (k + 1) % 4, 4 + k) for k in range(4)] + [((k + 1) % 4, 4 + (k + 1) % 4, 4 + k) for k in range(4)]
    text = f"OFF\n8 {len(sides)} 0\n" + "".join("{} {} {}\n".format(*x) for x in corners) + "".join("3 {} {} {}\n".format(*t) for t in sides)
    return lambda directory: (directory / "constant/vessel.off").write_text(text)


IMMERSED = replace(NUMERICS, "dualIdentity", "immersed")
IMPLICIT = [replace(NUMERICS, "velocityVerlet", "implicit"), IMMERSED]


# The base case with a rigid sphere beside its cell.
def with_body(bodies, place="{name: bead, shape: {type: sphere, radius: 2 um}, edge: 0.5 um, centre: [7 um, 0 um, 0 um]}"):
    return [append(MESH, f"bodies:\n  - {place}\n"), rewrite(BODIES, bodies)]


CASES = [
    # Form of a file
    case("duplicateKey", append(FLUID, "density: 900 kg/m^3\n"), FLUID, "density", "density: 900", "twice", "line 2"),
    case("tab", replace(MEMBRANES, "  rupture", "\trupture"), MEMBRANES, "", "\trupture", "tab", "blanks"),
    case("anchor", replace(MEMBRANES, "5e-4 N/m", "&stiff 5e-4 N/m"), MEMBRANES, "", "&stiff", "anchor", "write the value out"),
    case("alias", replace(CONTROL, "wallClock: 2 h", "wallClock: *limit"), CONTROL, "", "*limit", "alias", "write the value out"),
    case("tag", replace(CONTROL, "endStrain: 6", "endStrain: !!float 6"), CONTROL, "", "!!float", "tag"),
    case("mergeKey", append(FLUID, "<<: {gamma: 7}\n"), FLUID, "", "<<", "merge", "write the keys out"),
    case("unclosedBracket", replace(MESH, "[true, true, false]", "[true, true, false"), MESH, "", "[true", "this '[' is not closed",
         "a ']' is missing"),
    case("unclosedBrace", replace(FLOW, "{Re: 0.1}", "{Re: 0.1"), FLOW, "", "{Re", "this '{' is not closed", "a '}' is missing"),
    case("wrongClosingBracket", replace(MESH, "[true, true, false]", "[true, true, false}"), MESH, "", "[true", "this '[' is not closed"),
    case("unclosedQuote", replace(CONTROL, "application: dmpFlow", 'application: "dmpFlow'), CONTROL, "", '"dmpFlow',
         "quotation mark is not closed"),
    case("missingColon", replace(FLUID, "viscosity: 1.0e-3", "viscosity 1.0e-3"), FLUID, "", ": {type", "is a ':' missing"),
    case("wrongIndent", replace(MESH, "  periodic", "   periodic"), MESH, "", "periodic", "indented wrongly"),
    case("emptyFile", rewrite(FLOW, ""), FLOW, "", "", "'type' is missing", "Known:", "shear"),
    case("commentsOnly", rewrite(NUMERICS, "# spacing: 1 um\n"), NUMERICS, "spacing", "", "missing", "particle spacing"),
    case("listAsFile", rewrite(FLUID, "- density: 1000 kg/m^3\n- viscosity: 1e-3 Pa s\n"), FLUID, "", "- density", "list of 2", "table"),
    case("wordAsFile", rewrite(FLUID, "water\n"), FLUID, "", "water", "'water'", "table"),
    case("twoDocuments", append(FLOW, "---\ntype: shear\n"), FLOW, "", "type", "---", "one dictionary"),
    case("missingFile", remove(FLUID), FLUID, "", None, "no such file", "-case"),
    case("missingMembranes", remove(MEMBRANES), MEMBRANES, "", None, "no such file"),

    # Keys
    case("unknownKey", replace(CONTROL, "startFrom", "startfrom"), CONTROL, "startfrom", "startfrom", "unknown key 'startfrom'",
         "Did you mean 'startFrom'?", "Allowed:", "endStrain"),
    case("unknownKeyInTable", replace(FLUID, "soundSpeed: auto", "speedOfSound: auto"), FLUID, "equationOfState.speedOfSound",
         "speedOfSound", "unknown key", "Allowed: gamma, soundSpeed"),
    case("misspeltRequiredKey", replace(FLUID, "density", "densty"), FLUID, "densty", "densty", "Did you mean 'density'?"),
    case("missingKey", replace(FLUID, "viscosity: 1.0e-3 Pa s\n", ""), FLUID, "viscosity", "density", "missing", "dynamic viscosity",
         "Pa s", "for example"),
    case("missingKeyInCell", replace(MESH, "    edge: 0.8 um\n", ""), MESH, "cells[0].edge", "name: rbc", "missing", "a length in m or in particle spacings"),
    case("keyWithoutValue", replace(NUMERICS, "spacing: 1 um", "spacing:"), NUMERICS, "spacing", "spacing:", "found nothing", "in m"),
    case("modelWithoutCoefficient", replace(MEMBRANES, "{type: harmonic, k: 5e-4 N/m}", "harmonic"), MEMBRANES, "rbc.bonds.k",
         "bonds: harmonic", "missing", "spring constant", "N/m"),
    case("modelWithoutType", replace(MEMBRANES, "{type: harmonic, k: 5e-4 N/m}", "{k: 5e-4 N/m}"), MEMBRANES, "rbc.bonds", "bonds",
         "'type' is missing", "bond law", "harmonic"),

    # Units
    case("missingUnit", replace(NUMERICS, "spacing: 1 um", "spacing: 1"), NUMERICS, "spacing", "1", "'1' has no unit",
         "a quantity in m", "um"),
    case("unitOnNumber", replace(FLOW, "Ca: 0.02", "Ca: 0.02 Pa"), FLOW, "Ca", "0.02 Pa", "has a unit", "write '0.02'"),
    case("wrongDimension", replace(FLUID, "1.0e-3 Pa s", "1.0e-3 Pa"), FLUID, "viscosity", "1.0e-3 Pa", "is in Pa", "in Pa s"),
    case("unknownUnit", replace(MESH, "edge: 0.8 um", "edge: 0.8 mu"), MESH, "cells[0].edge", "0.8 mu", "unknown unit 'mu'",
         "Did you mean 'um'?", "Known for m: um, nm"),
    case("spacingsNotAllowed", replace(MESH, "d: 8 um", "d: 8 dx"), MESH, "cells[0].shape.d", "8 dx", "particle spacings", "not allowed"),
    case("listWithoutUnit", replace(MESH, "[20 um, 16 um, 16 um]", "[20, 16, 16]"), MESH, "domain.size[0]", "20", "no unit"),

    # Values
    case("negative", replace(FLUID, "1000 kg/m^3", "-1000 kg/m^3"), FLUID, "density", "-1000", "'-1000 kg/m^3'", "greater than 0"),
    case("zero", replace(NUMERICS, "spacing: 1 um", "spacing: 0 um"), NUMERICS, "spacing", "0 um", "'0 um'", "greater than 0"),
    case("textForNumber", replace(FLOW, "Ca: 0.02", "Ca: small"), FLOW, "Ca", "small", "'small'", "number"),
    case("numberForWord", replace(CONTROL, "application: dmpFlow", "application: 3"), CONTROL, "application", "3", "'3'",
         "dmpFlow, sphFlow"),
    case("fractionForInteger", replace(CONTROL, "keep: 2", "keep: 2.5"), CONTROL, "checkpoint.keep", "2.5", "'2.5'", "whole number"),
    case("unitAfterVector", replace(MESH, "[20 um, 16 um, 16 um]", "[20, 16, 16] um"), MESH, "domain.size", "[20, 16, 16] um", "not YAML",
         "'[20 um, 16 um, 16 um]'", "etc/convertVectors"),
    case("twoComponents", replace(MESH, "[0 um, 0 um, 0 um]", "[0 um, 0 um]"), MESH, "cells[0].centre", "[0 um, 0 um]", "a list of 2", "vector"),
    case("tableForNumber", replace(NUMERICS, "spacing: 1 um", "spacing: {dx: 1 um}"), NUMERICS, "spacing", "{dx", "a table", "in m"),
    case("wordForBoolean", replace(MESH, "[true, true, false]", "[yes, true, false]"), MESH, "domain.periodic[0]", "yes", "'yes'",
         "true or false"),
    case("tableForList", replace(MESH, "  - name: rbc\n    shape", "    name: rbc\n    shape"), MESH, "cells", "cells", "a table", "a list"),
    case("beyondDouble", replace(FLUID, "1000 kg/m^3", "1e999 kg/m^3"), FLUID, "density", "1e999", "1e999"),
    case("notANumber", replace(FLUID, "1000 kg/m^3", ".nan kg/m^3"), FLUID, "density", ".n", "number"),
    case("nameNotAName", replace(MESH, "name: rbc", "name: rbc 1"), MESH, "cells[0].name", "rbc 1", "'rbc 1'", "letter"),

    # Models
    case("unknownModel", replace(NUMERICS, "wendlandC2", "wendland"), NUMERICS, "kernel.type", "wendland", "unknown kernel 'wendland'",
         "Did you mean 'wendlandC2'?", "Known:", "lucy"),
    case("unknownIntegrator", replace(NUMERICS, "velocityVerlet", "verlet"), NUMERICS, "integrator", "verlet", "'verlet' is not allowed",
         "velocityVerlet"),
    case("unknownShape", replace(MESH, "kuchelFackerell", "discocyte"), MESH, "cells[0].shape.type", "discocyte", "unknown cell shape 'discocyte'",
         "Known:", "kuchelFackerell", "evansFung"),
    case("unknownObserver", replace(OBSERVERS, "type: shape", "type: shapes"), OBSERVERS, "deformation.type", "shapes",
         "unknown observer 'shapes'", "Did you mean 'shape'?", "wallStress"),
    case("observerWithoutEvery", replace(OBSERVERS, "{type: shape, every: 0.02 strain}", "shape"), OBSERVERS, "deformation.every",
         "deformation", "missing", "strain"),
    case("observerEveryWithoutUnit", replace(OBSERVERS, "0.02 strain", "0.02"), OBSERVERS, "deformation.every", "0.02", "'0.02'",
         "0.1 strain", "steps"),
    case("bendingTwice", replace(MEMBRANES, "Eb: 0.01", "Eb: 0.01, kappa: 2.8e-19 J"), MEMBRANES, "rbc.bending.kappa", "kappa",
         "exactly one", "'Eb', 'kappa', 'k'"),
    case("bendingWithoutStiffness", replace(MEMBRANES, "{type: dihedral, Eb: 0.01}", "dihedral"), MEMBRANES, "rbc.bending", "bending",
         "one of 'Eb', 'kappa', 'k' is missing"),
    case("ruptureLimitBelowOne", replace(MEMBRANES, "rupture: none", "rupture: {type: bondStretch, limit: 0.95}"), MEMBRANES,
         "rbc.rupture.limit", "0.95", "'0.95'", "greater than 1"),
    case("damageWithoutTime", replace(MEMBRANES, "rupture: none", "rupture: {type: damage, scale: 0.02}"), MEMBRANES, "rbc.rupture.time",
         "rupture", "missing", "time to failure", "a quantity in s"),
    case("damageTimeWithoutUnit", replace(MEMBRANES, "rupture: none", "rupture: {type: damage, scale: 0.02, time: 1e-3}"), MEMBRANES,
         "rbc.rupture.time", "1e-3", "no unit", "in s"),
    case("damageNegativeOnset", replace(MEMBRANES, "rupture: none", "rupture: {type: damage, onset: -0.01, scale: 0.02, time: 1 ms}"),
         MEMBRANES, "rbc.rupture.onset", "-0.01", "'-0.01'", "at least 0"),
    case("damageOtherKey", replace(MEMBRANES, "rupture: none", "rupture: {type: damage, limit: 0.02, scale: 0.02, time: 1 ms}"), MEMBRANES,
         "rbc.rupture.limit", "limit", "unknown key 'limit'", "Allowed: onset, scale, time, exponent"),
    case("unknownRupture", replace(MEMBRANES, "rupture: none", "rupture: {type: areaStrain, limit: 0.02}"), MEMBRANES, "rbc.rupture.type",
         "areaStrain", "unknown rupture law 'areaStrain'", "Did you mean 'arealStrain'?", "damage"),
    case("firstBreakOfWhatCannotBreak", replace(CONTROL, "wallClock: 2 h", "wallClock: 2 h, firstBreak: true"), CONTROL, "stop.firstBreak",
         "true", "found true", "nothing can break", "arealStrain", "write false"),
    case("firstBreakNoBoolean", replace(CONTROL, "wallClock: 2 h", "wallClock: 2 h, firstBreak: 0.1"), CONTROL, "stop.firstBreak",
         "0.1", "'0.1'", "true or false"),
    case("viscosityRatioZero", replace(MEMBRANES, "viscosityRatio: 1", "viscosityRatio: 0"), MEMBRANES,
         "rbc.interior.viscosityRatio", "0", "'0'", "greater than 0"),
    case("kernelSupportTooSmall", replace(NUMERICS, "3.0 dx", "0.9 dx"), NUMERICS, "kernel.support", "0.9 dx", "found 0.9 dx", "1.2 to 10 dx"),
    case("kernelSupportTooLarge", replace(NUMERICS, "3.0 dx", "1e9 dx"), NUMERICS, "kernel.support", "1e9 dx", "too many neighbours", "1.2 to 10 dx"),
    case("kernelSupportInMetresTooSmall", replace(NUMERICS, "3.0 dx", "0.5 um"), NUMERICS, "kernel.support", "0.5 um", "found 0.5 dx"),

    # What excludes or needs another
    case("CaAndShearRate", append(FLOW, "shearRate: 100 1/s\n"), FLOW, "shearRate", "shearRate", "exactly one", "'Ca', 'shearRate'"),
    case("neitherCaNorShearRate", replace(FLOW, "Ca: 0.02\n", ""), FLOW, "", "type", "'Ca', 'shearRate'", "missing", "exactly one"),
    case("endTimeAndEndStrain", append(CONTROL, "endTime: 1 ms\n"), CONTROL, "endTime", "endTime", "exactly one", "'endTime', 'endStrain'"),
    case("noEnd", replace(CONTROL, "endStrain: 6\n", ""), CONTROL, "", "application", "'endTime', 'endStrain'", "missing"),
    case("twoWriteIntervals", replace(CONTROL, "strain: 0.5", "strain: 0.5, steps: 100"), CONTROL, "write.steps", "steps", "at most one"),
    Case("CaWithoutCells", NO_CELLS + [remove(OBSERVERS), replace(FLOW, "inertia: {Re: 0.1}\n", "")],
         [Problem(FLOW, "Ca", "0.02", ["needs a membrane", "shearRate", "system/mesh.yaml"])]),
    Case("ReWithoutCells", NO_CELLS + [remove(OBSERVERS), replace(FLOW, "Ca: 0.02", "shearRate: 100 1/s")],
         [Problem(FLOW, "inertia", "{Re", ["radius", "physical", "constant/fluid.yaml"])]),
    case("boxDoesNotFit", replace(MESH, "[20 um, 16 um, 16 um]", "[20.3 um, 16 um, 16 um]"), MESH, "domain.size", "[20.3", "along x", "20.3 um",
         "20 um, 21 um"),
    case("periodicAcrossWalls", replace(MESH, "[true, true, false]", "[true, true, true]"), MESH, "domain.periodic", "[true", "axis z",
         "walls", "write false"),
    case("openAxisWithoutWalls", replace(MESH, "[true, true, false]", "[true, false, false]"), MESH, "domain.periodic", "[true", "axis y",
         "write true"),
    case("misspeltWalls", [replace(FLOW, "{normal: z}", "{type: plane, normal: z}")], FLOW, "walls.type", "plane", "unknown walls 'plane'",
         "Did you mean 'planes'"),
    case("wallsWithoutKey", [replace(FLOW, "{normal: z}", "{nromal: z}")], FLOW, "walls.nromal", "nromal", "Did you mean 'normal'"),
    case("wallsAlongFlow", [replace(FLOW, "normal: z", "normal: x"), replace(MESH, "[true, true, false]", "[false, true, true]")], FLOW,
         "walls.normal", "x", "found x", "allowed are y, z"),
    case("cellWithoutLaws", replace(MEMBRANES, "rbc:", "rcb:"), MEMBRANES, "rbc", "rcb:", "'rbc'", "system/mesh.yaml", "Did you mean 'rcb'?"),
    case("cellNameTwice", append(MESH, "  - {name: rbc, shape: {type: sphere, radius: 2 um}, edge: 0.8 um, centre: [7 um, 0 um, 0 um]}\n"), MESH,
         "cells[1].name", "rbc", "'rbc' is taken"),
    case("reservedCellName", [replace(MESH, "name: rbc", "name: fluid"), replace(MEMBRANES, "rbc:", "fluid:")], MESH, "cells[0].name", "fluid",
         "'fluid'", "reserved"),
    case("impossibleRedCell", replace(MESH, "b: 1 um", "b: 3 um"), MESH, "cells[0].shape", "{type", "b = 3 um", "h = 2.12 um", "less than"),
    case("thickRedCell", replace(MESH, "d: 8 um", "d: 4 um"), MESH, "cells[0].shape", "{type", "d = 4 um", "too small", "greater than"),
    case("surfaceFileMissing", replace(MESH, "{type: kuchelFackerell, d: 8 um, h: 2.12 um, b: 1 um}", "{type: file, file: cell.stl}"),
         MESH, "cells[0].shape", "{type", "cell.stl"),
    case("zeroAxis", replace(MESH, "axis: [0, 0, 1]", "axis: [0, 0, 0]"), MESH, "cells[0].axis", "[0, 0, 0]", "zero vector", "[0, 0, 1]"),
    case("cellThroughWall", replace(MESH, "[0 um, 0 um, 0 um]", "[0 um, 0 um, 7.5 um]"), MESH, "cells[0].centre", "[0 um, 0 um, 7.5 um]", "through the wall", "along z"),
    case("placesBesideCentre", replace(MESH, "[0 um, 0 um, 0 um]", "[1 um, 0 um, 0 um]\n    places: [{centre: [0 um, 0 um, 0 um]}]"), MESH, "cells[0].centre",
         "centre", "given beside 'places'", "remove it"),
    case("placeWithoutCentre", replace(MESH, "    centre: [0 um, 0 um, 0 um]\n", "    places: [{axis: [1, 0, 0]}]\n"), MESH, "cells[0].places[0].centre",
         "{axis", "missing", "place of its centre"),
    case("placeOfNoSize", replace(MESH, "    centre: [0 um, 0 um, 0 um]\n", "    places: [{centre: [0 um, 0 um, 0 um], scale: 0}]\n"), MESH,
         "cells[0].places[0].scale", "0}", "greater than 0"),
    case("placeThroughWall", replace(MESH, "    centre: [0 um, 0 um, 0 um]\n", "    places: [{centre: [-5 um, 0 um, 0 um]}, {centre: [5 um, 0 um, 7.5 um]}]\n"), MESH,
         "cells[0].places[1].centre", "[5 um", "through the wall", "along z"),
    case("placesTwice", [replace(MESH, "    centre: [0 um, 0 um, 0 um]\n", "    places: [{centre: [0 um, 0 um, 0 um]}]\n    table: cells.csv\n"),
                         rewrite("cells.csv", "x_um,y_um,z_um\n0,0,0\n")], MESH, "cells[0].table", "table", "given beside 'places'", "keep one"),
    case("tableMissing", replace(MESH, "    centre: [0 um, 0 um, 0 um]\n", "    table: cells.csv\n"), MESH, "cells[0].table", "cells.csv", "'cells.csv'", "no such file"),
    case("tableOfAnotherKind", replace(MESH, "    centre: [0 um, 0 um, 0 um]\n", "    table: cells.txt\n"), MESH, "cells[0].table", "cells.txt", ".csv or .vtp"),
    case("tableWithoutPlaces", [replace(MESH, "    centre: [0 um, 0 um, 0 um]\n", "    table: cells.csv\n"), rewrite("cells.csv", "x_um,y_um,z_um\n")], MESH,
         "cells[0].table", "cells.csv", "has no places"),
    case("tableWithUnknownColumn", [replace(MESH, "    centre: [0 um, 0 um, 0 um]\n", "    table: cells.csv\n"), rewrite("cells.csv", "x_um,y_um,z_um,scal\n0,0,0,1\n")],
         "cells.csv", "scal", "scal", "unknown column", "Did you mean 'scale'?"),
    Case("tableOfBadRows", [replace(MESH, "    centre: [0 um, 0 um, 0 um]\n", "    table: cells.csv\n"),
                            rewrite("cells.csv", "# three cells\nx_um,y_um,z_um,scale\n-5,zero,0,1\n5,0,0\n0,0,0,-1\n")],
         [Problem("cells.csv", "y", "zero", ["found 'zero'", "finite number"]), Problem("cells.csv", "", "5,0,0", ["found 3 values", "names 4 columns"]),
          Problem("cells.csv", "scale", "0,0,0,-1", ["found -1", "greater than 0"])]),
    case("edgeTooLarge", replace(MESH, "edge: 0.8 um", "edge: 20 um"), MESH, "cells[0].edge", "20 um", "found 20 um", "radius 4 um",
         "at most half the radius, 2 um"),
    case("unknownStart", replace(CONTROL, "latestTime", "lastTime"), CONTROL, "startFrom", "lastTime", "'lastTime'",
         "Did you mean 'latestTime'?", "firstTime"),
    case("startWithoutUnit", replace(CONTROL, "latestTime", "0.5"), CONTROL, "startFrom", "0.5", "'0.5'", "unit"),
    case("cellsForSphFlow", replace(CONTROL, "dmpFlow", "sphFlow"), CONTROL, "application", "sphFlow", "sphFlow", "dmpFlow"),
    Case("writeStrainWithoutShear", VORTICES + [replace(CONTROL, "time: 0.1 ms", "strain: 0.5")],
         [Problem(CONTROL, "write.strain", "0.5", ["taylorGreen", "no shear rate", "write.time"])]),
    Case("endStrainWithoutShear", VORTICES + [replace(CONTROL, "endTime: 1 ms", "endStrain: 6")],
         [Problem(CONTROL, "endStrain", "6", ["taylorGreen", "no shear rate", "endTime"])]),
    Case("vorticesInLongBox", VORTICES + [replace(MESH, "[16 um, 16 um, 16 um]", "[20 um, 16 um, 16 um]")],
         [Problem(FLOW, "type", "taylorGreen", ["as long along x as along z", "20 um, 16 um"])]),
    Case("abcInLongBox", VORTICES + [rewrite(FLOW, "{type: abc, A: 1 mm/s, B: 1 mm/s, C: 1 mm/s}\n"), replace(MESH, "[16 um, 16 um, 16 um]", "[20 um, 16 um, 16 um]")],
         [Problem(FLOW, "type", "abc", ["as long along x as along y and z", "20 um, 16 um, 16 um"])]),
    Case("abcAtRest", VORTICES + [rewrite(FLOW, "{type: abc, A: 0 m/s, B: 0 m/s, C: 0 m/s}\n")],
         [Problem(FLOW, "A", "0 m/s", ["all zero"])]),
    Case("vorticesInFourDimensions", VORTICES + [rewrite(FLOW, "{type: taylorGreen, speed: 1 mm/s, dimensions: 4}\n")],
         [Problem(FLOW, "dimensions", "4", ["2", "3"])]),
    Case("layersWithoutWalls", VORTICES + [append(FLUID, "layers: [{above: 0 um, viscosity: 2e-3 Pa s}]\n")],
         [Problem(FLUID, "layers", "[{above", ["taylorGreen", "no plane walls"])]),
    Case("layersAroundCells", [append(FLUID, "layers: [{above: 0 um, viscosity: 2e-3 Pa s}]\n")],
         [Problem(FLUID, "layers", "[{above", ["fluid alone", "has cells", "viscosityRatio"])]),
    Case("layerBeyondWall", LAYERED + [append(FLUID, "layers: [{above: 9 um, viscosity: 2e-3 Pa s}]\n")],
         [Problem(FLUID, "layers[0].above", "9 um", ["not between the walls", "-8 um and 8 um", "along z"])]),
    Case("layersUnordered", LAYERED + [append(FLUID, "layers: [{above: 2 um, viscosity: 2e-3 Pa s}, {above: 1 um, viscosity: 3e-3 Pa s}]\n")],
         [Problem(FLUID, "layers[1].above", "1 um", ["the layer before it begins at 2 um", "from the lowest up"])]),
    Case("layerTooThin", LAYERED + [append(FLUID, "layers: [{above: 7.9 um, viscosity: 2e-3 Pa s}]\n")],
         [Problem(FLUID, "layers[0].above", "7.9 um", ["thinner than a spacing"])]),
    Case("layerWithoutViscosity", LAYERED + [append(FLUID, "layers: [{above: 1 um}]\n")],
         [Problem(FLUID, "layers[0].viscosity", "{above", ["missing: its dynamic viscosity"])]),
    Case("observerOfCellsWithoutCells", VORTICES + [rewrite(OBSERVERS, "deformation: {type: shape, every: 10 steps}\n")],
         [Problem(OBSERVERS, "deformation", "deformation", ["shape", "the case has none", "system/mesh.yaml"])]),
    Case("observerOfWallsWithoutWalls", VORTICES + [rewrite(OBSERVERS, "drag: {type: wallStress, every: 10 steps}\n")],
         [Problem(OBSERVERS, "drag", "drag", ["wallStress", "the flow has none", "constant/flow.yaml"])]),
    Case("observerEveryStrainWithoutShear", VORTICES + [rewrite(OBSERVERS, "balance: {type: conservation, every: 0.1 strain}\n")],
         [Problem(OBSERVERS, "balance", "balance", ["every", "no shear rate", "in s or in steps"])]),
    case("observerLooksTooRarely", replace(OBSERVERS, "0.02 strain", "2 strain"), OBSERVERS, "deformation", "deformation", "1.5 strain"),

    # What goes with which integrator
    case("correctedWithDualIdentity", append(NUMERICS, "operators: corrected\nshifting: {}\n"), NUMERICS, "operators", "corrected",
         "found corrected", "'coupling: immersed'", "operators: plain"),
    case("correctedWithoutShifting", [IMMERSED, append(NUMERICS, "operators: corrected\nshifting: none\n")], NUMERICS, "operators", "corrected",
         "found corrected", "clump", "'shifting: {coefficient: 1}'", "operators: plain"),
    case("correctedWithoutShiftingImplicit", [*IMPLICIT, append(NUMERICS, "operators: corrected\nshifting: none\n")], NUMERICS,
         "operators", "corrected", "found corrected", "'shifting: {coefficient: 1}'"),
    case("bodiesWithImmersed", [IMMERSED, *with_body("bead: {density: 1200 kg/m^3, motion: free}\n")], NUMERICS, "coupling", "immersed",
         "found immersed", "has bodies", "'coupling: dualIdentity'", "integrator: implicit"),
    case("guardWithImmersed", [IMMERSED, append(NUMERICS, "guard: 10\n")], NUMERICS, "guard", "10", "found 10", "means nothing", "coupling: immersed",
         "remove this key"),
    case("guardWithImplicit", [*IMPLICIT, append(NUMERICS, "guard: 0\n")], NUMERICS, "guard", "0", "means nothing"),
    case("safetyWithImplicit", [*IMPLICIT, append(NUMERICS, "safety: 0.5\n")], NUMERICS, "safety", "0.5", "means nothing",
         "'integrator: implicit'", "implicit.step"),
    case("skinWithImplicit", [*IMPLICIT, append(NUMERICS, "skin: 0.3 dx\n")], NUMERICS, "skin", "0.3 dx", "means nothing",
         "'integrator: implicit'", "at every step"),
    case("shiftingStepsWithImplicit", [*IMPLICIT, append(NUMERICS, "shifting: {steps: 10}\n")], NUMERICS, "shifting.steps", "10}",
         "means nothing", "'integrator: implicit'", "shifted at every step"),
    case("shiftingStepsWithCorrected", [IMMERSED, append(NUMERICS, "operators: corrected\nshifting: {coefficient: 1, steps: 10}\n")], NUMERICS,
         "shifting.steps", "10}", "means nothing", "'operators: corrected'", "shifted at every step"),
    case("poresWithoutSolute", replace(MEMBRANES, "rupture: none", "pores: {type: excessArea, onset: 0.02, radius: 10 nm}"), MEMBRANES, "rbc.pores",
         "{type: excessArea", "found pores", "carries no solute", "constant/fluid.yaml", "pores: none"),
    case("poresBelowTheSolute", [replace(MEMBRANES, "rupture: none", "pores: {type: excessArea, onset: 0.02, radius: 3 nm}"),
                                 replace(MEMBRANES, "viscosityRatio: 1", "viscosityRatio: 1, concentration: 330 kg/m^3"), append(FLUID, "solute: {}\n")],
         MEMBRANES, "rbc.pores.radius", "3 nm", "does not pass", "3.2 nm", "larger pores"),
    case("poresLikeTriangles", [replace(MEMBRANES, "rupture: none", "pores: {type: excessArea, onset: 0.02, radius: 10 um}"), append(FLUID, "solute: {}\n")],
         MEMBRANES, "rbc.pores.radius", "10 um", "greater than 0 and at most 1 um"),
    case("soluteNowhere", append(FLUID, "solute: {}\n"), FLUID, "solute", "{}", "nowhere", "interior: {concentration: 330 kg/m^3}", "remove solute"),
    case("concentrationWithoutSolute", replace(MEMBRANES, "viscosityRatio: 1", "viscosityRatio: 1, concentration: 330 kg/m^3"), MEMBRANES,
         "rbc.interior.concentration", "330", "carries no solute", "leave it out"),
    case("haemolysisWithoutSolute", append(OBSERVERS, "release: {type: haemolysis, every: 0.1 strain}\n"), OBSERVERS, "release", "release",
         "follows the solute", "carries none", "constant/fluid.yaml"),
    case("tubeWiderThanTheBox", tube("{type: tube, diameter: 18 um}"), FLOW, "walls.diameter", "18 um", "18 um wide along y", "16 um",
         "make the box at least as large, or the walls narrower"),
    case("ductWiderThanTheBox", tube("{type: duct, width: 12 um, height: 24 um}"), FLOW, "walls.height", "24 um", "24 um wide along z", "20 um"),
    case("throatAsWideAsTheTube", tube("{type: constriction, diameter: 12 um, throat: 12 um, taper: 4 um}"), FLOW, "walls.throat", "12 um",
         "not narrower than the tube"),
    case("throatLongerThanTheBox", tube("{type: constriction, diameter: 12 um, throat: 8 um, length: 6 um, taper: 8 um}"), FLOW, "walls.taper", "8 um",
         "22 um long", "20 um along x"),
    case("wavesThatClose", tube("{type: sinusoidalTube, diameter: 12 um, amplitude: 1}"), FLOW, "walls.amplitude", "1", "at least 0 and less than 1"),
    case("networkWithAGap", tube("{type: network, tubes: [{from: [-10 um, 0 um, 0 um], to: [8 um, 0 um, 0 um], diameter: 8 um}]}"), FLOW, "walls.tubes",
         "[{from", "no tubes lead from one end of the box to the other", "add the tube that is missing"),
    case("jointThatIsMissed", tube("{type: network, tubes: [{from: [-10 um, 0 um, 0 um], to: [0 um, 0 um, 0 um], diameter: 8 um}, "
                                   "{from: [0 um, 0.1 um, 0 um], to: [10 um, 0 um, 0 um], diameter: 8 um}]}"), FLOW, "walls.tubes[0].to",
         "[0 um, 0 um, 0 um]", "lies 100 nm from an end of walls.tubes[1]", "give both the same place"),
    case("vesselThatIsNotThere", tube("{type: surface, file: vessel.stl}"), FLOW, "walls.file", "vessel.stl", "vessel.stl"),
    case("vesselInAnotherUnit", [*tube("{type: surface, file: constant/vessel.off, scale: 1 mm}"), vessel()], FLOW, "walls.file", "constant/vessel.off",
         "beyond the box", "scale: 1 um"),
    case("vesselThatIsTooShort", [*tube("{type: surface, file: constant/vessel.off}"), vessel(8)], FLOW, "walls.file", "constant/vessel.off",
         "8 edges are open", "do not lie at the ends of the box", "-10 um and 10 um", "a cap that is missing"),
    case("driveWithoutItsTable", append(FLOW, "drive: {type: table, file: constant/beat.csv}\n"), FLOW, "drive.file", "constant/beat.csv",
         "constant/beat.csv", "missing"),
    case("driveThatDoesNotClose", [append(FLOW, "drive: {type: table, file: constant/beat.csv, repeat: true}\n"),
                                   lambda directory: (directory / "constant/beat.csv").write_text("time_s,factor\n0,1\n1,2\n")], FLOW, "drive.file",
         "constant/beat.csv", "found the factor 1 in the first row and 2 in the last", "have to be equal"),
    case("unknownDrive", append(FLOW, "drive: {type: sin, frequency: 1 Hz}\n"), FLOW, "drive.type", "sin", "unknown drive 'sin'", "Did you mean 'sine'?"),
    case("twoDrives", tube("{type: tube, diameter: 12 um}", "pressureDrop: 1 Pa\nbodyForce: 1 m/s^2"), FLOW, "bodyForce", "bodyForce", "pressureDrop"),
    case("flowRateOfNoChannel", append(OBSERVERS, "rate: {type: flowRate, every: 0.1 strain}\n"), OBSERVERS, "rate", "rate", "needs a flow along x between walls at rest",
         "type: poiseuille"),
    case("edgeTooCoarseForTears", replace(MEMBRANES, "rupture: none", "rupture: {type: cohesive, fractureEnergy: 4 pN, length: 1.5 um}"), MESH,
         "cells[0].edge", "0.8 um", "too coarse for the tears of 'rbc'", "1.5 um", "at most half of it, 750 nm", "finer mesh"),
    case("edgeTooCoarseForImmersed", [IMMERSED, replace(NUMERICS, "spacing: 1 um", "spacing: 0.5 um"), replace(MESH, "0.8 um", "1.2 um")],
         MESH, "cells[0].edge", "1.2 um", "too coarse", "coupling: immersed", "2 dx", "1 um"),
    case("cellTooLongForImmersed", [IMMERSED, replace(MESH, "[20 um, 16 um, 16 um]", "[9 um, 16 um, 16 um]")], MESH, "cells[0].shape", "{type:",
         "8 um long along x", "periodic with 9 um", "2 dx", "10 um or longer"),
    case("dualIdentityWithImplicit", replace(NUMERICS, "velocityVerlet", "implicit"), NUMERICS, "coupling", "dualIdentity",
         "found dualIdentity", "'integrator: velocityVerlet'", "coupling: immersed"),
    case("bodiesWithCorrected", [append(NUMERICS, "operators: corrected\nshifting: {}\n"), IMMERSED,
                                 *with_body("bead: {density: 1200 kg/m^3, motion: free}\n")], NUMERICS, "operators", "corrected",
         "found corrected", "has bodies", "'operators: plain'", "integrator: implicit"),
    case("cellsWithRkl2", replace(NUMERICS, "velocityVerlet", "rkl2"), NUMERICS, "integrator", "rkl2", "found rkl2", "fluid alone",
         "has cells", "velocityVerlet", "implicit with coupling: immersed"),
    case("automaticWithNothingLeft", [replace(NUMERICS, "velocityVerlet", "automatic"), append(NUMERICS, "operators: corrected\nshifting: {}\n")],
         NUMERICS, "integrator", "automatic", "no integrator can do this case", "rkl2: ", "fluid alone", "implicit: ", "dualIdentity"),
    Case("correctedWithRkl2", VORTICES + [replace(NUMERICS, "velocityVerlet", "rkl2"), append(NUMERICS, "operators: corrected\n")],
         [Problem(NUMERICS, "operators", "corrected", ["found corrected", "'integrator: rkl2'", "operators: plain"])]),
    case("rkl2EvenStages", append(NUMERICS, "rkl2: {stages: 10}\n"), NUMERICS, "rkl2.stages", "10", "found 10", "even", "9, 11"),
    case("rkl2TooManyStages", append(NUMERICS, "rkl2: {stages: 101}\n"), NUMERICS, "rkl2.stages", "101", "'101'", "99"),
    case("rkl2UnknownKey", append(NUMERICS, "rkl2: {steps: 11}\n"), NUMERICS, "rkl2.steps", "steps", "unknown key 'steps'", "stages"),
    case("implicitStepTooLarge", append(NUMERICS, "implicit: {step: 0.8}\n"), NUMERICS, "implicit.step", "0.8", "'0.8'", "0.5"),
    case("implicitUnknownMethod", append(NUMERICS, "implicit: {method: euler}\n"), NUMERICS, "implicit.method", "euler",
         "'euler' is not allowed", "midpoint", "backwardEuler"),
    case("implicitUnknownKey", append(NUMERICS, "implicit: {dt: 0.1}\n"), NUMERICS, "implicit.dt", "dt", "unknown key 'dt'", "step"),

    # Rigid bodies
    case("bodiesWithoutFile", with_body("")[0], BODIES, "", None, "no such file"),
    case("bodyWithoutMotion", with_body("bead: {density: 1000 kg/m^3}\n"), BODIES, "bead.motion", "bead:", "missing", "body motion"),
    case("unknownMotion", with_body("bead: {motion: fixed}\n"), BODIES, "bead.motion", "fixed", "unknown body motion 'fixed'", "Known:",
         "driven, free, held"),
    case("unknownKeyOfBody", with_body("bead: {motion: free, mass: 1}\n"), BODIES, "bead.mass", "mass", "unknown key", "Allowed: density, motion"),
    case("velocityOfHeldBody", with_body("bead: {motion: {type: held, velocity: [1 m/s, 0 m/s, 0 m/s]}}\n"), BODIES, "bead.motion.velocity",
         "velocity", "unknown key"),
    case("drivenWithoutRates", with_body("bead: {motion: driven}\n"), BODIES, "bead.motion", "motion: driven", "velocity",
         "angularVelocity", "write held"),
    case("angularVelocityInMetres", with_body("bead: {motion: {type: driven, angularVelocity: [1 m/s, 0 m/s, 0 m/s]}}\n"), BODIES,
         "bead.motion.angularVelocity[0]", "1", "m/s", "1/s"),
    case("bodyDensityNegative", with_body("bead: {density: -1 kg/m^3, motion: free}\n"), BODIES, "bead.density", "-1", "greater than 0"),
    case("bodyWithoutEntry", with_body("beed: {motion: free}\n"), BODIES, "bead", "beed:", "the body 'bead'", "system/mesh.yaml",
         "Did you mean 'beed'?"),
    case("bodyNamedAsCell", with_body("bead: {motion: free}\n", "{name: rbc, body: bead, shape: {type: sphere, radius: 2 um}, edge: 0.5 um, "
         "centre: [7 um, 0 um, 0 um]}"), MESH, "bodies[0].name", "rbc, body", "'rbc' is taken"),
    case("bodyTooThin", with_body("bead: {motion: free}\n", "{name: bead, shape: {type: spheroid, a: 3 um, c: 1 um}, edge: 0.5 um, "
         "centre: [7 um, 0 um, 0 um]}"), MESH, "bodies[0].shape", "{type: spheroid", "2 um thick", "at least 3 um"),
    case("bodyMeetsItsImage", with_body("bead: {motion: free}\n", "{name: bead, shape: {type: spheroid, a: 2 um, c: 6 um}, edge: 0.5 um, "
         "axis: [0, 1, 0], centre: [7 um, 0 um, 0 um]}"), MESH, "bodies[0].shape", "{type: spheroid", "periodic along y", "its own image", "18 um"),
    case("bodyThroughWall", with_body("bead: {motion: free}\n", "{name: bead, shape: {type: sphere, radius: 2 um}, edge: 0.5 um, "
         "centre: [7 um, 0 um, 7 um]}"), MESH, "bodies[0].centre", "[7 um, 0 um, 7 um]", "the body reaches through the wall", "along z"),
    Case("observerOfBodiesWithoutBodies", [append(OBSERVERS, "motion: {type: body, every: 10 steps}\n")],
         [Problem(OBSERVERS, "motion", "motion", ["body", "the case has none", "system/mesh.yaml"])]),

    # All at once
    Case("severalAtOnce", [replace(FLUID, "1000 kg/m^3", "1000"), replace(FLUID, "gamma: 7", "gama: 7"), replace(NUMERICS, "1 um", "1 kg"),
                           replace(CONTROL, "keep: 2", "keep: two"), replace(MESH, "h: 2.12 um, b: 1 um", "h: 2.12 um")],
         [Problem(FLUID, "density", "1000", ["no unit"]),
          Problem(FLUID, "equationOfState.gama", "gama", ["Did you mean 'gamma'?"]),
          Problem(CONTROL, "checkpoint.keep", "two", ["whole number"]),
          Problem(MESH, "cells[0].shape.b", "shape", ["missing", "thickness"]),
          Problem(NUMERICS, "spacing", "1 kg", ["is in kg"])]),
    Case("severalBetweenFiles", [replace(MESH, "[true, true, false]", "[true, true, true]"), replace(MESH, "[20 um, 16 um, 16 um]", "[20.3 um, 16 um, 16 um]"),
                                 replace(MEMBRANES, "rbc:", "red:")],
         [Problem(MEMBRANES, "rbc", "red:", ["'rbc'", "red"]),
          Problem(MESH, "domain.size", "[20.3", ["along x"]),
          Problem(MESH, "domain.periodic", "[true", ["axis z"])]),

    # -set
    setting("setNegative", "system/mesh.yaml:/cells/0/edge=-1 um", "-set", "cells[0].edge", "'-1 um'", "greater than 0"),
    setting("setUnknownKey", "constant/fluid.yaml:/viscossity=1 Pa s", "-set", "viscossity", "unknown key", "Did you mean 'viscosity'?"),
    setting("setUnknownFile", "system/meshes.yaml:/cells/0/edge=1 um", "-set", "system/meshes.yaml", "no such file",
            "Did you mean 'system/mesh.yaml'?"),
    setting("setNoSuchItem", "system/mesh.yaml:/cells/3/edge=1 um", "-set", "system/mesh.yaml:/cells/3/edge", "'3'", "0 to 0"),
    setting("setThroughNumber", "constant/fluid.yaml:/density/value=1 kg", "-set", "density", "found a table", "kg/m^3"),
    setting("setBetweenFiles", "system/mesh.yaml:/domain/periodic=[true, true, true]", "-set", "domain.periodic", "axis z", "write false"),
    setting("setBadYaml", "constant/flow.yaml:/walls={normal: z", "-set", "constant/flow.yaml:/walls", "cannot read the value"),
    setting("setWithoutEquals", "constant/fluid.yaml:/density", "checkCase", "", "expected FILE:/path/to/key=value", code=1),

    # system/relax.yaml
    relax("relaxUnknownProtocol", replace(RELAX, "tweezers", "tweezer"), "protocol.type", "tweezer", "unknown relaxation protocol 'tweezer'",
          "Did you mean 'tweezers'?", "aspiration"),
    relax("relaxNoStage", replace(RELAX, "[0 pN, 50 pN]", "[]"), "protocol", "type: tweezers", "found no stage", "'forces'"),
    relax("relaxForcesWithoutUnit", replace(RELAX, "[0 pN, 50 pN]", "[0, 50]"), "protocol.forces[0]", "0", "no unit", "N"),
    relax("relaxNegativeForce", replace(RELAX, "[0 pN, 50 pN]", "[-5 pN]"), "protocol.forces[0]", "-5", "'-5", "at least 0"),
    relax("relaxCellAndSheet", append(RELAX, "sheet: {name: rbc, diameter: 8 um, edge: 0.4 um}\n"), "sheet", "sheet", "exactly one",
          "'cell', 'sheet'"),
    relax("relaxSheetWithoutSize", rewrite(RELAX, "sheet: {name: rbc, edge: 0.4 um}\nprotocol: {type: uniaxial, stretches: [1.1]}\n"),
          "sheet", "sheet", "size", "diameter"),
    relax("relaxSheetOfThreeSides", rewrite(RELAX, "sheet: {name: rbc, edge: 0.4 um, size: [8 um, 8 um, 8 um]}\nprotocol: "
                                            "{type: uniaxial, stretches: [1.1]}\n"), "sheet.size", "[8", "3 lengths", "[8 um, 6 um]"),
    relax("relaxSheetTooCoarse", rewrite(RELAX, "sheet: {name: rbc, edge: 5 um, size: [8 um, 8 um]}\nprotocol: "
                                         "{type: uniaxial, stretches: [1.1]}\n"), "sheet.edge", "5 um", "too coarse", "at most", "4 um"),
    relax("relaxStretchZero", rewrite(RELAX, "sheet: {name: rbc, edge: 1 um, diameter: 8 um}\nprotocol: {type: uniaxial, stretches: [0]}\n"),
          "protocol.stretches[0]", "0", "greater than 0"),
    relax("relaxSoftPipette", rewrite(RELAX, "sheet: {name: rbc, edge: 1 um, diameter: 8 um}\nprotocol: {type: aspiration, radius: 1 um, "
                                      "wall: 0.4 um, softness: 0.2 um, pressures: [1 Pa]}\n"), "protocol.softness", "0.2 um",
          "through the glass", "100 nm"),
    relax("relaxNoEntry", replace(RELAX, "name: rbc", "name: rbd"), "rbd", "rbc:", "'rbd' of system/relax.yaml", "there are: rbc",
          "Did you mean 'rbc'?", file=MEMBRANES),
    relax("relaxMissingFile", remove(RELAX), "", None, "no such file"),
]
