"""Every cell type of etc/cells, used in a case as its README describes, is valid and can be meshed.

    python3 cellTypes.py BIN

The line at the head of a file becomes the cells of system/mesh.yaml; checkCase and membraneMesh must succeed.
"""
import concurrent.futures
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).parent
BASE = HERE.parent / "brokenCases" / "baseCase"
CELLS = sorted((HERE.parents[2] / "etc" / "cells").glob("*.yaml"))


def check(programs, file, directory):
    shutil.copytree(BASE, directory)
    text = file.read_text()
    line = re.search(r"^#   - (\{name: (\w+), .*\})$", text, re.MULTILINE)
    if not line or line.group(2) != file.stem or f"cell: {file.stem}," not in line.group(1):
        return f"{file.name}: its head has no line '#   - {{name: {file.stem}, cell: {file.stem}, ...}}'"
    mesh = directory / "system" / "mesh.yaml"
    mesh.write_text(mesh.read_text().split("cells:")[0] + f"cells:\n  - {line.group(1)}\n")
    inclusion = re.search(r"^#   - (\{name: parasite, .*\})$", text, re.MULTILINE)
    if inclusion:
        with open(mesh, "a") as file_of_mesh:
            file_of_mesh.write(f"bodies:\n  - {inclusion.group(1)}\n")
        (directory / "constant" / "bodies.yaml").write_text("parasite: {motion: free}\n")
        numerics = directory / "system" / "numerics.yaml"
        numerics.write_text(re.sub(r"spacing: .*", "spacing: 0.25 um", numerics.read_text(), count=1))
    (directory / "constant" / "membranes.yaml").unlink()
    environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    for program in ("checkCase", "membraneMesh"):
        result = subprocess.run([programs / program, "-case", directory], capture_output=True, text=True, timeout=300, env=environment)
        # The coarse base case gets warnings about its spacing and about the density that its Re requires.
        said = [line for line in result.stderr.splitlines() if line and "the edge is" not in line and "sets the density" not in line]
        if result.returncode != 0 or said:
            return f"{file.name}: {program} ends with {result.returncode}: {result.stderr}"
    return "" if (directory / "0" / f"{file.stem}.vtp").exists() else f"{file.name}: no mesh was written"


def main():
    programs = pathlib.Path(sys.argv[1])
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(2) as pool:
        faults = [f for f in pool.map(lambda c: check(programs, c, pathlib.Path(folder) / c.stem), CELLS) if f]
    print("\n".join(faults) or f"{len(CELLS)} cell types are valid")
    return 1 if faults or not CELLS else 0


if __name__ == "__main__":
    sys.exit(main())
