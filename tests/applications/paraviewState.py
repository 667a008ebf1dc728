#!/usr/bin/python3
"""paraviewState: what the script says of a real run, against the files as VTK reads them; what cannot be shown; every tutorial has one. (ParaView itself:
tests/paraview/states.)

    paraviewState.py BIN SOURCE
"""
import ast
import json
import os
import pathlib
import subprocess
import sys
import tempfile

BIN, SOURCE = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
sys.path.insert(0, str(SOURCE / "python"))

import numpy  # noqa: E402

import corpuscle  # noqa: E402
import pythonProgram  # noqa: E402

os.environ["CORPUSCLE_BIN"] = str(BIN)
run, refused = pythonProgram.runs(BIN / "paraviewState")
SHORT = ["system/control.yaml:/endStrain=0.1", "system/control.yaml:/write/strain=0.05", "system/numerics.yaml:/spacing=1.25 um", "system/mesh.yaml:/cells/0/edge=1.2 um"]


def parsed(script):
    """The dictionary CASE of a script, and the modules that it imports."""
    tree = ast.parse(script.read_text())
    facts = next(ast.literal_eval(node.value) for node in tree.body if isinstance(node, ast.Assign) and node.targets[0].id == "CASE")
    return facts, {one.name for node in ast.walk(tree) if isinstance(node, ast.Import) for one in node.names} | \
        {node.module for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)}


def near(found, expected):
    assert numpy.allclose(found, expected, rtol=1e-9, atol=0), (found, expected)


def state(case):
    run(case)
    script = case / "postProcessing/paraviewState.py"
    facts, modules = parsed(script)
    assert modules == {"builtins", "os", "sys", "paraview.simple"}, modules
    home = script.parent / facts["folder"]
    assert home.resolve() == case.resolve() and all((home / f"results/{name}.pvd").is_file() for name in ["fluid", facts["first"], *facts["surfaces"]])
    assert facts["surfaces"] == facts["coloured"] == ["rbc"] and facts["torn"] == [] and facts["walls"] and not facts["vessel"], facts
    size = subprocess.run([BIN / "caseDict", "-case", case, "system/mesh.yaml:/domain/size"], check=True, capture_output=True, text=True).stdout
    near(numpy.array(facts["box"]) * 1e6, [float(word) for word in size.replace("um", "").strip(" []\n").split(",")])
    assert facts["periodic"] == [True, True, False], facts
    rows = json.loads(subprocess.run([BIN / "listTimes", "-case", case, "-json"], check=True, capture_output=True).stdout)
    near(facts["times"], [row["time_s"] for row in rows])
    one = corpuscle.Case(case)
    surfaces = [one.surface("rbc", time) for time in facts["times"]]
    largest = max(abs(surface.cellData["areaStrain"]).max() for surface in surfaces)
    assert facts["field"]["array"] == "areaStrain" and facts["field"]["association"] == "CELLS", facts["field"]
    near(facts["field"]["range"], [-largest, largest])
    fluid = [one.particles(time) for time in facts["times"]]
    speed = max(numpy.linalg.norm(now.pointData["velocity"], axis=1).max() for now in fluid)
    assert facts["fluid"]["component"] == "X" and facts["slice"] == {"axis": "y", "at": 0.0}, facts["fluid"]
    near(facts["fluid"]["range"], [-speed, speed])
    near(facts["spacing"], 1.25e-6)
    for k, surface in enumerate(surfaces):  # the text of each time, as ParaView evaluates it
        text = eval(facts["label"], {"np": numpy, "time_value": facts["times"][k]})
        assert text.startswith(f"strain {surface.strain:.4g}, t = "), text
    return one, surfaces, fluid


def choices(case, surfaces, fluid, folder):
    """Options; a script in another folder."""
    script = folder / "elsewhere/of any name.py"
    answer = json.loads(run(case, "-json", "-field", "stretch", "-fluidField", "pressure", "-slice", "z=-2 um", "-output", script))
    assert answer == {"output": str(script)}, answer
    facts, _ = parsed(script)
    assert (script.parent / facts["folder"]).resolve() == case.resolve()
    assert facts["slice"] == {"axis": "z", "at": -2e-6} and facts["field"]["association"] == "POINTS", facts
    values = numpy.concatenate([one.pointData["stretch"] for one in surfaces])
    near(facts["field"]["range"], [values.min(), values.max()])
    pressures = numpy.concatenate([one.pointData["pressure"] for one in fluid])
    assert pressures.min() < 0 < pressures.max()
    near(facts["fluid"]["range"], numpy.array([-1, 1]) * abs(pressures).max())
    run(case, "-field", "none", "-slice", "none")
    facts, _ = parsed(case / "postProcessing/paraviewState.py")
    assert facts["field"] is None and facts["coloured"] == [] and facts["fluid"] is None, facts


def faults(case, folder):
    refused(case, 1, ["-field areaStran: the results have no such array", "did you mean 'areaStrain'?"], "-field", "areaStran")
    refused(case, 1, ["-fluidField presure", "did you mean 'pressure'?", "speed"], "-fluidField", "presure")
    refused(case, 1, ["-slice q: an axis is expected", "y=2 um"], "-slice", "q")
    refused(case, 1, ["-slice y=2", "a unit"], "-slice", "y=2")
    refused(case, 1, ["the box reaches from -"], "-slice", "y=90 um")
    refused(case, 1, ["is not paraview.py"], "-output", folder / "paraview.py")
    refused(case, 1, ["unknown option '-feld'", "Did you mean '-field'?"], "-feld", "none")
    refused(folder / "nowhere", 4, ["there is no such directory"])
    subprocess.run([BIN / "cleanCase", "-quiet", "-case", case], check=True)
    assert not (case / "postProcessing").exists()
    refused(case, 4, ["has no results", "run its solver first (membraneMesh, particleFill, dmpFlow)"])


def main():
    missing = [path for path in SOURCE.glob("tutorials/**/Allrun") if "paraviewState" not in path.read_text()]
    assert not missing, f"these tutorials leave no state for ParaView: {missing}"
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        case = folder / "one"
        subprocess.run([BIN / "cloneCase", SOURCE / "tutorials/rbcShear/Ca0.02", case, "-quiet"] + sum((["-set", one] for one in SHORT), []), check=True)
        for program in ("membraneMesh", "particleFill", "dmpFlow"):
            subprocess.run([BIN / program, "-quiet", "-case", case], check=True)
        _, surfaces, fluid = state(case)
        choices(case, surfaces, fluid, folder)
        faults(case, folder)


main()
