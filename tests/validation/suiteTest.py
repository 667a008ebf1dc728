#!/usr/bin/env python3
"""What validation rests on: what counts as held, orders, interpolation, tables, results of membranes; bad words on the command line."""
import math
import pathlib
import struct
import subprocess
import sys
import tempfile
import types

import suite
import vtp
from membranes import turn
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
    """Blocks that liblz4 1.9.4 (LZ4_compress_default) makes, and two by hand."""
    for block, data in ((bytes.fromhex("806d656d6272616e65"), b"membrane"),  # literals only
                        (bytes.fromhex("3f616263030021506263616263"), 20 * b"abc"),  # a match that reaches into itself
                        (bytes.fromhex("1f610100ffffffd2506161616161"), 1000 * b"a"),  # a length of four bytes
                        (bytes([0x40, *b"abcd", 2, 0, 0x10, *b"e"]), b"abcdcdcde"),  # overlap that ends within a repetition
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
                        (["couette", "-resolutoin", "16"], "-resolutoin")):
        done = subprocess.run([HERE / "validate", *words], capture_output=True, text=True)
        assert done.returncode == 1 and said in done.stderr and not done.stdout, done


def test_cases():
    """Each is whole: page with its marks, resolutions from coarse to fine."""
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
