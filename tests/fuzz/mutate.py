#!/usr/bin/env python3
"""Mutated input for the programs: whatever a file holds, they end by themselves and say what is wrong with it.

    mutate.py KIND [-count N] [-seconds S] [-seed K] [-first N] [-short] [-jobs J] [-keep DIR] [-programs DIR]

KIND           program     input
dictionaries   checkCase   system/*.yaml and constant/*.yaml of the tutorials
surfaces       membraneMesh   STL, OFF, PLY and VTP files of a cell, in several dialects
start          checkMesh   0/*.vtp
checkpoints    dmpFlow     checkpoints/*.h5, in a restart

Input number n of a kind is made from the seed and n alone, so that -first n -count 1 makes it again. Each outcome is one of
    ok            exit 0; what 0/*.vtp and a checkpoint hold is what it was
    refused       exit 1 to 4 with a message
and these faults:
    signal        ended by a signal
    hang          ran for more than 20 s
    bare          a message of a library, not of the program: std::, CGAL, addresses of objects
    silent        a refusal without a message
    changed       exit 0, though 0/*.vtp or the checkpoint holds other data (system/ and constant/ may hold other values)
    nan           exit 0 and NaN or infinity in what was said
    code          another exit code
The input of each fault is kept in -keep (build/fuzz) under its number. Exit 1 if there was any.
"""
import argparse
import collections
import json
import math
import os
import random
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BARE = re.compile(r"std::|CGAL|(?-i:\bvtk[A-Z]\w*)|0x[0-9a-f]{5,}|terminate called|basic_string|vector::_M|bad_alloc|HDF5-DIAG|yaml-cpp|"
                  r"what\(\)|\bsto[idul]+\b|MPI_ABORT|json\.exception|assertion", re.I)
NUMBER = re.compile(r"(?<![\w.])[-+]?\d+\.?\d*(?:[eE][-+]?\d+)?")
HOSTILE = ["nan", "-nan", "inf", "-inf", "1e300", "-1e300", "1e-300", "0", "-0", "-1", "1", "2", "1e400", "99999999999999999999",
           "1000000000", "4294967296", "2147483648", "-2147483649", "0x10", "1,5", "1.5.2", "1e", "", "1d3", "0.1", "1e-9", "1e9", "1e6"]
WORDS = ["null", "~", "true", "no", "[]", "{}", "[[[[[[", "}}}}", "&a", "*a", "!!binary", "---", "...", "\t", "#", ":", ": ", "- ", "? ",
         "|", ">", "'", '"', "%", "@", "`", "\\", "\x00", "\x1b[2J", "\ufeff", "µm", "um", "m", "kg/m^3", "Pa s", "dx", "strain", "s^-99999999",
         "m^1000000", "%s%n%n", "{}{:1000000}", "../../../../etc/passwd", "a" * 5000, "[" * 3000, "{a: " * 1000, "\n" * 50]


# Changes of bytes or text, for any kind of file.

def spans(rng, n, most=40):
    at = rng.randrange(n + 1)
    return at, min(n, at + 1 + int(rng.expovariate(1 / 8)) % most)


def mutate_bytes(rng, data):
    data = bytearray(data)
    for _ in range(1 + int(rng.expovariate(0.7))):
        n = len(data)
        if n == 0:
            return bytes(data)
        what = rng.randrange(9)
        a, b = spans(rng, n)
        if what == 0:
            data[rng.randrange(n)] ^= 1 << rng.randrange(8)
        elif what == 1:
            data[rng.randrange(n)] = rng.choice([0, 1, 0x7F, 0x80, 0xFF, rng.randrange(256)])
        elif what == 2:
            del data[a:b]
        elif what == 3:
            data[a:a] = data[a:b]
        elif what == 4:
            data[a:b] = bytes(rng.randrange(256) for _ in range(b - a))
        elif what == 5:
            del data[rng.randrange(n):]
        elif what == 6:  # a number of 4 or 8 bytes
            width = rng.choice([4, 8])
            if n > width:
                at = rng.randrange(n - width)
                value = rng.choice([0, 1, -1, 10**9, 2**31 - 1, -2**31, 255, 65536, 2**62 if width == 8 else 2**30])
                data[at:at + width] = struct.pack("<i" if width == 4 else "<q", value)
        elif what == 7:
            width = rng.choice([4, 8])
            if n > width:
                at = rng.randrange(n - width)
                value = rng.choice([math.nan, math.inf, -math.inf, 1e30, 1e-30, 0.0, -1.0] + ([1e300, 5e-324] if width == 8 else []))
                data[at:at + width] = struct.pack("<f" if width == 4 else "<d", value)
        else:
            c, d = spans(rng, n)
            data[a:b] = data[c:d]
    return bytes(data)


