#!/usr/bin/env python3
"""The basis of validation: tolerances, orders, interpolation, tables, results of membranes; invalid words on the command line."""
import contextlib
import io
import json
import math
import pathlib
import struct
import subprocess
import tempfile
import types
import unittest.mock
from fnmatch import fnmatchcase

import suite
import vtp
from membranes import snapshots, turn
from suite import Figure, asdict

HERE = pathlib.Path(__file__).resolve().parent


def record(n, error, allowed=1.0):
    return {"resolution": n, "particles": n**3, "coreSeconds": 1.5, "figures": [asdict(Figure("drag", error, allowed, order=True))]}


def test_held():
    assert Figure("a", -0.9, 1).holds() and Figure("a", 1, 1).holds()
    assert not Figure("a", 1.1, 1).holds() and not Figure("a", -1.1, 1).holds()
    assert not Figure("a", math.nan, 1).holds(), "what was not measured does not hold"
    figure = suite.relative("a", 0.98, 1, 1)
    assert math.isclose(figure.error, -2) and not figure.holds()


def test_bands():
    assert suite.outside(2.0, 1, 4) == 0 == suite.outside(4, 1, 4) and suite.outside(5, 1, 4) == 25 and suite.outside(0.5, 1, 4) == -50
    assert suite.outside(5, 1, 4, percent=False) == 1 and suite.outside(0.5, 1, 4, percent=False) == -0.5
    for values in ((math.nan, 1, 4), (2.0, math.nan, 4), (2.0, 1, math.nan)):
        assert math.isnan(suite.outside(*values)) and not Figure("a", suite.outside(*values), 100).holds(), values


def test_worst():
    assert suite.worst(iter((1, -3, 2))) == -3 and suite.worst((1, -3, 2), lambda v: v) == 2
    for values in ((), (math.nan, 1.0), (1.0, math.nan), (1.0, math.inf)):
        assert math.isnan(suite.worst(values)), values


def test_missed():
    """A figure that the page states as outside its tolerance does not fail; others do, as well as one with a larger error than stated or without value."""
    case = types.SimpleNamespace(MISSED={8: {"drag": 4, "lift *": 3}})
    for n, name, error, known in ((8, "drag", 3, True), (8, "drag, extrapolated", 3, False), (8, "lift at 2", -3, True), (8, "lift at 2", -3.1, False),
                                  (8, "drag", 4.1, False), (16, "drag", 3, False), (8, "drag", math.nan, False), (8, "drag", -math.inf, False)):
        figure = asdict(Figure(name, error, 1))
        assert suite.missed(case, n, figure) is known, (n, name, error)
        with contextlib.redirect_stdout(io.StringIO()) as said:
            assert suite.report(case, {"resolution": n, "particles": 1, "coreSeconds": 1, "figures": [figure]}) is known
        assert ("missed, as its page says" in said.getvalue()) is known and ("OUTSIDE" in said.getvalue()) is not known
    for name in suite.names():
        case, patterns = suite.load(name), set()
        for record in suite.recorded(name):
            for figure in record["figures"]:
                assert suite.holds(figure) or suite.missed(case, record["resolution"], figure), (name, record["resolution"], figure["name"])
                if not suite.holds(figure):
                    n = record["resolution"]
                    patterns |= {(n, words) for words in case.MISSED[n] if fnmatchcase(figure["name"], words)}
        assert patterns == {(n, words) for n, all_ in getattr(case, "MISSED", {}).items() for words in all_}, f"{name}: missed no longer"


def test_execute():
    """A finished run is not run again, unless its settings or files change; records of older versions are valid. The record says where and when."""
    record = {"status": "done", "ranks": 3, "end": "2026-01-02T23:59:59Z", "parameters": {"particles": 8},
              "machine": {"cores": 2, "processor": "AMD EPYC"}, "build": {"git": "0123abc"}, "performance": {"processorSeconds": 1.0, "instructionSet": "avx2"}}
    assert suite.origin(record) == ("2 cores, AMD EPYC, AVX2", "2026-01-02", "0123abc")
    with tempfile.TemporaryDirectory() as folder:
        source, case, count, words = (pathlib.Path(folder) / name for name in ("source", "case", "count", "words"))
        for part in ("system", "constant"):
            (source / part).mkdir(parents=True)
        mesh = source / "cell.off"
        for file in (source / "system/mesh.yaml", mesh):
            file.write_text("a")
        (pathlib.Path(folder) / "mpirun").write_text(f"#!/bin/sh\necho >>{count}\necho $* >{words}\ncat >{case}/run.json <<E\n{json.dumps(record)}\nE\n")
        (pathlib.Path(folder) / "mpirun").chmod(0o755)

        def prepare(folder):
            pass

        prepare.reads = (mesh,)

        def runs(*settings, earlier=0):
            with unittest.mock.patch.dict(suite.ENVIRONMENT, {"PATH": f"{folder}:{suite.ENVIRONMENT['PATH']}"}):
                found = suite.execute(suite.Run("a", source, list(settings), (prepare, "solver")), case, pathlib.Path(folder), 2)
            assert found == record | {"performance": record["performance"] | {"processorSeconds": 1.0 + earlier}}
            return len(count.read_text())

        assert [runs(), runs(), runs("b=1"), runs("b=1")] == [1, 1, 2, 2]
        (source / "system/mesh.yaml").write_text("b")
        assert [runs("b=1"), runs("b=1")] == [3, 3]
        mesh.write_text("b")
        assert [runs("b=1"), runs("b=1")] == [4, 4]
        note = case / "settings.json"  # as it was before the contents of files were recorded
        note.write_text(json.dumps(json.loads(note.read_text())[:3]))
        mesh.write_text("c")
        assert [runs("b=1"), runs("b=2")] == [4, 5]
        for part in (record | {"status": "stopped"}, {"status": "running"}):  # killed: its cost is not known
            (case / "run.json").write_text(json.dumps(part))
            runs("b=2", earlier=1)
        assert runs("b=2", earlier=1) == 7 and runs("b=3") == 8
        assert words.read_text().endswith(" -set b=3 -set system/control.yaml:/stop/wallClock=never\n"), "no limit of its tutorial ends it"


