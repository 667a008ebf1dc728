#!/usr/bin/env python3
"""caseDict, listTimes and cleanCase as a user runs them.

    caseTools.py BIN SOURCE
"""
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

BIN, SOURCE = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])


def run(program, *words, code=0):
    done = subprocess.run([str(BIN / program), *words], capture_output=True, text=True)
    assert done.returncode == code, f"{program} {words}: code {done.returncode}\n{done.stdout}{done.stderr}"
    return done.stdout + done.stderr


def text(case, file):
    return (case / file).read_text()


def dictionaries(case):
    """caseDict shows, changes, adds and removes keys; invalid values are not written."""
    said = lambda *words, code=0: run("caseDict", "-case", str(case), *words, code=code)
    assert said("constant/flow.yaml:/Ca") == "0.02\n"
    assert said("system/mesh.yaml:/domain/size", "-json").split() == ["[", '"20', 'um",', '"20', 'um",', '"20', 'um"', "]"]
    assert said("system/control.yaml", "-keys").split()[:2] == ["application", "startFrom"]
    before = text(case, "system/numerics.yaml")
    assert "0.02 -> 0.1" in said("-set", "constant/flow.yaml:/Ca=0.1")
    assert "Ca: 0.1" in text(case, "constant/flow.yaml")
    said("-set", "system/numerics.yaml:/spacing=0.5 um", "-set", "system/control.yaml:/write/strain=1", "-remove", "system/control.yaml:/stop")
    assert text(case, "system/numerics.yaml") == before.replace("spacing: 0.3333 um", "spacing: 0.5 um")
    assert "stop:" not in text(case, "system/control.yaml") and "startFrom: latestTime            # firstTime" in text(case, "system/control.yaml")
    said("-remove", "constant/flow.yaml:/Ca", "-set", "constant/flow.yaml:/shearRate=100 1/s")  # exactly one of the two keys: both change in one command

    kept = {file: text(case, file) for file in ("constant/flow.yaml", "system/control.yaml", "system/mesh.yaml")}
    for words, message in ((("-set", "system/mesh.yaml:/cells/0/egde=1 um"), "Did you mean 'edge'?"),
                           (("-set", "system/mesh.yaml:/cells/0/edge=1 Pa"), "is in Pa"),
                           (("-set", "constant/flow.yaml:/Ca=0.1"), "Ca"),
                           (("-set", "system/control.yaml:/endStrain=-1", "-set", "system/mesh.yaml:/cells/0/edge=0.5 um"), "out of range"),
                           (("-remove", "system/control.yaml:/application"), "application"),
                           (("-remove", "system/control.yaml:/nothing"), "there is no 'nothing'"),
                           (("system/mesh.yaml:/cells/7",), "its items are 0 to 0"),
                           (("-set", "system/mash.yaml:/a=1"), "Did you mean 'system/mesh.yaml'?"),
                           (("system/mash.yaml",), "Did you mean 'system/mesh.yaml'?")):
        assert message in said(*words, code=2), (words, message, said(*words, code=2))
    assert {file: text(case, file) for file in kept} == kept
    assert "say what to do" in said(code=1)
    assert "one at a time" in said("system/mesh.yaml", "-set", "constant/flow.yaml:/Ca=0.1", code=1)

    assert "a dictionary of the case is expected" in said("-set", "../case/constant/flow.yaml:/shearRate=1 1/s", code=1)
    assert "a dictionary of the case is expected" in said("README.md", code=1)
    shared = case.parent / "shared.yaml"  # a link stays a link, and permissions are kept
    (case / "system/control.yaml").rename(shared)
    (case / "system/control.yaml").symlink_to(shared)
    shared.chmod(0o640)
    said("-set", "system/control.yaml:/endStrain=5")
    assert (case / "system/control.yaml").is_symlink() and "endStrain: 5" in shared.read_text() and shared.stat().st_mode & 0o777 == 0o640
    said("-set", "system/control.yaml:/endStrain=6")
    (case / "system/control.yaml").unlink()
    shared.rename(case / "system/control.yaml")

    other = case.parent / "other"
    run("cloneCase", str(case), str(other), "-set", "system/control.yaml:/endStrain=3", "-set", "system/numerics.yaml:/implicit/step=0.02")
    different = json.loads(said("-compare", str(other), "-json"))
    assert [(d["file"], d["path"], d["first"], d["second"]) for d in different] == [
        ("system/control.yaml", "/endStrain", "6", "3"), ("system/numerics.yaml", "/implicit/step", "0.05", "0.02")], different
    said("-set", "system/mesh.yaml:/cells/0={name: red, cell: healthyRBC, edge: 1 um}")  # its shape comes from etc/cells
    assert "Did you mean 'edge'?" in said("-set", "system/mesh.yaml:/cells/0={name: red, cell: healthyRBC, edg: 1 um}", code=2)
    assert "All dictionaries say the same." in said("-compare", str(case))


def times(case):
    """listTimes of a run; cleanCase removes what it has written and nothing else."""
    coarse = ("-quiet", "-case", str(case), "-set", "system/numerics.yaml:/spacing=1.25 um", "-set", "system/mesh.yaml:/cells/0/edge=1.2 um",
              "-set", "system/control.yaml:/endStrain=0.2", "-set", "system/control.yaml:/write/strain=0.1")
    assert "neither results nor checkpoints" in run("listTimes", "-case", str(case), code=4)
    for program in ("membraneMesh", "particleFill", "dmpFlow"):
        run(program, *coarse)
    found = json.loads(run("listTimes", "-case", str(case), "-json"))
    assert [round(one["strain"], 6) for one in found] == [0, 0.1, 0.2], found
    assert found[1]["results"] == ["fluid", "rbc", "walls"] or found[1]["results"] == ["fluid", "rbc"], found
    assert found[-1]["checkpoints"] and not found[1]["checkpoints"], found
    assert json.loads(run("listTimes", "-case", str(case), "-json", "-latest")) == found[-1:]
    shown = run("listTimes", "-case", str(case)).splitlines()
    assert len(shown) == 4 and shown[0].split() == ["time", "strain", "results", "checkpoint"], shown

    (case / "notes.txt").write_text("mine")
    (case / "0" / "mine.stl").write_text("mine")
    everything = sorted(path.name for path in case.iterdir())
    assert "would remove results" in run("cleanCase", "-case", str(case), "-dry-run")
    assert sorted(path.name for path in case.iterdir()) == everything
    run("cleanCase", "-case", str(case))
    left = sorted(path.name for path in case.iterdir() if not path.name.startswith("."))
    assert left == sorted(["0", "Allclean", "Allrun", "README.md", "constant", "notes.txt", "system"]), left
    assert (case / "0" / "rbc.vtp").exists()
    run("cleanCase", "-case", str(case), "-mesh")
    assert [path.name for path in (case / "0").iterdir()] == ["mine.stl"]
    assert "nothing to remove" in run("cleanCase", "-case", str(case))
    assert "is not a case" in run("cleanCase", "-case", str(case.parent), code=2)
    assert (case.parent / "case" / "system").exists()


def main():
    with tempfile.TemporaryDirectory() as folder:
        for check in (dictionaries, times):
            case = pathlib.Path(folder) / check.__name__ / "case"
            case.parent.mkdir()
            shutil.copytree(SOURCE / "tutorials/rbcShear/Ca0.02", case, ignore=shutil.ignore_patterns("0", "results", "postProcessing", "checkpoints", "log.*",
                                                                                                     "run.json", "used.yaml", ".schema", "*.png"))
            check(case)
            print(check.__name__, "passed")


main()
