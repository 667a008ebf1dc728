"""The used.yaml that a run writes is valid YAML for every reader, and can be read again: each of its tables is a dictionary.

    python3 usedFile.py SOURCE BIN READER

Tested for a case with cells, one with rigid bodies, and a relaxation. Their schemas are in .schema/ of the case, as the first lines of
the dictionaries name them.
"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import yaml

import yaml12
from reader import Reader, Schemas

BODIES = {"system/mesh.yaml": "domain: {size: [12 um, 12 um, 12 um], periodic: [true, true, false]}\n"
                              "bodies: [{name: bead, shape: {type: sphere, radius: 3 um}, edge: 1 um}]\n",
          "constant/bodies.yaml": "bead: {density: 1.2 g/cm^3, motion: free}\n",
          "constant/flow.yaml": "{type: shear, shearRate: 100 1/s, inertia: {Re: 0.1}}\n",
          "system/observers.yaml": "motion: {type: body, every: 10 steps}\n",
          "system/numerics.yaml": "spacing: 1 um\n"}


def run(bin, case, *command):
    result = subprocess.run([bin / command[0], *command[1:], "-quiet", "-case", case], capture_output=True, text=True, timeout=200)
    assert result.returncode in (0, 5), f"{command}: exit code {result.returncode}\n{result.stdout}{result.stderr}"


def check(source, case, reader, schemas):
    text = (case / "used.yaml").read_text()
    faults = []
    for which, load in (("YAML 1.1", yaml.safe_load), ("YAML 1.2", yaml12.load)):
        for file, table in load(text).items():
            faults += [f"{file}: schema, {which}: {f}" for f in schemas.faults(file, table)]
    # The lines below "file:", less their indentation.
    for file, body in re.findall(r"^(\S+\.yaml):(.*?)(?=^\S|\Z)", text, re.MULTILINE | re.DOTALL):
        dictionary = re.sub(r"^  ", "", body.lstrip("\n"), flags=re.MULTILINE).lstrip(" ")
        faults += [f"{file}: reader: {p}" for p in reader.problems(file, dictionary)]
    lint = subprocess.run(["yamllint", "-s", "-c", source / ".yamllint", case / "used.yaml"], capture_output=True, text=True)
    if lint.returncode:
        faults.append(lint.stdout + lint.stderr)
    for dictionary in [*case.glob("system/*.yaml"), *case.glob("constant/*.yaml")]:
        schema = case / ".schema" / f"{dictionary.stem}.json"
        if not schema.exists() or schema.read_text() != (source / "etc/schema" / schema.name).read_text():
            faults.append(f"{schema} is missing or not that of etc/schema")
    return [f"{case.name}: {f}" for f in faults]


def main():
    source, bin, program = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve(), sys.argv[3]
    faults = []
    with tempfile.TemporaryDirectory() as top:
        top = pathlib.Path(top)
        reader = Reader(program, top / "schemas")
        reader.problems("system/observers.yaml", "")
        schemas = Schemas(top / "schemas")
        for name in ("cells", "bodies", "relax"):
            case = top / name
            shutil.copytree(source / "tests/applications/brokenCases/baseCase", case)
            if name == "bodies":
                (case / "constant/membranes.yaml").unlink()
                (case / "system/relax.yaml").unlink()
                for file, text in BODIES.items():
                    (case / file).write_text(text)
            if name == "relax":
                run(bin, case, "membraneRelax")
            else:
                run(bin, case, "membraneMesh")
                run(bin, case, "particleFill")
                run(bin, case, "dmpFlow", "-steps", "1")
            faults += check(source, case, reader, schemas)
        reader.close()
    print("\n".join(faults + [f"{len(faults)} faults"]))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
