#!/usr/bin/env python3
"""The rules of docs/architecture.md that a machine can check.

    architecture.py [repository]

1. Libraries depend one way, by the layers that the page's table draws: every #include "library/file.hpp" in libs/ and every DEPENDS of a library's CMakeLists.txt
   names a library of a lower layer, its own, or one of SAME_LAYER. What is included is reached through DEPENDS.
2. Every library has its CMakeLists.txt, its tests in tests/<library> and its page docs/<library>.md.
3. No file names a place of the machine that it was written on.
4. A file that begins with #! can be called by its name.
5. Files and classes that the page names exist.
6. No line of C++ is wider than 120 columns, comments included (the formatter leaves those as they are).
"""
import os
import re
import sys
from pathlib import Path

ROOT = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).resolve().parents[2]).resolve()
SAME_LAYER = {}  # library -> libraries of the same layer that it may use


def drawn_layers(page):
    """The layers as the table of the page draws them, the lowest first: | 3 | [particles](particles.md): ... | 1, 2 |"""
    layers = []
    for number, libraries, below in re.findall(r"^\| (\d+) \| (.*?) \| (.*?) ?\|$", page, re.M):
        names = set(re.findall(r"\[(\w+)\]\(\1\.md\)", libraries))
        if not names:
            continue  # applications
        layers.append(names)
        last = len(layers) - 1
        expected = {"", "1"} if last < 2 else {f"1 to {last}", "1, 2"}
        if int(number) != len(layers) or below.strip() not in expected:
            raise ValueError(f"layer {number} of docs/architecture.md: out of order, or may use '{below}'")
    return layers


PAGE = (ROOT / "docs/architecture.md").read_text()
NAMING = {page: (ROOT / page).read_text() for page in ("docs/architecture.md", "docs/changes.md")}  # these name files and classes
LAYERS = drawn_layers(PAGE)
LIBRARIES = set().union(*LAYERS)
SOURCES = {".hpp", ".cpp", ".h"}
# Written in two halves, so that this file does not name them itself.
PLACES = re.compile("|".join(re.escape(a + b) for a, b in (("/wo", "rk/"), ("/ho", "me/"), ("/ro", "ot/"), ("../sha", "red"))))
GENERATED = re.compile(r"build(-.*)?|install|__pycache__|\.git")
GENERATED_IN_CASES = {"0", "results", "checkpoints", "postProcessing", "runs"}


def allowed(library):
    lower = set()
    for layer in LAYERS:
        if library in layer:
            return lower | {library} | SAME_LAYER.get(library, set())
        lower |= layer
    raise KeyError(library)


def declared(library, libs):
    text = re.sub(r"#.*", "", (libs / library / "CMakeLists.txt").read_text())
    call = re.search(r"corpuscle_library\(\s*%s\b([^)]*)\)" % library, text)
    if not call:
        return None
    words, found, inside = call.group(1).split(), [], False
    for word in words:
        if word in {"SOURCES", "DEPENDS", "LINK", "PRIVATE_LINK"}:
            inside = word == "DEPENDS"
        elif inside:
            found.append(word)
    return found


