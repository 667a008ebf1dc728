#!/usr/bin/env python3
"""etc/functions.sh where apt cannot install the packages, with stand-ins for apt-get and dpkg-query: it gives the reason, offers a solution, and never
removes a package.

    installPackages.py ROOT    ROOT: the repository
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(sys.argv[1]).resolve()
PLAIN = "Inst libvtk9-dev (9.1.0 Debian:12 [amd64])\nConf libvtk9-dev (9.1.0 Debian:12 [amd64])\n"
PARAVIEW = "Remv paraview [5.11.0]\nRemv python3-paraview [5.11.0]\n" + PLAIN
OTHER = "Remv libhdf5-mpich-dev [1.10.8]\n" + PLAIN
HELD = "The following packages have unmet dependencies:\n libvtk9-dev : Depends: python3-vtk9 but it is not going to be installed\nE: Unable to correct problems\n"
UNKNOWN = "E: Unable to locate package libvtk9-dev\n"


def install(plan, status=0, installed=()):
    """Exit code, output, and the calls that change the machine."""
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        (folder / "plan").write_text(plan)
        (folder / "etc").mkdir()
        shutil.copy(ROOT / "etc/functions.sh", folder / "etc")
        (folder / "etc/packages").write_text("# A comment.\ncmake\nlibvtk9-dev\n")
        scripts = {
            "apt-get": f'if [ "$1" = -s ]; then cat {folder}/plan; exit {status}; fi\necho "$@" >>{folder}/calls\n',
            "dpkg-query": "\n".join(f'[ "${{@: -1}}" = {name} ] && echo "install ok installed"' for name in installed) + "\ntrue\n",
            "sudo": 'exec "$@"\n'}
        for name, text in scripts.items():
            (folder / name).write_text("#!/bin/bash\n" + text)
            (folder / name).chmod(0o755)
        run = subprocess.run(["bash", "-c", f"root={folder}; . $root/etc/functions.sh; timed packages install_packages"], text=True,
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT, env={**os.environ, "PATH": f"{folder}:{os.environ['PATH']}"})
        calls = (folder / "calls").read_text().splitlines() if (folder / "calls").exists() else []
        return run.returncode, run.stdout, [call for call in calls if not call.startswith("update")]


code, said, calls = install(PLAIN)
assert code == 0 and len(calls) == 1 and calls[0].startswith("install -y") and "--no-remove" in calls[0], (code, said, calls)

for plan, status, installed, words in (
        (PARAVIEW, 0, (), ["python3-paraview", "exclude each other", "docker run", "paraview.org"]),
        (HELD, 100, ("paraview", "python3-paraview"), ["python3-paraview", "exclude each other", "docker run"]),
        (OTHER, 0, (), ["apt would remove: libhdf5-mpich-dev", "docker run"]),
        (HELD, 100, (), ["libvtk9-dev : Depends: python3-vtk9", "Unable to correct", "docker run"]),
        (UNKNOWN, 100, (), ["Unable to locate package libvtk9-dev", "Debian 12"])):
    code, said, calls = install(plan, status, installed)
    assert code != 0 and calls == [], (plan, code, calls)
    assert "nothing has been changed" in said and all(word in said for word in words), said
    assert ("exclude each other" in said) == ("exclude each other" in words), said
