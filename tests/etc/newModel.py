#!/usr/bin/env python3
"""etc/newModel: a model of each kind in a copy of the repository, built with its test and run; and what it refuses.

    newModel.py REPOSITORY
"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

SKIPPED = re.compile(r"build(-.*)?|\.git|results|checkpoints|postProcessing|runs|__pycache__")  # folders
KINDS = {"law": "membrane", "kernel": "sph", "flow": "sph", "observer": "observers", "scheme": "schemes"}


def run(command, folder, code=0):
    done = subprocess.run([str(c) for c in command], cwd=folder, capture_output=True, text=True)
    assert done.returncode == code, f"{command}: {done.returncode}\n{done.stdout[-4000:]}{done.stderr[-4000:]}"
    return done.stdout + done.stderr


def main():
    root = pathlib.Path(sys.argv[1])
    with tempfile.TemporaryDirectory() as temporary:
        # Under the name that a clone has: what the compiler's cache holds counts in any folder.
        copy = pathlib.Path(temporary) / "corpuscle"
        shutil.copytree(root, copy, ignore=lambda folder, names: [n for n in names if SKIPPED.fullmatch(n)])
        script = copy / "etc/newModel"
        assert "there is no template of a 'turbulence'" in run([script, "turbulence", "k"], copy, 1)
        assert "is no name for a model" in run([script, "law", "My law"], copy, 1)
        assert "is there already" in run([script, "law", "harmonicBond"], copy, 1)
        assert "etc/newModel KIND NAME" in run([script], copy)
        names = {kind: f"trial{kind.capitalize()}" for kind in KINDS}
        for kind, name in names.items():
            said = run([script, kind, name], copy)
            assert f"tests/{KINDS[kind]}/{name}.cpp" in said, said
        run(["cmake", "-S", copy, "-B", copy / "build", "-G", "Ninja", "-DCORPUSCLE_BASELINE_ONLY=ON"], copy)
        tests = [f"test_{KINDS[kind]}.{name}" for kind, name in names.items()]
        run(["ninja", "-C", copy / "build", *tests, "listModels"], copy)
        said = run(["ctest", "--test-dir", copy / "build", "--output-on-failure", "--no-tests=error", "-R",
                    "|".join(name for name in names.values())], copy)
        assert "100% tests passed" in said and said.count("Passed") == len(KINDS) + 2, said  # the observer and the scheme on 1 and 2 ranks
        listed = run([copy / "build/bin/listModels"], copy)
        for name in names.values():
            assert name in listed, (name, listed)
    print("passed")


if __name__ == "__main__":
    main()