def check_dependencies(root, fail):
    libs = root / "libs"
    there = {p.name for p in libs.iterdir() if p.is_dir()}
    for name in sorted(there - LIBRARIES):
        fail(f"libs/{name}: no layer is known for it; add it to the table of docs/architecture.md")
    depends = {}
    for library in sorted(there & LIBRARIES):
        if not (libs / library / "CMakeLists.txt").is_file():
            fail(f"libs/{library}/CMakeLists.txt is missing")
            continue
        found = declared(library, libs)
        if found is None:
            fail(f"libs/{library}/CMakeLists.txt: no corpuscle_library({library} ...)")
            continue
        depends[library] = set(found)
        for other in found:
            if other not in allowed(library) or other == library:
                fail(f"libs/{library}/CMakeLists.txt: DEPENDS {other}; allowed: {', '.join(sorted(allowed(library) - {library}))}")

    def reached(library):
        seen, pending = {library}, [library]
        while pending:
            for other in depends.get(pending.pop(), ()):
                if other not in seen:
                    seen.add(other)
                    pending.append(other)
        return seen

    for library in sorted(depends):
        for path in sorted((libs / library).rglob("*")):
            if path.suffix not in SOURCES:
                continue
            for number, line in enumerate(path.read_text().splitlines(), 1):
                include = re.match(r'\s*#\s*include\s+"([^"]+)"', line)
                if not include:
                    continue
                place = f"{path.relative_to(root)}:{number}: {include.group(0).strip()}"
                other = include.group(1).split("/")[0]
                if "/" not in include.group(1) or other not in LIBRARIES:
                    fail(f'{place}; write "library/file.hpp"')
                elif other not in allowed(library):
                    fail(f"{place}; {library} may use {', '.join(sorted(allowed(library)))}")
                elif other not in reached(library):
                    fail(f"{place}; {other} is not reached through DEPENDS of libs/{library}/CMakeLists.txt")


def check_companions(root, fail):
    for library in sorted(LIBRARIES):
        for path in (f"docs/{library}.md", f"tests/{library}/CMakeLists.txt"):
            if not (root / path).is_file():
                fail(f"{path} is missing: every library has a page and a folder of tests")


def check_page(root, fail):
    """Everything that the pages name exists: files as library/file, classes as library::Class."""
    for page, content in NAMING.items():
        for library, name in sorted(set(re.findall(r"(?<!tests/)\b(%s)/(\w+)" % "|".join(sorted(LIBRARIES)), content))):
            if not any((root / "libs" / library).glob(f"{name}.*")):
                fail(f"{page} names {library}/{name}, and libs/{library} has no such file")
        for library, name in sorted(set(re.findall(r"\b(%s)::(\w+)" % "|".join(sorted(LIBRARIES)), content))):
            sources = "".join(path.read_text() for path in (root / "libs" / library).glob("*.hpp"))
            if not re.search(r"\b(class|struct|enum class) %s\b" % name, sources):
                fail(f"{page} names {library}::{name}, and no header of libs/{library} declares it")


def texts(root):
    """(path, content) of every file that is not binary and not made by a build or a case."""
    for folder, names, files in os.walk(root):
        in_tutorial = "tutorials" in Path(folder).relative_to(root).parts
        names[:] = [n for n in names if not GENERATED.fullmatch(n) and not (in_tutorial and n in GENERATED_IN_CASES)]
        for name in files:
            path = Path(folder) / name
            if path.is_symlink() or (in_tutorial and (name.startswith("log.") or name in {"run.json", "used.yaml"})):
                continue
            content = path.read_bytes()
            if b"\0" not in content:
                yield path, content.decode(errors="replace")


def check_places(root, fail):
    for path, content in texts(root):
        for number, line in enumerate(content.splitlines(), 1):
            found = PLACES.search(line)
            if found:
                fail(f"{path.relative_to(root)}:{number}: names '{found.group(0)}', a place of one machine")


def check_scripts(root, fail):
    for path, content in texts(root):
        if content.startswith("#!") and not os.access(path, os.X_OK):
            fail(f"{path.relative_to(root)}: begins with #! and is not executable: chmod +x")


def check_widths(root, fail):
    for path, content in texts(root):
        if path.suffix in SOURCES:
            for number, line in enumerate(content.splitlines(), 1):
                if len(line) > 120:
                    fail(f"{path.relative_to(root)}:{number}: {len(line)} columns, more than 120")


def main():
    failures = []
    for check in (check_dependencies, check_companions, check_page, check_places, check_scripts, check_widths):
        check(ROOT, failures.append)
    for failure in failures:
        print(failure)
    print(f"architecture: {len(failures)} fault{'' if len(failures) == 1 else 's'}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
