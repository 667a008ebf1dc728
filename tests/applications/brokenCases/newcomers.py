"""Natural mistakes of someone who comes from OpenFOAM, LAMMPS, Python or JSON, or who writes YAML for the first time.

Each must give one message that contains the remedy.
"""
from cases import Case, CONTROL, FLOW, FLUID, MEMBRANES, MESH, NUMERICS, OBSERVERS, Problem, append, case, replace, rewrite


def rename(old, new):
    return lambda directory: (directory / old).rename(directory / new)


def write(file, data):
    return lambda directory: (directory / file).write_bytes(data if isinstance(data, bytes) else data.encode())


def recode(file, change):
    return lambda directory: (directory / file).write_bytes(change((directory / file).read_bytes()))


def file_fault(name, edit, file, *words):
    return Case(name, edit if isinstance(edit, list) else [edit], [Problem(file, "", None, list(words))])


NEWCOMERS = [
    # From OpenFOAM
    case("foamSemicolon", replace(FLUID, "density: 1000 kg/m^3", "density: 1000 kg/m^3;"), FLUID, "density", "1000 kg/m^3;",
         "nothing ends with ';' here"),
    case("foamEntries", rewrite(FLUID, "density 1000;\nviscosity 1e-3;\n"), FLUID, "", "density", "do not end with ';'", "key: value"),
    case("foamBraces", rewrite(NUMERICS, "spacing: 1 um\nkernel\n{\n    type wendlandC2;\n}\n"), NUMERICS, "", "{", "'kernel:'", "without braces"),
    case("foamBracesOnOneLine", replace(MEMBRANES, "bonds: {type: harmonic, k: 5e-4 N/m}", "bonds { type harmonic; k 5e-4; }"), MEMBRANES, "", "bonds {",
         "'bonds: {key: value, key: value}'"),
    case("foamFirstLine", replace(CONTROL, "application:", "// my case\napplication:"), CONTROL, "", "// my", "a comment starts with '#'"),
    case("foamComment", replace(CONTROL, "endStrain: 6", "// how long\nendStrain: 6"), CONTROL, "", "// how", "a comment starts with '#'"),
    case("foamHeader", replace(FLUID, "density:", "/*---------*/\ndensity:"), FLUID, "", "/*", "a comment starts with '#'"),
    case("foamVector", replace(MESH, "axis: [0, 0, 1]", "axis: (0 0 1)"), MESH, "cells[0].axis", "(0 0 1)", "'[0, 0, 1]'"),
    case("foamVectorWithCommas", replace(MESH, "axis: [0, 0, 1]", "axis: [0 0 1]"), MESH, "cells[0].axis", "[0 0 1]", "'[0, 0, 1]'"),
    case("foamDimensions", replace(FLUID, "1.0e-3 Pa s", "[1, -1, -1, 0, 0, 0, 0] 1e-3"), FLUID, "viscosity", "[1", "a list of 7", "Pa s"),
    case("foamMacro", replace(MESH, "edge: 0.8 um", "edge: $dx"), MESH, "cells[0].edge", "$dx", "no variables", "-set"),
    case("foamCalc", replace(FLUID, "1.0e-3 Pa s", '"#calc 2*5e-4"'), FLUID, "viscosity", '"#calc', "no variables"),
    case("foamInclude", append(FLUID, '#include "water"\n'), FLUID, "", "#include", "is a comment", "Write the keys out"),
    case("foamWord", replace(CONTROL, "startFrom: latestTime", "startFrom: startTime"), CONTROL, "startFrom", "startTime", "latestTime, firstTime"),
    case("foamDeltaT", append(CONTROL, "deltaT: 1e-6 s\n"), CONTROL, "deltaT", "deltaT", "unknown key 'deltaT'", "Allowed:", "implicit: {step: 0.05}"),
    case("foamNu", append(FLUID, "nu: 1e-6 m^2/s\n"), FLUID, "nu", "nu", "unknown key 'nu'", "mu = rho nu"),
    case("foamStopAt", append(CONTROL, "stopAt: endTime\n"), CONTROL, "stopAt", "stopAt", "ends at 'endStrain' or 'endTime'"),
    case("sphDx", append(NUMERICS, "dx: 1 um\n"), NUMERICS, "dx", "dx", "unknown key 'dx'", "write 'spacing'"),
    case("foamEndTimeTwice", append(CONTROL, "endTime: 1 s\n"), CONTROL, "endTime", "endTime", "exactly one of 'endTime', 'endStrain'"),
    case("foamWriteInterval", replace(CONTROL, "strain: 0.5", "writeInterval: 0.5"), CONTROL, "write.writeInterval", "writeInterval", "Allowed: strain, time, steps", "write: {strain: 0.5}"),
    case("foamYes", replace(CONTROL, "wallClock: 2 h", "wallClock: 2 h, firstBreak: no"), CONTROL, "stop.firstBreak", "no", "true or false"),
    file_fault("foamControlDict", rename(CONTROL, "system/controlDict"), "system/controlDict", "Did you mean 'system/control.yaml'?"),
    file_fault("foamFvSchemes", write("system/fvSchemes", "ddtSchemes {}\n"), "system/fvSchemes", "no program reads this file", "numerics"),
    case("elsewhere", append(NUMERICS, "fill: {jitter: 0.2}\n"), NUMERICS, "fill", "fill", "unknown key 'fill'", "'fill' belongs in system/mesh.yaml"),
    case("elsewhereFlow", append(FLUID, "inertia: physical\n"), FLUID, "inertia", "inertia", "unknown key 'inertia'"),
    file_fault("twoOfOne", write("constant/flw.yaml", "type: shear\n"), "constant/flw.yaml", "'constant/flow.yaml', which its name is near to, is there too"),
    file_fault("foamTransport", write("constant/transportProperties", "nu 1e-6;\n"), "constant/transportProperties", "no program reads this file", "fluid"),

    # From LAMMPS
    case("lammpsInput", rewrite(CONTROL, "units si\ntimestep 1e-9\nrun 10000\n"), CONTROL, "", "units", "table of 'key: value' lines"),
    case("lammpsVariable", replace(NUMERICS, "spacing: 1 um", "spacing: ${dx}"), NUMERICS, "spacing", "${dx}", "no variables"),
    case("lammpsRun", append(CONTROL, "steps: 10000\n"), CONTROL, "steps", "steps", "unknown key 'steps'", "Allowed:"),
    case("lammpsBoundary", replace(MESH, "[true, true, false]", "[p, p, f]"), MESH, "domain.periodic[0]", "p", "true or false"),
    case("lammpsBoundaryWord", replace(MESH, "[true, true, false]", "p p f"), MESH, "domain.periodic", "p p f", "[true, true, false]"),
    case("lammpsLj", replace(NUMERICS, "spacing: 1 um", "spacing: 1 lj"), NUMERICS, "spacing", "1 lj", "unknown unit 'lj'", "um"),
    case("lammpsKT", replace(MEMBRANES, "Eb: 0.01", "kappa: 50 kT"), MEMBRANES, "rbc.bending.kappa", "50 kT", "unknown unit 'kT'", "pN nm"),

    # Units
    case("unitCapital", replace(MESH, "d: 8 um", "d: 8 uM"), MESH, "cells[0].shape.d", "8 uM", "Did you mean 'um'?"),
    case("unitMicron", replace(MESH, "d: 8 um", "d: 8 microns"), MESH, "cells[0].shape.d", "8 microns", "Did you mean 'um'?"),
    case("unitSeconds", replace(CONTROL, "wallClock: 5 min", "wallClock: 300 sec"), CONTROL, "checkpoint.wallClock", "300 sec", "Did you mean 's'?"),
    case("unitWithoutCaret", replace(FLUID, "1000 kg/m^3", "1000 kg/m3"), FLUID, "density", "1000 kg/m3", "Did you mean 'kg/m^3'?"),
    case("unitJoined", replace(FLUID, "1.0e-3 Pa s", "1.0 mPas"), FLUID, "viscosity", "1.0 mPas", "Did you mean 'mPa s'?"),
    case("unitOfCentipoise", replace(FLUID, "1.0e-3 Pa s", "1 cp"), FLUID, "viscosity", "1 cp", "Did you mean 'cP'?"),
    case("unitKinematic", replace(FLUID, "1.0e-3 Pa s", "1e-6 m^2/s"), FLUID, "viscosity", "1e-6 m^2/s", "is in m^2/s", "in Pa s"),
    case("unitStiffnessPerArea", replace(MEMBRANES, "5e-4 N/m", "5e-4 Pa"), MEMBRANES, "rbc.bonds.k", "5e-4 Pa", "is in Pa", "in N/m"),
    case("unitInBrackets", replace(NUMERICS, "spacing: 1 um", "spacing: 1 [um]"), NUMERICS, "spacing", "1 [um]", "unknown unit '[um]'", "um"),
    case("unitAmbiguous", replace(MEMBRANES, "rupture: none", "rupture: none\n  viscosity: {shear: 1e-7 N/m s}"), MEMBRANES, "rbc.viscosity.shear",
         "1e-7 N/m s", "not read", "N s/m"),
    case("unitPercent", replace(MEMBRANES, "rupture: none", "rupture: {type: arealStrain, limit: 4 %}"), MEMBRANES, "rbc.rupture.limit", "4 %",
         "divide by 100"),
    case("unitFirst", replace(NUMERICS, "spacing: 1 um", "spacing: um 1"), NUMERICS, "spacing", "um 1", "does not start with a number"),

    # Numbers
    case("decimalComma", replace(NUMERICS, "spacing: 1 um", "spacing: 0,5 um"), NUMERICS, "spacing", "0,5 um", "'0.5 um'"),
    case("fraction", replace(NUMERICS, "spacing: 1 um", "spacing: 1/2 um"), NUMERICS, "spacing", "1/2 um", "expressions are not evaluated"),
    case("product", replace(MEMBRANES, "5e-4 N/m", "5*10^-4 N/m"), MEMBRANES, "rbc.bonds.k", "5*10", "expressions are not evaluated"),
    case("timesTen", replace(MEMBRANES, "5e-4 N/m", "5 x 10^-4 N/m"), MEMBRANES, "rbc.bonds.k", "5 x 10", "expressions are not evaluated"),
    case("unicodeMinus", replace(MESH, "[0 um, 0 um, 0 um]", "[\u22121 um, 0 um, 0 um]"), MESH, "cells[0].centre[0]", "", "write '-'"),
    case("hexadecimal", replace(MESH, "    axis: [0, 0, 1]\n", "    axis: [0, 0, 1]\nfill: {seed: 0x10}\n"), MESH, "fill.seed", "0x10", "decimal"),
    case("nan", replace(FLOW, "Ca: 0.02", "Ca: nan"), FLOW, "Ca", "nan", "not a finite number"),
    case("infinity", replace(CONTROL, "endStrain: 6", "endStrain: .inf"), CONTROL, "endStrain", ".inf", "not a finite number"),
    case("tooLarge", replace(FLOW, "Ca: 0.02", "Ca: 1e400"), FLOW, "Ca", "1e400", "between 1e-100 and 1e+100"),
    case("tooSmall", replace(MEMBRANES, "5e-4 N/m", "5e-400 N/m"), MEMBRANES, "rbc.bonds.k", "5e-400", "between 1e-100 and 1e+100"),
    case("productTooLarge", [replace(MEMBRANES, "5e-4 N/m", "5e90 N/m"), replace(FLOW, "Ca: 0.02", "Ca: 1e90")], FLOW, "", "type",
         "cannot be computed with"),
    case("grouped", replace(CONTROL, "endStrain: 6", "endStrain: 1_000"), CONTROL, "endStrain", "1_000", "not grouped"),
    case("wholeWithUnit", replace(CONTROL, "keep: 2", "keep: 2 files"), CONTROL, "checkpoint.keep", "2 files", "is not a whole number"),

    # YAML
    case("noBlankAfterColon", replace(FLUID, "density: 1000", "density:1000"), FLUID, "", "density:1000", "a blank is missing after the ':'",
         "'density: 1000 kg/m^3'"),
    case("noBlankInBraces", replace(FLOW, "{Re: 0.1}", "{Re:0.1}"), FLOW, "", "Re:0.1", "a blank is missing after the ':'", "'Re: 0.1'"),
    case("equalsSign", replace(FLUID, "density: 1000", "density = 1000"), FLUID, "", "density =", "'=' in place of ':'", "'density: 1000 kg/m^3'"),
    case("tabAfterColon", replace(FLUID, "density: 1000", "density:\t1000"), FLUID, "", "\t1000", "a tab"),
    case("keyInOtherCase", replace(CONTROL, "endStrain: 6", "endstrain: 6"), CONTROL, "endstrain", "endstrain", "Did you mean 'endStrain'?"),
    case("keyTwiceInOtherCase", append(FLUID, "Density: 900 kg/m^3\n"), FLUID, "Density", "Density", "unknown key 'Density'",
         "Did you mean 'density'? It is given already in line 2"),
    case("keyTwice", append(CONTROL, "endStrain: 7\n"), CONTROL, "endStrain", "endStrain: 7", "twice", "line 4"),
    case("nullValue", replace(NUMERICS, "spacing: 1 um", "spacing: null"), NUMERICS, "spacing", "spacing", "found nothing", "in m"),
    case("tildeValue", replace(MEMBRANES, "rupture: none", "rupture: ~"), MEMBRANES, "rbc.rupture", "rupture", "found nothing"),
    case("noneForNull", replace(CONTROL, "stop: {file: stop, wallClock: 2 h}", "stop: {wallClock: none}"), CONTROL, "stop.wallClock", "none", "'none'",
         "or never"),
    case("quotedTrue", replace(MESH, "[true, true, false]", '["true", true, false]'), MESH, "domain.periodic[0]", '"true"', "without quotation marks"),
    case("nameIsYes", replace(MESH, "name: rbc", "name: yes"), MESH, "cells[0].name", "yes", "'yes' is not a name"),
    case("oneObserverWithoutName", rewrite(OBSERVERS, "type: shape\nevery: 0.02 strain\n"), OBSERVERS, "", "type", "name of its own", "NAME: {type: ...}"),
    case("observersAsList", rewrite(OBSERVERS, "- {type: shape, every: 0.02 strain}\n"), OBSERVERS, "", "- {type", "a list of 1", "table"),
    case("membraneWithoutName", rewrite(MEMBRANES, "bonds: {type: harmonic, k: 5e-4 N/m}\n"), MEMBRANES, "", "bonds", "name of its own"),
    case("modelAsKey", replace(NUMERICS, "kernel: {type: wendlandC2, support: 3.0 dx}", "kernel: {wendlandC2: {support: 3.0 dx}}"), NUMERICS, "kernel",
         "kernel", "'type' is missing", "type: wendlandC2"),
    case("jsonTrailing", rewrite(FLUID, '{"density": "1000 kg/m^3", "viscosity": 1e-3}\n'), FLUID, "viscosity", "1e-3", "no unit"),
    case("dashForTable", replace(CONTROL, "checkpoint: {wallClock: 5 min, keep: 2}", "checkpoint:\n  - wallClock: 5 min\n  - keep: 2"), CONTROL, "checkpoint",
         "checkpoint", "a list of 2", "table"),
    case("listItemsMisaligned", replace(MESH, "    edge: 0.8 um", "   edge: 0.8 um"), MESH, "", "edge", "indented wrongly"),
    case("singleCell", replace(MESH, "  - name: rbc\n    shape", "    name: rbc\n    shape"), MESH, "cells", "cells", "a table", "a list"),
    case("multiLine", replace(FLUID, "1.0e-3 Pa s", "|\n  1.0e-3 Pa s\n  2.0e-3 Pa s"), FLUID, "viscosity", "|", "Pa s"),

    # Files
    file_fault("ymlEnding", rename(OBSERVERS, "system/observers.yml"), "system/observers.yml", "Rename it to system/observers.yaml"),
    file_fault("observerWithoutS", rename(OBSERVERS, "system/observer.yaml"), "system/observer.yaml", "Did you mean 'system/observers.yaml'?"),
    file_fault("membraneWithoutS", rename(MEMBRANES, "constant/membrane.yaml"), "constant/membrane.yaml", "Did you mean 'constant/membranes.yaml'?"),
    file_fault("wrongFolder", rename(MEMBRANES, "system/membranes.yaml"), "system/membranes.yaml", "move it to constant/membranes.yaml"),
    file_fault("besideTheFolders", rename(FLUID, "fluid.yaml"), "fluid.yaml", "move it to constant/fluid.yaml"),
    file_fault("folderInCapitals", rename("system", "System"), "System/", "Did you mean 'system/'?"),
    file_fault("utf16", recode(FLUID, lambda b: b.decode().encode("utf-16")), FLUID, "UTF-16", "save it as UTF-8"),
    case("latin1", recode(FLUID, lambda b: b + "# Viskosit\u00e4t\n".encode("latin-1")), FLUID, "", "", "0xE4", "UTF-8"),
    case("nulBytes", recode(FLUID, lambda b: b + b"\0\0\0"), FLUID, "", "\0", "0x00", "not a text file"),
]