def test_executeTogether():
    """Two at a time on one rank, the last alone on two; a run that fails does not keep the others from being made, and is reported."""
    record = {"status": "done", "performance": {"processorSeconds": 1.0}}
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        source, log = folder / "source", folder / "log"
        for part in ("system", "constant"):
            (source / part).mkdir(parents=True)
        # A stand-in for mpirun: begins, waits for another run if there is to be one, ends.
        (folder / "mpirun").write_text(f"""#!/bin/sh
echo begin $2 $6 >>{log}
sleep 0.3
echo end $2 $6 >>{log}
case $6 in *bad) exit 3;; esac
echo '{json.dumps(record)}' >$6/run.json
""")
        (folder / "mpirun").chmod(0o755)
        runs = [(suite.Run(name, source, [], ("solver",)), folder / name) for name in ("a", "b", "bad", "c", "last")]
        with unittest.mock.patch.dict(suite.ENVIRONMENT, {"PATH": f"{folder}:{suite.ENVIRONMENT['PATH']}"}):
            try:
                suite.executeTogether(runs, folder, 2)
                failed = False
            except subprocess.CalledProcessError:
                failed = True
            assert failed and all((folder / name / "run.json").exists() for name in "abc"), log.read_text()
            log.write_text("")
            good = [run for run in runs if run[0].name != "bad"] + [(suite.Run("d", source, [], ("solver",)), folder / "d")]
            for name in "abc":
                (folder / name / "run.json").unlink()
            suite.executeTogether(good, folder, 2)
            words = [line.replace(f"{folder}/", "") for line in log.read_text().splitlines()]
            assert set(words[:2]) == {"begin 1 a", "begin 1 b"} and words[-2:] == ["begin 2 d", "end 2 d"] and len(words) == 10, words


def test_domain():
    """Another box changes only the box, in a folder of its own."""
    size, work = "[40 um, 32.5 um, 40 um]", pathlib.Path("work")
    for name in suite.names():
        if not getattr(suite.load(name), "UNBOUNDED", False):
            continue
        run = suite.load(name).runs(suite.load(name).RESOLUTIONS[0])[0]
        wide = suite.inDomain(run, size)
        (kept,) = set(run.settings) - set(wide.settings)
        assert kept.startswith(suite.SIZE) and set(wide.settings) - set(run.settings) == {suite.SIZE + size} and wide.name == run.name
    assert suite.folder("a", 6, work) == work / "a/6" and suite.folder("a", 6, work, size) == work / "a/6-40x32.5x40"


def test_images():
    """The sum over a sphere's images near a wall does not depend on where it is truncated."""
    box = suite.module(HERE / "sphereNearWall" / "wallBox.py", "wallBox")
    for towards in (True, False):
        assert math.isclose(box.images(3, 12, towards, 10), box.images(3, 12, towards, 60), rel_tol=1e-3), towards


def test_ranks():
    """The result of a membrane is the file of the rank that has written it."""
    with tempfile.TemporaryDirectory() as folder:
        results = pathlib.Path(folder) / "results"
        results.mkdir()
        vtp.write(results / "0.vtp", [], [], [], 0.25, {})
        vtp.write(results / "1.vtp", [(0.0, 0.0, 1.0)], [], [7], 0.25, {})
        (results / "all.pvtp").write_text('<VTKFile><PPolyData><Piece Source="0.vtp"/><Piece Source="1.vtp"/></PPolyData></VTKFile>')
        (results / "rbc.pvd").write_text('<VTKFile><Collection><DataSet timestep="2" file="all.pvtp"/></Collection></VTKFile>')
        assert snapshots(pathlib.Path(folder), "rbc") == [(2.0, results / "1.vtp")]


def test_orders():
    records = [record(8, 4.0), record(16, -1.0), record(48, 0.1)]
    first, second = suite.orders(records)["drag"]
    assert math.isclose(first, 2) and math.isclose(second, math.log(10) / math.log(3))
    assert suite.orders([record(8, 1.0), record(16, 0.0)]) == {}


