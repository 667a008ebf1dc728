#!/usr/bin/env python3
"""Many cells of one type: placed by a list or a table, on any number of ranks, with one stream of results and one table for each type.

    populationRuns.py BIN TEST    BIN: directory of the applications
"""
import math
import pathlib
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parent))
from runs import IMPLICIT_CASE, close, copied, last_checkpoint, prepared, run, same_checkpoint, table, vtp

BOX = "domain: {size: [16 um, 12 um, 12 um], periodic: [true, true, false]}\n"
SHAPE = "shape: {type: spheroid, a: 2.4 um, c: 1.8 um}, edge: 1 um"
PLACES = [((-4, 0, -2), (0, 0, 1)), ((4, 1, 2.5), (1, 0, 1)), ((3, -4, -2), (0, 0, 1))]  # the last reaches through the face across y
OBSERVERS = "deformation: {type: shape, every: 0.1 strain}\nbalance: {type: conservation, every: 0.1 strain}\n"
CASE = {**IMPLICIT_CASE, "system/observers.yaml": OBSERVERS,
        "system/control.yaml": "application: dmpFlow\nendStrain: 0.3\nwrite: {strain: 0.3}\ncheckpoint: {wallClock: never}\n"}


def vector(values, unit=" um"):
    return "[" + ", ".join(f"{v:g}{unit}" for v in values) + "]"


def listed(places):
    entries = "".join(f"  - {{centre: {vector(centre)}, axis: {vector(axis, '')}, scale: {scale}}}\n"
                      for centre, axis, scale in ((*place, 1)[:3] for place in places))
    return BOX + "cells:\n- name: rbc\n  shape: {type: spheroid, a: 2.4 um, c: 1.8 um}\n  edge: 1 um\n  places:\n" + entries


def cells(rows, number):
    """The rows of one cell from a table of many cells."""
    return [{key: value for key, value in row.items() if key != "cell"} for row in rows if row["cell"] == number]


def numbers(rows, but=()):
    return [[value for key, value in row.items() if key not in but] for row in rows]


def pieces(case, stream):
    return [vtp.File(path) for path in sorted((case / "results" / stream).glob(f"{stream}_*/*.vtp")) if vtp.count(path)]


def test_places(folder):
    """Three cells of one type give the same as three cells with names of their own; by a list, a CSV table and a VTP file alike."""
    alone = ", ".join(f"{{name: {name}, membrane: rbc, {SHAPE}, centre: {vector(centre)}, axis: {vector(axis, '')}}}"
                      for name, (centre, axis) in zip("abc", PLACES))
    single = prepared(folder / "single", CASE, **{"system/mesh.yaml": BOX + f"cells: [{alone}]\n"})
    run(single, "dmpFlow")
    many = prepared(folder / "many", CASE, **{"system/mesh.yaml": listed(PLACES)})
    run(many, "checkMesh")
    run(many, "dmpFlow")
    for number, name in enumerate("abc", 1):
        mine, theirs = cells(table(many, "deformation"), number), cells(table(single, "deformation", f"{name}.csv"), number)
        assert len(mine) == 4, mine
        close(numbers(mine, ("treadPhase_rad",)), numbers(theirs, ("treadPhase_rad",)), 1e-6)
        close(numbers(cells(table(many, "balance", "rbc.csv"), number), ("areaChange", "volumeChange")),
              numbers(cells(table(single, "balance", f"{name}.csv"), number), ("areaChange", "volumeChange")), 1e-7)
    # One stream with the number of each cell; the nodes of each are those of its own stream.
    for when in (0, 1):
        joined = pieces(many, "rbc")[when]
        of = joined.arrays["cell"]
        assert sorted(set(of)) == [1, 2, 3], set(of)
        for number, name in enumerate("abc", 1):
            own = [x for x, n in zip(joined.points, of) if n == number]
            theirs = pieces(single, name)[when].points
            assert len(own) == len(theirs) and max(math.dist(x, y) for x, y in zip(own, theirs)) < 1e-12
        assert all(len({of[n] for n in triangle}) == 1 for triangle in joined.triangles)
    # From files: the same bits.
    rows = "".join(f"{x},{y},{z},{a},{b},{c}\n" for (x, y, z), (a, b, c) in PLACES)
    points = " ".join(f"{1e-6 * v:.17g}" for (place, _) in PLACES for v in place)
    axes = " ".join(f"{v:g}" for (_, axis) in PLACES for v in axis)
    for name, text in (("cells.csv", "# three of them\nx_um, y_um, z_um, axis_x, axis_y, axis_z\n" + rows),
                       ("cells.vtp", '<?xml version="1.0"?>\n<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian"><PolyData>'
                                     f'<Piece NumberOfPoints="{len(PLACES)}" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="0">'
                                     f'<PointData><DataArray type="Float64" Name="axis" NumberOfComponents="3" format="ascii">{axes}</DataArray></PointData>'
                                     f'<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">{points}</DataArray></Points></Piece></PolyData></VTKFile>\n')):
        case = prepared(folder / name, CASE, **{
            name: text, "system/mesh.yaml": BOX + f"cells: [{{name: rbc, {SHAPE}, table: {name}}}]\n"})
        run(case, "dmpFlow")
        close(numbers(table(case, "deformation")), numbers(table(many, "deformation")), 1e-9)