# Input that looks wrong but is valid.
GOOD = {
    "byteOrderMark": recode(FLUID, lambda b: b"\xef\xbb\xbf" + b),
    "windowsLines": recode(MESH, lambda b: b.replace(b"\n", b"\r\n")),
    "oldMacLines": recode(FLOW, lambda b: b.replace(b"\n", b"\r")),
    "quotedQuantity": replace(NUMERICS, "spacing: 1 um", "spacing: '1 um'"),
    "quotedNumber": replace(FLOW, "Ca: 0.02", 'Ca: "0.02"'),
    "blankBeforeColon": replace(FLUID, "density: 1000", "density : 1000"),
    "inlineComment": replace(FLUID, "1000 kg/m^3", "1000 kg/m^3  # of water"),
    "foldedText": replace(FLUID, "1000 kg/m^3", ">-\n  1000\n  kg/m^3"),
    "capitalTrue": replace(MESH, "[true, true, false]", "[True, TRUE, False]"),
    "noFinalNewline": recode(FLOW, lambda b: b.rstrip(b"\n")),
    "documentStart": recode(FLOW, lambda b: b"%YAML 1.2\n---\n" + b + b"...\n"),
    "unicodeUnits": replace(FLUID, "1000 kg/m^3", "1000 kg/m\u00b3"),
    "centipoise": replace(FLUID, "1.0e-3 Pa s", "1 cP"),
    "dottedUnit": replace(FLUID, "1.0e-3 Pa s", "1 mPa.s"),
    "dynesPerCentimetre": replace(MEMBRANES, "5e-4 N/m", "0.5 dyn/cm"),
    "editorBackups": [write("system/mesh.yaml~", "x"), write("system/.mesh.yaml.swp", "x"), write("constant/fluid.yaml.orig", "x"), write("system/README", "x")],
    "surfaceInConstant": write("constant/cell.stl", "solid\nendsolid\n"),
}
