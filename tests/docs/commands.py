#!/usr/bin/env python3
"""Every command of the documentation works: the shell blocks of its pages are run unchanged, on cases made coarse and short.

    commands.py BIN SOURCE

A shell block that is not run here is a fault, and so is an option, anywhere in the pages, that its program does not know.
"""
import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

BIN, SOURCE = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
COARSE = ["system/numerics.yaml:/spacing=1.25 um", "system/mesh.yaml:/cells/0/edge=1 um"]

# Blocks that are run elsewhere, by their first words, and where.
ELSEWHERE = {
    "./Allrun      # installs": "Alltest builds; test tutorials.rbcShear",
    "./Alltest                 #": "itself",
    "cmake --preset release": "Alltest",
    "./Allrun                                       # or cmake": "etc.install",
    "cd build && cpack": "by hand, in a clean Debian 12",
    "newModel law mySpring -plugin": "etc.install",
    "cloneCase tutorials/rbcShear/Ca0.02 firstCell   # a path": "etc.install",
    "cmake -S . -B build -G Ninja -DCORPUSCLE_BENCHMARKS=ON": "benchmarks are run by hand",
    "./Allrun                                                    # haematocrits": "tutorials.bloodViscosity",
    "./Allrun                                    # eight stresses": "tutorials.haemolysisMap",
}
# Preparation before the blocks of a page are run: functions and cases. `here` is a folder that looks like the repository.
CLONE = """
cloneCase() { command cloneCase "$@" && [[ $1 == *tweezers* ]] || coarse "$2"; }
coarse() { caseDict -quiet -case "$1" %s; }
""" % " ".join(f"-set '{change}'" for change in COARSE)
SESSIONS = {
    "README.md": (CLONE, ["myCell/postProcessing/renderCase.png", "myCell/postProcessing/deformation/rbc.csv"]),
    "docs/quickstart.md": (CLONE, ["home/firstCell/postProcessing/flow.png", "home/firstCell/postProcessing/D12.png", "home/cases/report.html",
                                   "home/myTweezers/postProcessing/renderCase.png"]),
    "docs/renderCase.md": (CLONE + """
cloneCase tutorials/rbcShear/Ca0.02 myCell && cd myCell && membraneMesh && particleFill && dmpFlow
command -v ffmpeg >/dev/null || { mkdir ffmpeg && printf '#!/bin/sh\\nfor last; do :; done; echo >$last' >ffmpeg/ffmpeg && chmod +x ffmpeg/ffmpeg && PATH=$PATH:$PWD/ffmpeg; }
""", ["myCell/postProcessing/film/frame_0000.png"]),
    "docs/caseReport.md": (CLONE + """
cloneCase tutorials/rbcShear/Ca0.02 myCell && cd myCell && caseDict -quiet -set system/control.yaml:/endStrain=0.5
membraneMesh && particleFill && dmpFlow && printf 'strain,D12_extent\\n0,0.58\\n0.4,0.58\\n' >myReference.csv
for name in fine medium coarse; do mkdir $name && cp -r 0 constant system postProcessing results run.json used.yaml log.* $name; done
""", ["myCell/postProcessing/report.html", "myCell/cell.html", "myCell/fine/postProcessing/report.html"]),
    "docs/paraview.md": (CLONE + """
cloneCase tutorials/rbcShear/Ca0.02 myCell && cd myCell && caseDict -quiet -set system/control.yaml:/endStrain=0.1
membraneMesh && particleFill && dmpFlow
""", ["myCell/postProcessing/paraviewState.py", "myCell/across.py"]),
    "docs/study.md": (CLONE + """
cloneCase tutorials/rbcShear/Ca0.02 myCell
cp page.yaml study.yaml
caseDict() { :; }
""", ["cases/summary.csv"]),
    "docs/packing.md": ("""
cloneCase tutorials/suspension blood && cp system_*.yaml blood/system && cd blood
for name in mesh pack; do mv system/system_$name.yaml system/$name.yaml; done
caseDict -quiet -set 'system/numerics.yaml:/spacing=1 um' -set 'system/control.yaml:/endStrain=0.05' -set 'constant/contact.yaml:/law/reach=0.1 um'
caseDict -quiet -set 'constant/membranes.yaml:/platelet={triangles: {type: skalak, Gs: 1e-4 N/m, C: 1}, bending: {type: dihedral, Eb: 0.01}}'
""", ["blood/constant/redCells.csv", "blood/constant/platelets.csv", "blood/results/platelet.pvd"]),
    "docs/observers.md": ("""
cloneCase tutorials/capsuleShear dilute && cd dilute
caseDict -quiet -set 'system/numerics.yaml:/spacing=1 um' -set 'system/mesh.yaml:/domain={size: [12 um, 12 um, 12 um], periodic: [true, true, true]}' \\
    -set 'system/mesh.yaml:/cells/0/edge=1 um' -set 'constant/flow.yaml:/type=leesEdwards' -remove constant/flow.yaml:/walls
caseDict -quiet -remove system/observers.yaml:/wall -set 'system/observers.yaml:/blood={type: suspension, every: 0.1 strain}' \\
    -set 'system/control.yaml:/endStrain=6' -set 'system/numerics.yaml:/implicit/step=0.1'
membraneMesh && particleFill && dmpFlow
cloneCase ../tutorials/couette ../channel
caseDict -quiet -case ../channel -set 'system/observers.yaml:/mean={type: profile, every: 0.005 s, axis: z, bins: 8}' \\
    -set 'system/numerics.yaml:/spacing=62.5 um' -set 'system/mesh.yaml:/domain/size=[0.5 mm, 0.5 mm, 1 mm]'
particleFill -case ../channel && sphFlow -case ../channel && cp -r ../channel/postProcessing/mean postProcessing
""", []),
    "docs/membrane.md": (CLONE + """
cloneCase tutorials/rbcShear/Ca0.02 myCase
cloneCase tutorials/tweezers blownUp
caseDict -quiet -case blownUp -set 'system/relax.yaml:/protocol={type: resting}' -set 'system/relax.yaml:/cell/edge=1 um' \\
    -set 'constant/membranes.yaml:/rbc/volume={modulus: 1 kPa, reducedVolume: 0.95}'
""", ["myCase/constant/stressFree.vtp"]),
}
# Pages whose YAML is the input of their commands: how each block is shortened.
SHORTER = [("[0.6667 um, 0.5 um]", "[1.25 um, 1 um]"), ("[0.7 um, 0.525 um]", "[1 um, 0.95 um]"), ("endStrain=6", "endStrain=0.4"), ("from: 3 strain", "from: 0.2 strain"),
           ("endStrain=2", "endStrain=0.5")]


