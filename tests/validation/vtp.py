"""Reads VTK XML PolyData as the programs write them: appended raw data, blocks compressed by LZ4. Gives points, arrays, triangles and texts.

python3-vtk9 would be another package to install, of 47 MB, and conflicts with Debian's ParaView; results without compression would be larger for
all users: a capsule's surface by 17 %, its fluid by 36 %.
"""
import ctypes
import pathlib
import re
import struct
import xml.etree.ElementTree as ElementTree

LZ4 = ctypes.CDLL("liblz4.so.1")


def lz4(block, size):
    """A block of LZ4, decoded with the library that VTK itself needs, which is present wherever the programs are."""
    out = ctypes.create_string_buffer(size)
    found = LZ4.LZ4_decompress_safe(block, out, len(block), size)
    if found != size:
        raise ValueError(f"a block of {size} bytes came to {found}")
    return out.raw


class File:
    """points: list of (x, y, z); triangles; arrays: point arrays by name; texts: field strings by name, without the checksum."""

    TYPES = {"Float64": "d", "Float32": "f", "Int64": "q", "Int32": "i", "UInt8": "B", "Int8": "b"}

    def __init__(self, path):
        data = pathlib.Path(path).read_bytes()
        head, mark, rest = data.partition(b"<AppendedData")
        self.appended = memoryview(rest)[rest.find(b"_") + 1 :]
        root = ElementTree.fromstring(head + b"</VTKFile>" if mark else head)
        self.compressed = "compressor" in root.attrib
        piece = root.find("PolyData/Piece")
        self.points = self.tuples(piece.find("Points/DataArray"))
        self.arrays = {a.get("Name"): self.tuples(a) for a in piece.findall("PointData/DataArray")}
        corners = {a.get("Name"): self.values(a) for a in piece.findall("Polys/DataArray")}
        corners = corners.get("connectivity", ())
        self.triangles = [tuple(corners[i : i + 3]) for i in range(0, len(corners), 3)]
        self.texts = {a.get("Name"): self.decoded(a).split(b"\0")[0].decode()
                      for a in root.findall("PolyData/FieldData/*") if a.get("type") == "String" and a.get("Name") != "checksum"}

    def decoded(self, array):
        if array.get("format") == "ascii":
            return bytes(map(int, array.text.split()))
        at = int(array.get("offset"))
        if not self.compressed:
            (size,) = struct.unpack_from("<Q", self.appended, at)
            return bytes(self.appended[at + 8 : at + 8 + size])
        blocks, size, last = struct.unpack_from("<3Q", self.appended, at)
        lengths = struct.unpack_from(f"<{blocks}Q", self.appended, at + 24)
        at, out = at + 24 + 8 * blocks, b""
        for k, length in enumerate(lengths):
            out += lz4(bytes(self.appended[at : at + length]), last if k == blocks - 1 and last else size)
            at += length
        return out

    def values(self, array):
        kind = self.TYPES[array.get("type")]
        if array.get("format") == "ascii":
            return tuple(map(float if kind in "df" else int, array.text.split()))
        data = self.decoded(array)
        return struct.unpack(f"<{len(data) // struct.calcsize(kind)}{kind}", data)

    def tuples(self, array):
        flat, width = self.values(array), int(array.get("NumberOfComponents", 1))
        return list(flat) if width == 1 else [flat[i : i + width] for i in range(0, len(flat), width)]


def count(path):
    """Number of points of a surface; nothing else is read."""
    head = pathlib.Path(path).read_bytes().partition(b"<AppendedData")[0]
    return sum(map(int, re.findall(rb'<Piece [^>]*NumberOfPoints="(\d+)', head)))


WORD = (1 << 64) - 1


def mix(z):
    z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9 & WORD
    z = (z ^ z >> 27) * 0x94D049BB133111EB & WORD
    return z ^ z >> 31


def checksum(parts):
    """The checksum of libs/io/dataChecksum.hpp; parts: (name, numbers or a text or a float array)."""
    def words(values):
        if isinstance(values, str):
            return values.encode()
        return [struct.unpack("<Q", struct.pack("<d", v))[0] if isinstance(v, float) else v for v in values]

    def total(values):
        return sum(mix(v + (i + 1) * 0x9E3779B97F4A7C15 & WORD) for i, v in enumerate(words(values))) & WORD

    state = 0
    for name, values in parts:
        state = mix(state + total(name) & WORD)
        state = mix(state + total(values) & WORD) + len(words(values)) & WORD
    return f"{state:016x}"


def write(path, points, triangles, ids, spacing, texts):
    """A closed surface as membraneMesh writes it, in plain text."""
    texts = dict(sorted(texts.items()))
    if texts:
        parts = [("points", [float(x) for p in points for x in p]), ("triangles", [n for t in triangles for n in t]), ("lines", []),
                 ("point scalar spacing", [float(spacing)] * len(points)), ("point integer id", ids), ("field TimeValue", [0.0]), ("field strain", [0.0]),
                 *((f"text {name}", text) for name, text in texts.items())]
        texts["checksum"] = checksum(parts)

    def array(kind, name, values, width=1):
        words = " ".join(repr(v) if isinstance(v, float) else str(v) for v in values)
        return f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{width}" format="ascii">{words}</DataArray>'

    strings = "".join(f'<Array type="String" Name="{name}" NumberOfTuples="1" format="ascii">'
                      f'{" ".join(str(b) for b in text.encode())} 0</Array>' for name, text in texts.items())
    numbers = "".join(f'<DataArray type="Float64" Name="{name}" NumberOfTuples="1" format="ascii">0</DataArray>' for name in ("TimeValue", "strain"))
    lines = [
        '<?xml version="1.0"?>', '<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64">', "<PolyData>",
        f"<FieldData>{numbers}{strings}</FieldData>",
        f'<Piece NumberOfPoints="{len(points)}" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="{len(triangles)}">',
        f'<PointData>{array("Int64", "id", ids)}{array("Float64", "spacing", [spacing] * len(points))}</PointData>',
        f'<Points>{array("Float64", "Points", [x for p in points for x in p], 3)}</Points>',
        f'<Polys>{array("Int64", "connectivity", [n for t in triangles for n in t])}'
        f'{array("Int64", "offsets", [3 * (k + 1) for k in range(len(triangles))])}</Polys>',
        "</Piece>", "</PolyData>", "</VTKFile>"]
    pathlib.Path(path).write_text("\n".join(lines) + "\n")