def test_between():
    table = [{"strain": 0.0, "D": 1.0}, {"strain": 2.0, "D": 3.0}]
    assert suite.at(table, 0.5, "D") == 1.5 and suite.at(table, 0.5, lambda row: 2 * row["D"]) == 3
    assert math.isnan(suite.at(table, 2.5, "D"))
    turned = [{"strain": t, "angle_deg": angle} for t, angle in ((0, 0.0), (1, -2.0), (5, 80.0), (6, 100.0))]
    assert turn(turned, 90) == 5.5 and math.isnan(turn(turned, 180))


def test_permitted():
    table = {16: 1.0, 32: 0.4}
    assert suite.permitted(table, 32, 2) == 0.4 and suite.permitted(table, 8, 2) == 4 and suite.permitted(table, 64, 1) == 0.25


def literals(data):
    """A block of LZ4 without matches."""
    length = bytes([len(data) << 4]) if len(data) < 15 else bytes([0xF0, *[255] * ((len(data) - 15) // 255), (len(data) - 15) % 255])
    return length + data


def test_lz4():
    """Blocks made by liblz4 1.9.4 (LZ4_compress_default), and literals made by hand."""
    for block, data in ((bytes.fromhex("806d656d6272616e65"), b"membrane"),  # literals only
                        (bytes.fromhex("3f616263030021506263616263"), 20 * b"abc"),  # a match that reaches into itself
                        (bytes.fromhex("1f610100ffffffd2506161616161"), 1000 * b"a"),  # a length of four bytes
                        (b"\0", b""), *((literals(bytes(range(n))), bytes(range(n))) for n in (14, 15, 16, 200)),
                        (literals(600 * b"x"), 600 * b"x")):  # around 15 and past 255 literals
        assert vtp.lz4(block, len(data)) == data, block
    try:
        vtp.lz4(literals(b"membrane"), 9)
        raise AssertionError("a block that is too short was taken")
    except ValueError:
        pass


def test_surfaces():
    """A written surface is read again to the bit; blocks appended raw, compressed and not, give the same."""
    points, triangles = [(0.1, -2e-6, 1 / 3), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1e300)], [(0, 1, 2), (0, 3, 1), (0, 2, 3), (1, 3, 2)]
    raw = struct.pack("<12d", *(x for p in points for x in p))
    parts = [raw[k : k + 40] for k in range(0, len(raw), 40)]  # 40, 40 and 16 bytes
    packed = struct.pack("<6Q", 3, 40, 16, *(len(literals(part)) for part in parts)) + b"".join(map(literals, parts))
    head = ('<VTKFile type="PolyData" header_type="UInt64"{}><PolyData><Piece><PointData/><Points><DataArray type="Float64" Name="Points" '
            'NumberOfComponents="3" format="appended" offset="0"/></Points><Polys/></Piece></PolyData>\n<AppendedData encoding="raw">\n   _')
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "surface.vtp"
        vtp.write(path, points, triangles, list(range(4)), 0.25, {"case": "name: \u03b3", "empty": ""})
        read = vtp.File(path)
        assert list(map(tuple, read.points)) == points and read.triangles == triangles
        assert read.arrays == {"id": [0, 1, 2, 3], "spacing": [0.25] * 4} and read.texts == {"case": "name: \u03b3", "empty": ""}
        for words, data in ((' compressor="vtkLZ4DataCompressor"', packed), ("", struct.pack("<Q", len(raw)) + raw)):
            path.write_bytes(head.format(words).encode() + data + b"</AppendedData></VTKFile>")
            assert list(map(tuple, vtp.File(path).points)) == points, words


def test_tables():
    case = types.SimpleNamespace(ACROSS="across")
    lines = suite.table(case, [record(8, 4.0), record(16, 0.5)]).splitlines()
    assert lines[0].startswith("| across | 8 | 16 |") and "+4 % **outside** | +0.5 % | 3.0 | 1 %" in lines[2], lines


def test_words():
    for words, said in ((["nowhere"], "no case 'nowhere'"), (["couette", "-resolution", "fine"], "a number, or all"),
                        (["couette", "-resolutoin", "16"], "-resolutoin"), (["couette", "-domain", "[1 mm, 1 mm, 1 mm]", "-record"], "it has no -record"),
                        (["couette", "-domain", "[1 mm, 1 mm, 1 mm]"], "is that of its box")):
        done = subprocess.run([HERE / "validate", *words], capture_output=True, text=True)
        assert done.returncode == 1 and said in done.stderr and not done.stdout, done


def test_cases():
    """Each case is complete: page with its marks, resolutions from coarse to fine."""
    assert len(suite.names()) >= 3
    for name in suite.names():
        case, page = suite.load(name), (HERE / name / "README.md").read_text()
        assert all(page.count(mark) == 1 for mark in suite.MARKS), name
        assert list(case.RESOLUTIONS) == sorted(case.RESOLUTIONS) and case.TITLE and case.ACROSS, name
        assert all(run.source.is_dir() and run.programs for run in case.runs(case.RESOLUTIONS[0])), name


if __name__ == "__main__":
    for name, test in list(globals().items()):
        if name.startswith("test_"):
            test()
    print("passed")
