"""A tutorial's case at another size, prepared in a folder of its own."""
import pathlib
import shutil
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tests" / "validation"))
from suite import TUTORIALS, sets

RADIUS = 4  # um, of the cells of capsuleShear and rbcShear


def sized(box, spacing):
    """Settings for a box [um], and for a spacing [um] of particles that is also the edge length of the mesh."""
    return ["system/mesh.yaml:/domain/size=[" + ", ".join(f"{length:g} um" for length in box) + "]",
            f"system/numerics.yaml:/spacing={spacing:.8g} um", f"system/mesh.yaml:/cells/0/edge={spacing:.8g} um"]


def prepare(case, binaries, tutorial, settings):
    """Meshes and fills the case unless it exists. Returns the options for every program of the case."""
    options = ["-quiet", *sets(settings)]
    if not case.exists():
        part = case.with_name(case.name + ".part")
        shutil.rmtree(part, ignore_errors=True)
        for folder in ("system", "constant"):
            shutil.copytree(TUTORIALS / tutorial / folder, part / folder)
        for program in ("membraneMesh", "particleFill"):
            subprocess.run([binaries / program, "-case", part, *options], check=True)
        part.rename(case)
    return options