def test_ranks(folder):
    """The same on 1, 2 and 4 ranks, some of which hold only some of the cells; restarts with the same bits; individual sizes."""
    places = [*PLACES[:2], (*PLACES[2], 0.7)]
    start = prepared(folder / "start", CASE, **{"system/mesh.yaml": listed(places)})
    ends = {}
    for ranks in (1, 2, 4):
        case = ends[ranks] = copied(start, folder / f"np{ranks}")
        run(case, "dmpFlow", ranks=ranks)
        close(numbers(table(case, "deformation")), numbers(table(ends[1], "deformation")), 1e-4)
        last = table(case, "balance")[-1]
        assert last["changedSide"] == last["guardMoves"] == 0 and abs(last["volumeChange"]) < 1e-9, last
        of = [number for piece in pieces(case, "rbc") for number in piece.arrays["cell"]]
        assert sorted(set(of)) == [1, 2, 3] and len(of) == 2 * len(pieces(ends[1], "rbc")[0].points), "each cell once at each time"
    volumes = {row["cell"]: row["volume_m3"] for row in table(ends[1], "balance", "rbc.csv")}
    assert abs(volumes[3] / volumes[1] - 0.343) < 1e-3, volumes
    for ranks in (1, 2):
        parts = copied(start, folder / f"parts{ranks}")
        run(parts, "dmpFlow", "-steps", "3", ranks=ranks)
        run(parts, "dmpFlow", ranks=ranks)
        same_checkpoint(last_checkpoint(ends[ranks]), last_checkpoint(parts))
        for observer in ("deformation", "balance"):
            assert numbers(table(parts, observer)) == numbers(table(ends[ranks], observer)), observer
    other = copied(start, folder / "other")
    run(other, "dmpFlow", "-steps", "3", ranks=2)
    run(other, "dmpFlow", ranks=4)
    close(numbers(table(other, "deformation")), numbers(table(ends[1], "deformation")), 1e-4)


def test_refused(folder):
    """Cells that overlap are named by their places, at the start and on any number of ranks; other places at a restart are rejected."""
    start = prepared(folder / "start", CASE, **{"system/mesh.yaml": listed(PLACES)})
    text = (start / "system/mesh.yaml").read_text()
    (start / "system/mesh.yaml").write_text(text.replace("[4 um, 1 um, 2.5 um]", "[-3 um, 0 um, -1 um]"))
    said = run(start, "particleFill", code=2).stderr
    assert "cells[0].places[1].centre: the cell 'rbc 1' and the cell 'rbc 2' overlap at (" in said, said
    said = run(start, "dmpFlow", code=2).stderr
    assert "cells[0].places" in said and "0/fluid.vtp was made for 3 places, checksum" in said and "run particleFill again" in said, said
    (start / "system/mesh.yaml").write_text(text)
    run(start, "dmpFlow", "-steps", "1")
    before = (start / "log.dmpFlow").read_text()
    (start / "system/mesh.yaml").write_text(text.replace("[4 um, 1 um, 2.5 um]", "[4 um, 1.5 um, 2.5 um]"))
    said = run(start, "dmpFlow", code=2).stderr
    assert "cells[0].places[1].centre" in said and "[4 um, 1.5 um, 2.5 um]" in said and "start from firstTime" in said, said
    assert (start / "log.dmpFlow").read_text() == before
    # Tables are compared by their contents.
    case = prepared(folder / "table", CASE, **{
        "places.csv": "x_um,y_um,z_um\n-4,0,0\n4,0,0\n", "system/mesh.yaml": BOX + f"cells: [{{name: rbc, {SHAPE}, table: places.csv}}]\n"})
    run(case, "dmpFlow", "-steps", "1", ranks=2)
    (case / "places.csv").write_text("x_um,y_um,z_um\n-4,0,0\n4,0.5,0\n")
    run(case, "particleFill")
    said = run(case, "dmpFlow", code=2, ranks=2).stderr
    assert "cells[0].table" in said and "places.csv with 2 places, checksum" in said, said


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as temporary:
        globals()["test_" + sys.argv[2]](pathlib.Path(temporary))
    print("passed")
