"""Files that are not dictionaries, or are far too large: each gives one clear message, quickly, and never a crash.

    python3 hostileFiles.py SOURCE BIN
"""
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile
import time

CRASH = re.compile(r"what\(\)|terminate called|Aborted|Segmentation|Sanitizer|MPI_ABORT|\.[ch]pp\b|std::|YAML::|bad_alloc")
LONGEST_LINE, MOST_LINES, LONGEST_TIME = 1600, 52, 10.0

rng = random.Random(6)
garbage = rng.randbytes(20000)
numbered = "".join(f"density{i}: 1000 kg/m^3\n" for i in range(40000))
fluid = "density: 1000 kg/m^3\nviscosity: 1e-3 Pa s\n"

# name: file, bytes, words that the messages hold, number of problems (None: any)
HOSTILE = {
    "unknownKeys": ("constant/fluid.yaml", fluid + numbered, ["unknown key 'density0'", "and 39950 more", "40000 problems"], 40000),
    "unknownKeysNested": ("system/mesh.yaml", "domain:\n" + "".join(f"  size{i}: 1\n" for i in range(40000)), ["more"], None),
    "sameKey": ("constant/fluid.yaml", fluid + "density: 1 kg/m^3\n" * 40000, ["stands twice", "and 39950 more"], 40000),
    "wrongCells": ("constant/membranes.yaml", "".join(f"cell{i}: {{bonds: harmonic}}\n" for i in range(20000)), ["spring constant", "and 19950 more"], 20000),
    "wrongNames": ("constant/membranes.yaml", "".join(f"{i}: none\n" for i in range(40000)), ["is not a name", "more"], None),
    "manyItems": ("system/mesh.yaml", "domain: {size: [" + "1 um, " * 100000 + "1 um], periodic: [true, true, false]}\n", ["a list of 100001"], None),
    "manyObservers": ("system/observers.yaml", "".join(f"a{i}: {{type: shapes, every: 1 strain}}\n" for i in range(20000)), ["Did you mean 'shape'?"], 20000),
    "deepLists": ("system/mesh.yaml", "cells: " + "[" * 10000 + "]" * 10000, ["nested more than 64 levels deep"], 1),
    "deepOpenLists": ("system/mesh.yaml", "cells: " + "[" * 10000, [], 1),
    "deepTables": ("system/mesh.yaml", "cells: " + "{a: " * 10000 + "}" * 10000, ["nested more than 64 levels deep"], 1),
    "deepDashes": ("system/mesh.yaml", "cells:\n  " + "- " * 10000 + "a\n", ["nested more than 64 levels deep"], 1),
    "deepBlocks": ("system/mesh.yaml", "".join(" " * i + "a:\n" for i in range(1000)), ["nested more than 64 levels deep"], 1),
    "brackets": ("system/mesh.yaml", "[" * 4000000, [], 1),
    "openBraces": ("system/mesh.yaml", "{" * 4000000, [], 1),
    "closingBrackets": ("system/mesh.yaml", "a: " + "]" * 100000, [], 1),
    "colons": ("system/mesh.yaml", ": " * 100000, [], None),
    "quotes": ("system/mesh.yaml", "a: " + "'" * 100001, [], None),
    "garbage": ("constant/fluid.yaml", garbage, [], 1),
    "picture": ("constant/fluid.yaml", b"\x89PNG\r\n\x1a\n" + garbage, ["0x89"], 1),
    "nulBytes": ("constant/fluid.yaml", b"\0" * 100000, ["0x00"], 1),
    "utf16": ("constant/fluid.yaml", fluid.encode("utf-16"), ["UTF-16", "UTF-8"], 1),
    "utf16bigEndian": ("constant/fluid.yaml", fluid.encode("utf-16-be"), ["UTF-16"], 1),
    "utf32": ("constant/fluid.yaml", fluid.encode("utf-32"), ["UTF-16"], 1),
    "large": ("constant/fluid.yaml", None, ["105.0 MB", "at most 4 MB"], 1),
    "longValue": ("constant/fluid.yaml", "density: " + "x" * 1000000 + "\nviscosity: 1 Pa s\n", ["density"], 1),
    "longKey": ("constant/fluid.yaml", fluid + "x" * 900 + ": 1\n", ["unknown key"], 1),
    "longName": ("system/mesh.yaml", "domain: {size: [20 um, 16 um, 16 um], periodic: [true, true, false]}\ncells: [{name: " + "n" * 500000 + "}]\n", ["missing"], None),
    "aliases": ("constant/fluid.yaml", "a: &a [x, x]\n" + "".join(f"b{i}: &b{i} [*a, *a]\n" for i in range(1000)), ["anchor"], None),
    "tabs": ("constant/fluid.yaml", "\tdensity: 1\n" * 40000, ["a tab"], 1),
}
GOOD = {
    "longComment": fluid + "# " + "x" * 1000000 + "\n",
    "manyComments": fluid + "# x\n" * 300000,
    "blankLines": fluid + "\n" * 1000000,
    "byteOrderMark": "\ufeff" + fluid,
    "windowsLines": fluid.replace("\n", "\r\n"),
}


def run(program, base, folder, file, data):
    shutil.copytree(base, folder)
    if data is None:
        with open(folder / file, "wb") as large:  # sparse
            large.truncate(105_000_000)
    else:
        (folder / file).write_bytes(data if isinstance(data, bytes) else data.encode())
    begin = time.monotonic()
    result = subprocess.run([program, "-case", str(folder)], capture_output=True, timeout=120)
    return result.returncode, result.stdout.decode(errors="replace"), result.stderr.decode(errors="replace"), time.monotonic() - begin


def faults_of(code, out, err, seconds, words, number):
    lines = err.rstrip("\n").split("\n")
    faults = [] if code == 2 else [f"exit code {code}"]
    if match := CRASH.search(out + err):
        faults.append(f"'{match.group(0)}'")
    faults += [f"lacks '{word}'" for word in words if word not in err]
    if number is not None and f": {number} problem" not in lines[-1]:
        faults.append(f"not {number} problems: {lines[-1][:200]}")
    if len(lines) > MOST_LINES or max(map(len, lines)) > LONGEST_LINE:
        faults.append(f"{len(lines)} lines, the longest of {max(map(len, lines))} characters")
    if seconds > LONGEST_TIME:
        faults.append(f"{seconds:.1f} s")
    return faults


def main():
    base, program = pathlib.Path(sys.argv[1]) / "tests/applications/brokenCases/baseCase", pathlib.Path(sys.argv[2]) / "checkCase"
    failed = 0
    with tempfile.TemporaryDirectory() as top:
        for name, (file, data, words, number) in HOSTILE.items():
            code, out, err, seconds = run(program, base, pathlib.Path(top) / name, file, data)
            if faults := faults_of(code, out, err, seconds, words, number):
                failed += 1
                print(f"{name}: {'; '.join(faults)}\n{err[:1500]}")
        for name, text in GOOD.items():
            code, out, err, seconds = run(program, base, pathlib.Path(top) / name, "constant/fluid.yaml", text)
            if code != 0 or err or seconds > LONGEST_TIME:
                failed += 1
                print(f"{name}: exit code {code}, {seconds:.1f} s\n{err[:1500]}")
    print(f"{len(HOSTILE)} hostile and {len(GOOD)} good files, {failed} not answered as they should be")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