def mutate_text(rng, text):
    for _ in range(1 + int(rng.expovariate(0.7))):
        what = rng.randrange(10)
        lines = text.split("\n")
        numbers = list(NUMBER.finditer(text))
        words = list(re.finditer(r"[A-Za-z]\w*", text))
        if what <= 2 and numbers:
            m = rng.choice(numbers)
            text = text[:m.start()] + rng.choice(HOSTILE) + text[m.end():]
        elif what == 3 and words:
            m, o = rng.choice(words), rng.choice(words)
            text = text[:m.start()] + rng.choice([o.group(), rng.choice(WORDS)]) + text[m.end():]
        elif what == 4:
            at = rng.randrange(len(text) + 1)
            text = text[:at] + rng.choice(WORDS) + text[at:]
        elif what == 5:
            at = rng.randrange(len(lines))
            lines.insert(rng.randrange(len(lines) + 1), lines[at])
            text = "\n".join(lines)
        elif what == 6:
            del lines[rng.randrange(len(lines))]
            text = "\n".join(lines)
        elif what == 7:
            a, b = rng.randrange(len(lines)), rng.randrange(len(lines))
            lines[a], lines[b] = lines[b], lines[a]
            text = "\n".join(lines)
        elif what == 8:
            return mutate_bytes(rng, text.encode("utf-8", "surrogateescape")).decode("utf-8", "surrogateescape")
        else:
            a, b = spans(rng, len(text), 400)
            text = text[:a] + text[b:]
    return text


def to_bytes(text):
    return text.encode("utf-8", "surrogateescape")


# A cell as a mesh: an icosahedron refined, flattened like a lentil.

def lentil(refinements=2):
    g = (1 + math.sqrt(5)) / 2
    points = [(-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g), (0, -1, -g), (0, 1, -g), (g, 0, -1), (g, 0, 1), (-g, 0, -1),
              (-g, 0, 1)]
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2), (10, 7, 6), (7, 1, 8), (3, 9, 4),
             (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)]
    for _ in range(refinements):
        middle, finer = {}, []

        def mid(a, b):
            key = (min(a, b), max(a, b))
            if key not in middle:
                middle[key] = len(points)
                points.append(tuple((p + q) / 2 for p, q in zip(points[a], points[b])))
            return middle[key]
        for a, b, c in faces:
            ab, bc, ca = mid(a, b), mid(b, c), mid(c, a)
            finer += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        faces = finer
    unit = [tuple(x / math.sqrt(sum(y * y for y in p)) for x in p) for p in points]
    return [(4 * x, 4 * y, 2.5 * z) for x, y, z in unit], faces


