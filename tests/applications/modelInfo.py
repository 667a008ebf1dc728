#!/usr/bin/env python3
"""`listModels -info`: sources, pages and cases of every model, compared with what the files themselves say.

    modelInfo.py BIN SOURCE
"""
import json
import pathlib
import re
import subprocess
import sys

BIN, SOURCE = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
GENERAL = {"docs/quickstart.md", "docs/errors.md"}  # they name models, but explain none
KEYS = {"bond law": "bonds", "triangle law": "triangles", "bending law": "bending", "rupture law": "rupture", "pore law": "pores", "contact law": "law",
        "kernel": "kernel", "scheme": "integrator", "equation of state": "equationOfState", "drive": "drive", "relaxation protocol": "protocol"}


def run(*words, code=0):
    done = subprocess.run([str(BIN / "listModels"), *words], capture_output=True, text=True)
    assert done.returncode == code, (words, done.returncode, done.stderr)
    return done.stdout + done.stderr


def check_source(family, name, source):
    lines = (SOURCE / source["file"]).read_text().splitlines()
    header = (SOURCE / source["header"]).read_text() if source["header"] else ""
    registration = lines[source["line"] - 1]
    assert f'"{name}"' in registration or ("Registration<" in registration and f'name = "{name}"' in header), (family, name, registration)
    if header:  # beside it, and it declares what is registered
        assert pathlib.Path(source["header"]).parent == pathlib.Path(source["file"]).parent, source
        kind = re.search(r"REGISTER\(\w+, (\w+)", registration)
        assert not kind or re.search(rf"\bstruct {kind[1]}\b", header), (family, name, source)
    assert source["tests"] and all((SOURCE / test).is_file() for test in source["tests"]), (family, name, source)


def check_theory(family, name, theory):
    assert any(section["page"] not in GENERAL for section in theory), f"{family} '{name}': no page of docs/ explains it; name it there in code marks"
    pages = [section["page"] for section in theory]
    assert pages == sorted(pages, key=lambda page: (not page.startswith("docs/theory/"), page)), pages
    for section in theory:
        text = (SOURCE / section["page"]).read_text()
        text = re.sub(r"^```.*?^```", lambda block: block[0].replace("\n#", "\n"), text, flags=re.M | re.S).replace("`", "")
        found = re.search(rf"^#+ {re.escape(section['heading'])}\n(.*?)(?=^#+ |\Z)", text, re.M | re.S)
        assert found and re.search(rf"\b{name}\b", found[0]), (family, name, section)
        assert section["anchor"].startswith(re.sub(r"[^a-z0-9_ -]", "", section["heading"].lower()).replace(" ", "-")), section


def code_of(line):
    return re.sub(r"(^|\s)#.*", "", line)


def check_uses(family, name, uses, folder):
    """Each use stands in its line; and no file that has `key: {type: name` or `key: name` in one line is missing."""
    for use in uses:
        line = (SOURCE / use["file"]).read_text().splitlines()[use["line"] - 1]
        assert re.search(rf"\b{name}\b", code_of(line)) or "type" not in line, (family, name, use, line)
    if family in KEYS:
        value = re.compile(rf"\b{KEYS[family]}: *(\{{ *type: *)?{name}\b")
        tracked = subprocess.run(["git", "-C", SOURCE, "ls-files", folder], capture_output=True, text=True).stdout.split()
        expected = {(file, number) for file in tracked if re.search(r"/(system|constant)/\w+\.yaml$", file)
                    for number, line in enumerate((SOURCE / file).read_text().splitlines(), 1) if value.search(code_of(line))}
        assert expected <= {(use["file"], use["line"]) for use in uses}, (family, name, expected)


def main():
    models = json.loads(run("-info", "-json"))
    registered = sum(len(re.findall(r"^CORPUSCLE_REGISTER\(", path.read_text(), re.M)) for path in (SOURCE / "libs").rglob("*.cpp"))
    assert sum(map(len, models.values())) == registered + len(models["kernel"]), registered
    for family, all_models in models.items():
        for name, model in all_models.items():
            info = model["info"]
            check_source(family, name, info["source"])
            check_theory(family, name, info["theory"])
            check_uses(family, name, info["tutorials"], "tutorials")
            check_uses(family, name, info["validation"], "tests/validation")

    def sections(family, name):
        return [f"{section['page']}#{section['anchor']}" for section in models[family][name]["info"]["theory"]]

    def cases(family, name, group="tutorials"):
        return {str(pathlib.PurePosixPath(use["file"]).parents[1]) for use in models[family][name]["info"][group]}

    assert sections("triangle law", "skalak")[0] == "docs/theory/membrane.md#laws"
    assert "docs/theory/membrane.md#rupture" in sections("rupture law", "cohesive")
    assert "docs/boundary.md#networks-of-tubes" in sections("walls", "network")
    assert "docs/theory/timeStep.md#the-implicit-step" in sections("scheme", "implicit")
    assert sections("kernel", "wendlandC2")[0] == "docs/theory/sph.md#kernels"
    # One word of two families: flows and protocols have their own pages and cases.
    assert "docs/theory/sph.md#flows" in sections("flow", "shear") and "docs/theory/sph.md#flows" not in sections("relaxation protocol", "shear")
    assert "tutorials/couette" in cases("flow", "shear") and not cases("relaxation protocol", "shear")
    assert cases("triangle law", "skalak") >= {"tutorials/capsuleShear", "tutorials/rbcShear/redCell"}
    assert cases("walls", "network", "validation") == {"tests/validation/bifurcation"}
    assert cases("drive", "table") == {"tutorials/womersley"}  # a model within the table of a model
    assert models["bending law"]["helfrich"]["info"]["readyCells"], "ready cells have laws, too"

    shown = run("-info", "network")
    assert "no tutorial names it" in shown and "libs/boundary/networkWalls.cpp:" in shown and f"Paths are within {SOURCE}" in shown, shown
    assert run("-info", "bondLaw").count("\n  source ") == 3  # a family
    assert "Did you mean 'skalak'?" in run("-info", "skalac", code=1)
    assert "source" not in run("skalak")
    print("passed")


main()
