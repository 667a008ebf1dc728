#!/usr/bin/env python3
"""`cmake --install`: the installed tree is moved; its programs, data, pages and CMake package must then work without the build folder.

    install.py BUILD SOURCE
"""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

BUILD, SOURCE = map(pathlib.Path, sys.argv[1:])
COARSE = ["system/numerics.yaml:/spacing=1.25 um", "system/mesh.yaml:/cells/0/edge=1 um", "system/control.yaml:/endStrain=0.1"]
CONSUMER = {
    "CMakeLists.txt": """cmake_minimum_required(VERSION 3.25)
project(consumer LANGUAGES C CXX)
set(CMAKE_CXX_STANDARD 20)
find_package(Corpuscle 0.2 REQUIRED)
add_executable(consumer consumer.cpp)
target_link_libraries(consumer PRIVATE corpuscle::sph)
""",
    "consumer.cpp": """#include <iostream>

#include "core/units.hpp"
#include "sph/kernels.hpp"
int main() { std::cout << corpuscle::parseQuantity("8 um").value * 1e6 << '\\n'; }
""",
}


def run(words, cwd, environment):
    done = subprocess.run([str(word) for word in words], cwd=cwd, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, f"{words}: code {done.returncode}\n{done.stdout}{done.stderr}"
    return done.stdout + done.stderr


def refused(words, cwd, environment, *messages):
    done = subprocess.run([str(word) for word in words], cwd=cwd, env=environment, capture_output=True, text=True)
    assert done.returncode == 2, (words, done.returncode, done.stdout + done.stderr)
    for message in messages:
        assert message in done.stderr, (message, done.stderr)


def deadLinks(share):
    """Relative links of the installed pages that lead nowhere."""
    return [(str(page.relative_to(share)), link) for page in share.rglob("*.md") for link in re.findall(r"\]\(([^)#\s]+)", page.read_text())
            if "://" not in link and not link.startswith("mailto:") and not (page.parent / link).exists()]


def plugin(folder, root, environment):
    """A user's own law: from the template to a run with it, on one and two ranks, and errors."""
    run(["newModel", "law", "ownSpring", "-plugin", "own"], folder, environment)
    run(["cmake", "-S", "own", "-B", "own/build", "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={root}"], folder, environment)
    run(["ninja", "-C", "own/build"], folder, environment)
    (folder / "case/constant/ownSpring.so").write_bytes((folder / "own/build/ownSpring.so").read_bytes())
    bonds = "constant/membranes.yaml:/rbc/bonds={type: ownSpring, k: 5e-4 N/m}"
    refused(["caseDict", "-case", "case", "-set", bonds], folder, environment, "unknown bond law 'ownSpring'")
    run(["caseDict", "-case", "case", "-set", "system/control.yaml:/libs=[constant/ownSpring.so]"], folder, environment)
    run(["caseDict", "-case", "case", "-set", bonds], folder, environment)
    shown = run(["listModels", "-case", "case", "-info", "ownSpring"], folder, environment)
    assert "spring along each edge" in shown and "a plugin, from constant/ownSpring.so" in shown, shown
    endings = []
    for ranks in (1, 2):
        case = f"own{ranks}"
        run(["cloneCase", "case", case], folder, environment)
        run(["membraneMesh", "-quiet", "-case", case], folder, environment)
        run(["particleFill", "-quiet", "-case", case], folder, environment)
        run(["mpirun", "--oversubscribe", "-np", ranks, "dmpFlow", "-quiet", "-case", case], folder, environment)
        assert "ownSpring.so" in (folder / case / "used.yaml").read_text()
        endings.append((folder / case / "postProcessing/deformation/rbc.csv").read_text().splitlines()[-1].split(","))
    # The template is a harmonic spring: the case without it has the same curve.
    endings.append((folder / "case/postProcessing/deformation/rbc.csv").read_text().splitlines()[-1].split(","))
    for other in endings[1:]:
        assert all(abs(float(a) - float(b)) <= 1e-6 * max(1e-6, abs(float(b))) for a, b in zip(endings[0][:5], other[:5])), endings
    for libs, *messages in (("constant/missing.so", "-set: libs[0]: ", "there is no such file"),
                            ("noSuchLibrary.so", "cannot be loaded"), ("system/mesh.yaml", "cannot be loaded"),
                            (f"{root}/lib/libcorpuscle_core.so", "is no plugin")):
        refused(["dmpFlow", "-case", "case", "-set", f"system/control.yaml:/libs=[{libs}]"], folder, environment, *messages)
    version = folder / "own/build/ownSpringVersion.cpp"
    version.write_text(version.read_text().replace('return "', 'return "9.'))
    run(["c++", "-shared", "-fPIC", "-o", "case/constant/ownSpring.so", version], folder, environment)
    refused(["dmpFlow", "-case", "case"], folder, environment, "was built with Corpuscle 9.")


def main():
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        environment = {key: value for key, value in os.environ.items() if key != "LD_LIBRARY_PATH"}
        if "CORPUSCLE_SANITIZE:BOOL=ON" in (BUILD / "CMakeCache.txt").read_text():  # what uses sanitized libraries needs it, too
            environment["CXXFLAGS"] = environment["LDFLAGS"] = "-fsanitize=address,undefined"
        run(["cmake", "--install", BUILD, "--prefix", folder / "first"], folder, environment)
        # As for packages: the same files below another root.
        run(["cmake", "--install", BUILD, "--prefix", "/usr"], folder, dict(environment, DESTDIR=str(folder / "package")))
        files = [sorted(str(path.relative_to(top)) for path in top.rglob("*") if path.is_file()) for top in (folder / "first", folder / "package/usr")]
        assert files[0] == files[1] and len(files[0]) > 500, set(files[0]) ^ set(files[1])
        root = (folder / "first").rename(folder / "moved")
        environment["PATH"] = f"{root / 'bin'}:{os.environ['PATH']}"
        libraries = run(["ldd", root / "bin/dmpFlow"], folder, environment)
        ours = [line for line in libraries.splitlines() if "libcorpuscle" in line]
        assert ours and all(f"=> {root.resolve()}" in line or f"=> {root}" in line for line in ours), libraries

        share = root / "share/corpuscle"
        tutorial = share / "tutorials/rbcShear/Ca0.02"
        run(["cloneCase", tutorial, "case", *[word for change in COARSE for word in ("-set", change)]], folder, environment)
        for program in ("membraneMesh", "particleFill", "dmpFlow"):
            run([program, "-quiet", "-case", "case"], folder, environment)
        assert "0.1" in run(["listTimes", "-latest", "-case", "case"], folder, environment)
        # Ready cells lie beside the programs, and take precedence over those of the sources.
        run(["cloneCase", "case", "ready", "-set", "system/mesh.yaml:/cells=[{name: rbc, cell: healthyRBC, edge: 1 um}]"], folder, environment)
        run(["membraneMesh", "-quiet", "-case", "ready"], folder, environment)
        # A tutorial is found by its path in the repository, and a copy finds the scripts that draw its curves.
        run(["cloneCase", "tutorials/rbcShear/Ca0.02", "named", "-set", "constant/flow.yaml:/Ca=0.03"], folder, environment)
        assert (folder / "named/constant/flow.yaml").read_text().count("0.03") == 1
        said = run(["./Allrun", *[word for change in COARSE for word in ("-set", change)]], folder / "named", dict(environment, CORPUSCLE_NP="1"))
        assert "No table and curves" not in said and (folder / "named/postProcessing/shape.png").exists(), said
        assert deadLinks(share) == [], deadLinks(share)
        assert "dmpFlow" in (root / "share/man/man7/corpuscle.7").read_text()
        assert (tutorial / "Allrun").stat().st_mode & 0o111 and not (tutorial / "0").exists()
        assert (share / "docs/quickstart.md").exists() and (share / "schema/mesh.json").exists()

        about = json.loads(run(["listModels", "-info", "-json", "skalak"], folder, environment))["triangle law"]["skalak"]["info"]
        assert pathlib.Path(about["source"]["header"]) == root.resolve() / "include/corpuscle/membrane/skalak.hpp", about
        assert "struct Skalak" in pathlib.Path(about["source"]["header"]).read_text() and about["source"]["file"] == "libs/membrane/skalak.cpp", about
        assert about["theory"][0]["page"] == "docs/theory/membrane.md" and about["tutorials"] and about["readyCells"] and not about["validation"], about
        for use in about["tutorials"] + about["readyCells"]:
            assert "skalak" in (share / use["file"]).read_text().splitlines()[use["line"] - 1], use

        names = sorted(path.name for path in (root / "bin").iterdir() if path.name != "newModel")
        assert {"dmpFlow", "caseSweep", "renderCase", "caseReport"} <= set(names) and not any(name.startswith("test_") for name in names), names
        assert sorted(path.stem for path in (root / "share/man/man1").iterdir()) == names
        page = (root / "share/man/man1/caseSweep.1").read_text()
        assert '.BR "\\-jobs" " N"' in page and ".SH EXAMPLES" in page, page
        completion = root / "share/bash-completion/completions/caseSweep"
        shown = run(["bash", "-c", f"source {completion}; COMP_WORDS=(caseSweep -jo); COMP_CWORD=1; _corpuscle_caseSweep; echo ${{COMPREPLY[@]}}"], folder, environment)
        assert shown.strip() == "-jobs", shown

        package = dict(environment, PYTHONPATH=str(share / "python"))
        script = "import corpuscle; case = corpuscle.Case('case'); print(len(case.table('deformation/rbc')) > 2, case['constant/flow.yaml:/Ca'])"
        assert run(["/usr/bin/python3", "-c", script], folder, package).strip() == "True 0.02"

        consumer = folder / "consumer"
        consumer.mkdir()
        for name, text in CONSUMER.items():
            (consumer / name).write_text(text)
        run(["cmake", "-S", ".", "-B", "build", "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={root}"], consumer, environment)
        run(["ninja", "-C", "build"], consumer, environment)
        assert run(["build/consumer"], consumer, environment).strip() == "8"
        plugin(folder, root, environment)
    print("passed")


main()