def surface_files(refinements=2):
    """name -> bytes"""
    points, faces = lentil(refinements)
    line = lambda p: " ".join(f"{x:.9g}" for x in p)
    stl = "solid cell\n" + "".join(
        " facet normal 0 0 0\n  outer loop\n" + "".join(f"   vertex {line(points[i])}\n" for i in f) + "  endloop\n endfacet\n"
        for f in faces) + "endsolid cell\n"
    binary = b"x" * 80 + struct.pack("<I", len(faces)) + b"".join(
        struct.pack("<12fH", 0, 0, 0, *(x for i in f for x in points[i]), 0) for f in faces)
    body = "".join(line(p) + "\n" for p in points)
    off = f"OFF\n{len(points)} {len(faces)} 0\n{body}" + "".join("3 %d %d %d\n" % f for f in faces)
    coff = f"COFF\n{len(points)} {len(faces)} 0\n" + "".join(line(p) + " 255 0 0 255\n" for p in points) + "".join("3 %d %d %d\n" % f for f in faces)

    def ply(form):
        head = (f"ply\nformat {form} 1.0\nelement vertex {len(points)}\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
                f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n").encode()
        if form == "ascii":
            return head + "".join(line(p) + " 7\n" for p in points).encode() + "".join("3 %d %d %d\n" % f for f in faces).encode()
        order = "<" if "little" in form else ">"
        return head + b"".join(struct.pack(order + "3fB", *p, 7) for p in points) + b"".join(struct.pack(order + "B3i", 3, *f) for f in faces)

    def vtp(mode, strips=False):
        kind, cells = ("Strips", [(a, b, c) for a, b, c in faces]) if strips else ("Polys", faces)
        arrays = [("Float32", 'NumberOfComponents="3"', struct.pack(f"<{3 * len(points)}f", *(x for p in points for x in p)), body),
                  ("Int32", 'Name="connectivity"', struct.pack(f"<{3 * len(cells)}i", *(i for f in cells for i in f)),
                   " ".join("%d %d %d" % f for f in cells)),
                  ("Int32", 'Name="offsets"', struct.pack(f"<{len(cells)}i", *range(3, 3 * len(cells) + 1, 3)),
                   " ".join(str(3 * (i + 1)) for i in range(len(cells))))]
        appended, tags = b"", []
        import base64
        for kind_of, more, data, text in arrays:
            block = struct.pack("<I", len(data)) + data
            if mode == "ascii":
                tags.append(f'<DataArray type="{kind_of}" {more} format="ascii">{text}</DataArray>')
            elif mode == "binary":
                tags.append(f'<DataArray type="{kind_of}" {more} format="binary">{base64.b64encode(block).decode()}</DataArray>')
            else:
                tags.append(f'<DataArray type="{kind_of}" {more} format="appended" offset="{len(appended)}"/>')
                appended += block
        text = (f'<?xml version="1.0"?>\n<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian">\n<PolyData>\n<Piece NumberOfPoints='
                f'"{len(points)}" NumberOf{kind}="{len(cells)}">\n<Points>{tags[0]}</Points>\n<{kind}>\n{tags[1]}\n{tags[2]}\n</{kind}>\n</Piece>\n</PolyData>\n')
        tail = b'<AppendedData encoding="raw">_' + appended + b"</AppendedData>\n" if appended else b""
        return text.encode() + tail + b"</VTKFile>\n"

    return {"ascii.stl": stl.encode(), "binary.stl": binary, "plain.off": off.encode(), "colour.off": coff.encode(), "ascii.ply": ply("ascii"),
            "little.ply": ply("binary_little_endian"), "big.ply": ply("binary_big_endian"), "ascii.vtp": vtp("ascii"), "binary.vtp": vtp("binary"),
            "appended.vtp": vtp("appended"), "strips.vtp": vtp("ascii", True)}


# Cases.

CELL = {
    "system/control.yaml": "application: dmpFlow\nstartFrom: latestTime\nendStrain: 0.1\nwrite: {strain: 0.1, fields: [velocity], keep: all}\n",
    "system/numerics.yaml": "spacing: 1 um\nkernel: {type: wendlandC2, support: 2.4 dx}\nintegrator: implicit\ncoupling: immersed\n"
                            "operators: corrected\nshifting: {coefficient: 1}\n",
    "system/mesh.yaml": "domain: {size: [14 um, 12 um, 12 um], periodic: [true, true, false]}\n"
                        "cells: [{name: rbc, shape: SHAPE, edge: 1.2 um, centre: [0 um, 0 um, 0 um], axis: [0, 0, 1]}]\n",
    "constant/fluid.yaml": "density: 1000 kg/m^3\nviscosity: 1.0e-3 Pa s\nequationOfState: {type: tait, gamma: 7, soundSpeed: auto}\n",
    "constant/membranes.yaml": "rbc:\n  interior: {viscosityRatio: 1}\n  bonds: {type: harmonic, k: 5e-4 N/m}\n"
                               "  bending: {type: dihedral, Eb: 0.01}\n  rupture: none\n",
    "constant/flow.yaml": "type: shear\nCa: 0.02\ninertia: {Re: 0.1}\nwalls: {normal: z}\n",
}
FLUID = {
    "system/control.yaml": "application: dmpFlow\nstartFrom: latestTime\nendTime: 1 ms\nwrite: {time: 1 ms, fields: [velocity], keep: all}\n"
                           "checkpoint: {wallClock: 5 min, keep: 2}\n",
    "system/numerics.yaml": "spacing: 1 um\nkernel: {type: wendlandC2, support: 2.4 dx}\nintegrator: velocityVerlet\noperators: plain\n",
    "system/mesh.yaml": "domain: {size: [6 um, 6 um, 6 um], periodic: [true, true, false]}\n",
    "constant/fluid.yaml": "density: 1000 kg/m^3\nviscosity: 1.0e-3 Pa s\nequationOfState: {type: tait, gamma: 7, soundSpeed: auto}\n",
    "constant/flow.yaml": "type: shear\nshearRate: 1000 1/s\nwalls: {normal: z}\n",
}


def write_case(folder, files, shape=""):
    for name, text in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text.replace("SHAPE", shape))


