"""Every dictionary of the repository is valid YAML for the reader, PyYAML, yamllint, and its JSON schema.

    python3 repositoryFiles.py SOURCE READER      READER: readDictionaries

Values are tested with the types of PyYAML (YAML 1.1) and with those of editors (YAML 1.2). The first line names the schema. The schemas in
etc/schema are those of the programs, and their messages name the wrong key.
"""
import pathlib
import subprocess
import sys
import tempfile

import yaml

import yaml12
from reader import Reader, Schemas

FOLDER = {"control": "system", "numerics": "system", "mesh": "system", "relax": "system", "observers": "system", "pack": "system",
          "fluid": "constant", "membranes": "constant", "bodies": "constant", "contact": "constant", "flow": "constant"}


def dictionaries(source):
    listed = subprocess.run(["git", "-C", str(source), "ls-files", "-z", "*.yaml", "*.yml"], capture_output=True, text=True)
    files = [pathlib.Path(f) for f in listed.stdout.split("\0") if f]
    if not files:  # no repository: a release
        files = [f.relative_to(source) for part in ("tutorials", "tests", "etc", "benchmarks") for f in (source / part).rglob("*.yaml")]
    return sorted(f for f in files if (source / f).exists())


def kind(file):
    if file.name == "study.yaml":
        return file.name
    if file.parent.name == "cells":
        return "constant/cells/cell.yaml"
    return f"{file.parent.name}/{file.name}" if file.parent.name in ("system", "constant") else None


def check(source, file, reader, schemas):
    text = (source / file).read_text()
    name = kind(file)
    if name is None or name != "study.yaml" and FOLDER.get(pathlib.PurePath(name).stem, "cells") != pathlib.PurePath(name).parent.name:
        return [f"{file}: no dictionary stands there"]
    faults = [f"{file}: reader: {p}" for p in reader.problems(name, text)]
    up = "../../" if name.startswith("constant/cells/") else "" if name == "study.yaml" else "../"
    first = f"# yaml-language-server: $schema={up}.schema/{pathlib.PurePath(name).stem}.json"
    if text.split("\n")[0] != first:
        faults.append(f"{file}: the first line is not '{first}'")
    for which, load in (("YAML 1.1", yaml.safe_load), ("YAML 1.2", yaml12.load)):
        faults += [f"{file}: schema, {which}: {f}" for f in schemas.faults(name, load(text))]
    return faults


# What a message of python3-jsonschema has to name: file, text, and parts of one of the messages.
MESSAGES = [
    ("system/numerics.yaml", "spacing: 8 Pa", ["spacing: '8 Pa'"]),
    ("system/numerics.yaml", "spacing: -8 um", ["spacing: '-8 um'"]),
    ("system/numerics.yaml", "spacing: 8", ["spacing: 8 is not of type 'string'"]),
    ("system/numerics.yaml", "spacing: 1 um\nsafety: 1.5", ["safety: 1.5 is greater than the maximum of 1"]),
    ("system/numerics.yaml", "spacing: 1 um\nkernel: {type: lucy, suport: 3 dx}", ["kernel: ", "'suport' was unexpected"]),
    ("system/numerics.yaml", "spacing: 1 um\nkernel: lucky", ["kernel: 'lucky' is not one of ['lucy'"]),
    ("constant/flow.yaml", "type: shear\nCa: 0.02\nshearRate: 1 1/s", ["'Ca'", "'shearRate'"]),
    ("constant/flow.yaml", "type: shear", ["'Ca' is a required property"]),
    ("constant/flow.yaml", "type: sheer\nCa: 1", ["type: 'sheer' is not one of"]),
    ("constant/membranes.yaml", "rbc: {bonds: {type: harmonic, k: 1 N}}", ["rbc/bonds/k: '1 N'"]),
    ("constant/membranes.yaml", "rbc: {bonds: harmonic}", ["rbc/bonds: 'harmonic' is not one of ['none']"]),
    ("constant/membranes.yaml", "rbc: {bonds: {type: harmonic}}", ["rbc/bonds: 'k' is a required property"]),
    ("system/mesh.yaml", "domain: {size: [1 um, 2 um], periodic: [true, true, false]}", ["domain/size: ", "too short"]),
    ("system/observers.yaml", "shape: {type: shape, every: 1}", ["shape/every: 1"]),
]


def check_messages(schemas):
    faults = []
    for file, text, parts in MESSAGES:
        found = schemas.faults(file, yaml12.load(text))
        if not any(all(part in message for part in parts) for message in found) or any("any of the given schemas" in m for m in found):
            faults.append(f"{file} with '{text}': {found}")
    return faults


def main():
    source, program = pathlib.Path(sys.argv[1]), sys.argv[2]
    files = dictionaries(source)
    with tempfile.TemporaryDirectory() as folder:
        reader = Reader(program, folder)
        reader.problems("system/observers.yaml", "")  # the schemas are written now
        schemas = Schemas(folder)
        faults = [fault for file in files for fault in check(source, file, reader, schemas)] + check_messages(schemas)
        for path in sorted(pathlib.Path(folder).glob("*.json")):
            kept = source / "etc/schema" / path.name
            if not kept.exists() or kept.read_text() != path.read_text():
                faults.append(f"etc/schema/{path.name} is not that of the programs; run: listModels -schema etc/schema")
        reader.close()
    lint = subprocess.run(["yamllint", "-s", "-c", str(source / ".yamllint"), *map(str, files)], cwd=source, capture_output=True, text=True)
    if lint.returncode:
        faults.append("yamllint:\n" + lint.stdout + lint.stderr)
    print("\n".join(faults + [f"{len(files)} dictionaries, {len(faults)} faults"]))
    return 1 if faults or len(files) < 50 else 0


if __name__ == "__main__":
    sys.exit(main())