def pages():
    found = subprocess.run(["git", "-C", str(SOURCE), "ls-files", "*.md"], capture_output=True, text=True)
    names = found.stdout.split() or [str(path.relative_to(SOURCE)) for path in SOURCE.rglob("*.md") if "build" not in path.parts[0]]
    return {name: (SOURCE / name).read_text() for name in sorted(names)}


def blocks(text, language=""):
    return [body for name, body in re.findall(r"^```(\w*)\n(.*?)^```", text, re.M | re.S) if name == language]


def isShell(block):
    first = block.split()[0]
    return first in KNOWN or first in ("export", "cd", "cp", "mpirun", "cmake", "ninja", "gnuplot", "newModel") or first.startswith("./") or block.startswith("corpuscle=")


def programs():
    """The options of each program, as it lists them itself."""
    known = {}
    for path in sorted(BIN.iterdir()):
        if path.name.startswith(("test_", "fuzz")) or not os.access(path, os.X_OK) or path.is_dir():
            continue
        done = subprocess.run([str(path), "-help", "-json"], capture_output=True, text=True, timeout=60)
        try:
            known[path.name] = {option["name"] for option in json.loads(done.stdout)["options"]} | {"help", "version"}
        except (ValueError, KeyError):
            pass  # a benchmark
    return known


KNOWN = programs()


def run(page, text):
    prelude, expected = SESSIONS[page]
    with tempfile.TemporaryDirectory() as folder:
        here = pathlib.Path(folder)
        for name in ("tutorials", "etc", "python"):
            (here / name).symlink_to(SOURCE / name)
        (here / "build").mkdir()
        (here / "build/bin").symlink_to(BIN)
        (here / "home").mkdir()
        for old, new in SHORTER:
            text = text.replace(old, new)
        for yaml in blocks(text, "yaml"):
            (here / "page.yaml").exists() or (here / "page.yaml").write_text(yaml)
            parts = re.split(r"^# system/(\w+)\.yaml.*\n", yaml, flags=re.M)
            for name, part in zip(parts[1::2], parts[2::2]):
                (here / f"system_{name}.yaml").write_text(part)
        script = "set -eo pipefail\n" + prelude
        for block in blocks(text):
            if isShell(block) and not any(block.startswith(words) for words in ELSEWHERE):
                script += block
        environment = dict(os.environ, PATH=f"{BIN}:{os.environ['PATH']}", HOME=str(here / "home"))
        done = subprocess.run(["bash", "-c", script], cwd=here, env=environment, capture_output=True, text=True, timeout=600)
        assert done.returncode == 0, f"{page}: code {done.returncode}\n{script}\n{done.stdout[-3000:]}\n{done.stderr[-3000:]}"
        for file in expected:
            assert (here / file).exists(), f"{page}: its commands did not make {file}\n{done.stdout[-2000:]}"


def uncovered(page, text):
    return [f"{page}: no test runs '{block.splitlines()[0]}'" for block in blocks(text) if isShell(block) and page not in SESSIONS
            and not any(block.startswith(words) for words in ELSEWHERE)]


def unknownOptions(page, text):
    """Unknown options of commands, in blocks and in sentences."""
    found = []
    commands = [line for block in blocks(text) if isShell(block) for line in block.splitlines()] + re.findall(r"(?<!`)`([^`\n]+)`(?!`)", text)
    for command in commands:
        command = re.sub(r"\s#.*", "", command)
        for part in re.split(r"&&|;|\|", command):
            words = part.split()
            if words[:2] == ["mpirun", "-np"]:
                words = words[3:]
            if not words or words[0] not in KNOWN:
                continue
            options = re.findall(r"(?<=\s)-([a-zA-Z][\w-]*)", re.sub(r"'[^']*'|\"[^\"]*\"", "", " ".join(words)))
            found += [f"{page}: {words[0]} has no option -{option}: {command}" for option in options if option not in KNOWN[words[0]]]
    return found


def main():
    faults = []
    for page, text in pages().items():
        faults += uncovered(page, text) + unknownOptions(page, text)
    assert not faults, "\n".join(faults)
    assert len(KNOWN) >= 15, KNOWN
    chosen, texts = sys.argv[3:] or SESSIONS, pages()
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        for page, _ in zip(chosen, pool.map(lambda page: run(page, texts[page]), chosen)):
            print(page, "passed", flush=True)


main()