class Driver:
    """Runs fuzzPrograms, one input after the other; where it has not been built, the programs themselves, which takes longer."""

    def __init__(self, programs):
        self.programs, self.process = programs, None
        if (programs / "fuzzPrograms").exists():
            self.process = subprocess.Popen([str(programs / "fuzzPrograms")], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def run(self, program, *arguments, seconds=20):
        if not self.process:
            return self.alone(program, *arguments, seconds=seconds)
        self.process.stdin.write("\t".join([program, str(seconds), *map(str, arguments)]) + "\n")
        self.process.stdin.flush()
        answer = self.process.stdout.readline()
        if not answer:
            raise RuntimeError("fuzzPrograms itself has ended")
        return json.loads(answer)

    def alone(self, program, *arguments, seconds):
        if program == "digest":
            sys.exit("mutate.py: this kind needs fuzzPrograms: ninja -C build fuzzPrograms")
        begin = time.time()
        process = subprocess.Popen([str(self.programs / program), *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                   stdin=subprocess.DEVNULL)
        over = False
        try:
            text = process.communicate(timeout=seconds)[0]
        except subprocess.TimeoutExpired:
            over = True
            process.kill()
            text = process.communicate()[0]
        return {"code": max(process.returncode, -1), "signal": max(0, -process.returncode), "over": over, "seconds": time.time() - begin,
                "text": text[-4000:].decode(errors="replace")}

    def close(self):
        if self.process:
            self.process.stdin.close()
            self.process.wait()


class Kind:
    """make(n, rng) -> (name, bytes); run(driver, folder, name, bytes) -> answer; changed(...) -> whether accepted data differ."""

    def __init__(self, programs, folder):
        self.programs, self.folder = programs, folder
        self.prepare()

    def setup(self, *command):
        done = subprocess.run([str(self.programs / command[0]), *map(str, command[1:])], capture_output=True, text=True)
        if done.returncode not in (0, 5):
            sys.exit(f"mutate.py: {command}: exit {done.returncode}\n{done.stdout}{done.stderr}")

    def copy(self, worker):
        """The case of one worker."""
        folder = self.folder / f"case{worker}"
        if not folder.exists():
            shutil.copytree(self.folder / "base", folder)
        return folder

    def changed(self, driver, case, answer):
        return False


class Dictionaries(Kind):
    def prepare(self):
        self.cases = sorted(p.parent for p in (ROOT / "tutorials").rglob("system") if (p / "control.yaml").exists() and (p / "mesh.yaml").exists())
        self.files = [(case, path) for case in self.cases for path in sorted(case.glob("system/*.yaml")) + sorted(case.glob("constant/*.yaml"))]

    def make(self, n, rng):
        case, path = self.files[rng.randrange(len(self.files))]
        text = path.read_text()
        return f"{self.cases.index(case)}/{path.relative_to(case)}", to_bytes(mutate_text(rng, text))

    def copy(self, worker):
        return self.folder / f"case{worker}"

    def run(self, driver, case, name, data):
        index, file = name.split("/", 1)
        folder = case / index
        if not folder.exists():
            for part in ("system", "constant"):
                shutil.copytree(self.cases[int(index)] / part, folder / part)
        path = folder / file
        before = path.read_bytes()
        path.write_bytes(data)
        answer = driver.run("checkCase", "-case", folder)
        path.write_bytes(before)
        return answer


class Surfaces(Kind):
    def prepare(self):
        self.files = list(surface_files().items())
        write_case(self.folder / "base", CELL, "{type: file, file: NAME}")

    def make(self, n, rng):
        name, data = self.files[rng.randrange(len(self.files))]
        isText = name.startswith(("ascii", "plain", "colour", "strips")) and rng.random() < 0.7
        if isText:
            return name, to_bytes(mutate_text(rng, data.decode()))
        if rng.random() < 0.3:  # the head only, which holds the counts
            head = data[:400].decode("latin-1")
            return name, mutate_text(rng, head).encode("latin-1", "replace") + data[400:]
        return name, mutate_bytes(rng, data)

    def run(self, driver, case, name, data):
        (case / name).write_bytes(data)
        mesh = case / "system/mesh.yaml"
        mesh.write_text(re.sub(r"file: [^}]*}", f"file: {name}}}", mesh.read_text()))
        return driver.run("membraneMesh", "-case", case)


class Start(Kind):
    def prepare(self):
        write_case(self.folder / "base", CELL, "{type: sphere, radius: 3 um}")
        self.setup("membraneMesh", "-case", self.folder / "base")
        self.setup("particleFill", "-case", self.folder / "base")
        self.names = ["0/rbc.vtp", "0/fluid.vtp", "0/walls.vtp"]
        self.data = {name: (self.folder / "base" / name).read_bytes() for name in self.names}

    def make(self, n, rng):
        name = rng.choice(self.names)
        data = self.data[name]
        if rng.random() < 0.3:
            end = data.find(b"<AppendedData")
            return name, mutate_text(rng, data[:end].decode("latin-1")).encode("latin-1", "replace") + data[end:]
        return name, mutate_bytes(rng, data)

    def run(self, driver, case, name, data):
        (case / name).write_bytes(data)
        answer = driver.run("checkMesh", "-case", case)
        if answer["code"] == 0:
            answer["digest"] = driver.run("digest", case / name)["text"]
            answer["digestBefore"] = driver.run("digest", self.folder / "base" / name)["text"]
        (case / name).write_bytes(self.data[name])
        return answer

    def changed(self, driver, case, answer):
        return answer["digest"] != answer["digestBefore"]


class Checkpoints(Kind):
    def prepare(self):
        write_case(self.folder / "base", FLUID)
        self.setup("particleFill", "-case", self.folder / "base")
        self.setup("dmpFlow", "-case", self.folder / "base", "-steps", 3)
        found = sorted((self.folder / "base/checkpoints").glob("*.h5"))
        if not found:
            sys.exit("mutate.py: no checkpoint was written")
        self.name = f"checkpoints/{found[-1].name}"
        for other in found[:-1]:
            other.unlink()
        self.data = (self.folder / "base" / self.name).read_bytes()
        self.content = self.dump(self.folder / "base" / self.name)

    @staticmethod
    def dump(path):
        done = subprocess.run(["h5dump", str(path)], capture_output=True)
        return done.returncode, done.stdout.split(b"\n", 1)[-1]

    def make(self, n, rng):
        return self.name, mutate_bytes(rng, self.data)

    def run(self, driver, case, name, data):
        shutil.rmtree(case)
        shutil.copytree(self.folder / "base", case)
        (case / name).write_bytes(data)
        answer = driver.run("dmpFlow", "-case", case, "-steps", 1)
        answer["content"] = answer["code"] in (0, 5) and data != self.data and "passed over" not in answer["text"]
        if answer["content"]:
            (case / "mutated.h5").write_bytes(data)
            answer["content"] = self.dump(case / "mutated.h5") != self.content
        return answer

    def changed(self, driver, case, answer):
        return answer["content"]


KINDS = {"dictionaries": (Dictionaries, 5000, 250), "surfaces": (Surfaces, 5000, 250), "start": (Start, 2000, 120),
         "checkpoints": (Checkpoints, 500, 40)}


def classify(kind, driver, case, answer):
    text = answer["text"]
    if answer["over"]:
        return "hang"
    if answer["signal"]:
        return "signal"
    if answer["code"] in (0, 5):
        if kind.changed(driver, case, answer):
            return "changed"
        return "nan" if re.search(r"(?<![\w./-])-?(nan|inf)(?![\w.])", text) else "ok"
    if answer["code"] not in (1, 2, 3, 4):
        return "code"
    if BARE.search(re.sub(r"(?<!\w)'[^']*'", "''", text)):  # words quoted from the file do not count
        return "bare"
    return "refused" if len(text.strip().splitlines()) >= 1 and re.search(r"[a-z]{3}", text) else "silent"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("kind", choices=KINDS)
    parser.add_argument("-count", type=int)
    parser.add_argument("-seconds", type=float, help="stop after so many seconds, however many inputs there were")
    parser.add_argument("-seed", type=int, default=1)
    parser.add_argument("-first", type=int, default=0)
    parser.add_argument("-short", action="store_true", help="some hundred")
    parser.add_argument("-jobs", type=int, default=1)
    parser.add_argument("-keep", type=Path, default=ROOT / "build/fuzz")
    parser.add_argument("-programs", type=Path, default=ROOT / "build/bin")
    options = parser.parse_args()
    make, count, short = KINDS[options.kind]
    count = options.count or (short if options.short else 10**9 if options.seconds else count)
    begin, lock, outcomes, faults = time.time(), threading.Lock(), collections.Counter(), []
    numbers = iter(range(options.first, options.first + count))
    slowest = [0.0, -1]
    with tempfile.TemporaryDirectory(prefix="corpuscleFuzz") as folder:
        kind = make(options.programs, Path(folder))

        def work(worker):
            driver, case = Driver(options.programs), kind.copy(worker)
            while True:
                with lock:
                    n = next(numbers, None)
                if n is None or (options.seconds and time.time() - begin > options.seconds):
                    break
                name, data = kind.make(n, random.Random(f"{options.kind} {options.seed} {n}"))
                answer = kind.run(driver, case, name, data)
                outcome = classify(kind, driver, case, answer)
                with lock:
                    outcomes[outcome] += 1
                    if answer["seconds"] > slowest[0]:
                        slowest[:] = [answer["seconds"], n]
                    if outcome in ("ok", "refused"):
                        continue
                    faults.append((n, outcome, name, answer))
                    options.keep.mkdir(parents=True, exist_ok=True)
                    (options.keep / f"{options.kind}-{options.seed}-{n}-{outcome}-{name.replace('/', '_')}").write_bytes(data)
                    last = (answer["text"].strip().splitlines() or [""])[-1][:200]
                    print(f"{outcome:8} input {n} {name}: code {answer['code']}, signal {answer['signal']}, {answer['seconds']:.1f} s: {last}", flush=True)
            driver.close()

        workers = [threading.Thread(target=work, args=(w,)) for w in range(options.jobs)]
        for worker in workers:
            worker.start()
        for worker in workers:
            worker.join()
    total = sum(outcomes.values())
    print(f"{options.kind}: {total} inputs in {time.time() - begin:.0f} s: " + ", ".join(f"{n} {word}" for word, n in sorted(outcomes.items())) +
          f"; the slowest took {slowest[0]:.1f} s (input {slowest[1]})")
    return 1 if faults or total == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
