#!/usr/bin/env python3
"""etc/newModel: a model of each kind in a copy of the repository, built with its test and run; and arguments that it rejects.

    newModel.py REPOSITORY
"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

SKIPPED = re.compile(r"build(-.*)?|\.git|results|checkpoints|postProcessing|runs|__pycache__")  # folders
KINDS = {"law": "membrane", "kernel": "sph", "wall": "boundary", "flow": "sph", "observer": "observers", "scheme": "schemes"}


def run(command, folder, code=0):
    done = subprocess.run([str(c) for c in command], cwd=folder, capture_output=True, text=True)
    assert done.returncode == code, f"{command}: {done.returncode}\n{done.stdout[-4000:]}{done.stderr[-4000:]}"
    return done.stdout + done.stderr


def main():
    root = pathlib.Path(sys.argv[1])
    with tempfile.TemporaryDirectory() as temporary:
        # The folder has the name of a clone, so that entries of the compiler's cache are valid in it.
        copy = pathlib.Path(temporary) / "corpuscle"
        shutil.copytree(root, copy, ignore=lambda folder, names: [n for n in names if SKIPPED.fullmatch(n)])
        script = copy / "etc/newModel"
        assert "there is no template of a 'turbulence'" in run([script, "turbulence", "k"], copy, 1)
        assert "is no name for a model" in run([script, "law", "My law"], copy, 1)
        assert "is there already" in run([script, "law", "harmonicBond"], copy, 1)
        assert "etc/newModel KIND NAME" in run([script], copy)
        names = {kind: f"trial{kind.capitalize()}" for kind in KINDS}

        def write(kind):
            said = run([script, kind, names[kind]], copy)
            assert f"tests/{KINDS[kind]}/{names[kind]}.cpp" in said, said

        def build_and_test(folder, kinds, entries, options=(), targets=()):
            run(["cmake", "-S", copy, "-B", copy / folder, "-G", "Ninja", *options], copy)
            run(["ninja", "-C", copy / folder, *(f"test_{KINDS[kind]}.{names[kind]}" for kind in kinds), *targets], copy)
            said = run(["ctest", "--test-dir", copy / folder, "--output-on-failure", "--no-tests=error", "-R",
                        "|".join(names[kind] for kind in kinds)], copy)
            assert "100% tests passed" in said and said.count("Passed") == entries, said

        others = [kind for kind in KINDS if kind != "kernel"]
        for kind in others:
            write(kind)
        # The observer and the scheme on 1 and 2 ranks. Tests of all models of a family pass with one more model.
        families = {"test_membrane": "Registry.*", "test_observers.models": "Tables.*:Observers.EveryModelIsThere"}
        build_and_test("build", others, len(others) + 2, targets=["listModels", *families])
        for program, chosen in families.items():
            run([copy / "build/bin" / program, f"--gtest_filter={chosen}"], copy)
        listed = run([copy / "build/bin/listModels"], copy)
        for kind in others:
            assert names[kind] in listed, (kind, listed)
        # A kernel is compiled into every pair loop, so all that includes these is compiled again; here for one instruction set only.
        write("kernel")
        build_and_test("build-kernel", ["kernel"], 1, ["-DCORPUSCLE_BASELINE_ONLY=ON"])
    print("passed")


if __name__ == "__main__":
    main()
