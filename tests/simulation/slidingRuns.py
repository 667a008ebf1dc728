#!/usr/bin/env python3
"""Sheared boxes without walls, whose periodic images slide (the flow leesEdwards): cells on the faces, restarts, ranks, what is refused.

    slidingRuns.py BIN TEST    BIN: directory of the applications
"""
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parent))
from runs import IMPLICIT_CASE, copied, last_checkpoint, make, prepared, run, same_in_parts, series, table

SPHERE = "{{name: {}, membrane: rbc, shape: {{type: sphere, radius: 2.4 um}}, edge: 0.7 um, centre: [{} um, {} um, {} um]}}"
# Two capsules, of which the second, on the sliding faces, must pass the first: at strain 1.3 they would touch, were it not for the fluid.
CASE = {
    **IMPLICIT_CASE,
    "system/mesh.yaml": "domain: {size: [11.2 um, 8.4 um, 8.4 um], periodic: [true, true, true]}\n"
                        f"cells: [{SPHERE.format('a', -1.4, 0, 0.6)}, {SPHERE.format('b', -5.2, 0.4, 4.2)}]\n",
    "system/numerics.yaml": IMPLICIT_CASE["system/numerics.yaml"].replace("spacing: 1 um", "spacing: 0.7 um"),
    "system/control.yaml": IMPLICIT_CASE["system/control.yaml"].replace("endStrain: 0.6", "endStrain: 2"),
    "system/observers.yaml": "form: {type: shape, every: 0.2 strain}\nbalance: {type: conservation, every: 0.2 strain}\n"
                             "blood: {type: suspension, every: 0.2 strain}\nmean: {type: profile, every: 1 strain, bins: 6}\n",
    "constant/contact.yaml": "law: {type: barrier, reach: 0.1 um, strength: 1e-5 N/m}\n",
    "constant/flow.yaml": "type: leesEdwards\nCa: 0.3\ninertia: {Re: 0.1}\n",
}


def onRanks(start, folder):
    """Ranks, case and record of a run on 1, 2 and 4 ranks, in which no step is taken back."""
    for ranks in (1, 2, 4):
        case = copied(start, folder / str(ranks))
        run(case, "dmpFlow", ranks=ranks)
        record = json.loads((case / "run.json").read_text())
        assert record["performance"]["rollbacks"] == 0 and record["performance"]["halvings"] == 0, record["performance"]
        yield ranks, case, record


def test_ranks(folder):
    """The same on 1, 2 and 4 ranks: shapes, stress, volumes; no particle crosses a membrane, and the fluid keeps its shear."""
    start = prepared(folder / "start", CASE)
    found = {}
    for ranks, case, record in onRanks(start, folder):
        rows = [*table(case, "form", "a.csv"), *table(case, "form", "b.csv")]
        stress = table(case, "blood", "suspension.csv")
        balance = table(case, "balance")
        assert max(abs(row["volumeChange"]) for row in balance) < 1e-7 and balance[-1]["changedSide"] == 0, balance[-1]
        # The work of the images gives the stress independently, and the budget closes with it.
        budget = table(case, "balance", "budget.csv")
        assert budget[-1]["residualShare"] < 2e-3, budget[-1]
        drift = record["observers"]["balance"]["momentumDriftShare"]
        assert drift < 1e-4, drift
        found[ranks] = rows, stress, budget
        first, end = (next(row for row in budget if row["strain"] > at) for at in (0.99, 1.99))
        power = (end["workOfImages_J"] - first["workOfImages_J"]) / (end["time_s"] - first["time_s"])
        byImages = power / (1e-3 * (end["strain"] / end["time_s"]) ** 2 * 11.2e-6 * 8.4e-6 ** 2)
        byCells = statistics.mean(row["relativeViscosity"] for row in stress if row["strain"] > 0.99)
        assert abs(byImages / byCells - 1) < 0.05, (byImages, byCells)
        steps = [row for row in stress if first["strain"] + 0.01 < row["strain"] < end["strain"] + 0.01]
        assert abs(statistics.mean(row["relativeViscosity_images"] for row in steps) / byImages - 1) < 1e-6, (steps, byImages)
        print(ranks, byImages, byCells, budget[-1]["residualShare"], drift)
        last = table(case, "mean", "profile.csv")[-6:]
        rate = stress[-1]["strain"] / stress[-1]["time_s"]
        for row in last:  # cells disturb the flow by less than this
            assert abs(row["u_m_s"] - rate * row["position_m"]) < 0.12 * rate * 8.4e-6, row
    for ranks in (2, 4):
        for one, other in zip(found[1][0], found[ranks][0], strict=True):
            assert abs(one["D12_inertia"] - other["D12_inertia"]) < 1e-4, (ranks, one, other)
        for one, other in zip(found[1][1], found[ranks][1], strict=True):
            assert abs(one["relativeViscosity"] - other["relativeViscosity"]) < 1e-3, (ranks, one, other)
        for one, other in zip(found[1][2], found[ranks][2], strict=True):
            assert abs(one["workOfImages_J"] - other["workOfImages_J"]) <= 1e-3 * abs(one["workOfImages_J"]), (ranks, one, other)
    drawn = [row["D12_inertia"] for row in found[1][0] if row["strain"] > 1.9]
    assert min(drawn) > 0.2, drawn


def test_viscous(folder):
    """The same with the options that have code of their own: a viscous inside, a gradient along y, sums in single precision; on 1, 2 and 4 ranks."""
    case = {
        **CASE,
        "system/mesh.yaml": "domain: {size: [11.2 um, 8.4 um, 8.4 um], periodic: [true, true, true]}\n"
                            f"cells: [{SPHERE.format('a', -1.4, 0.6, 0)}, {SPHERE.format('b', -5.2, 4.2, 0.4)}]\n",
        "system/numerics.yaml": CASE["system/numerics.yaml"].replace("precision: double", "precision: mixed"),
        "constant/flow.yaml": CASE["constant/flow.yaml"] + "gradient: y\n",
        "system/observers.yaml": CASE["system/observers.yaml"].replace("bins: 6", "bins: 6, axis: y"),
        "constant/membranes.yaml": CASE["constant/membranes.yaml"] + "  interior: {viscosityRatio: 5}\n",
        "system/control.yaml": CASE["system/control.yaml"].replace("endStrain: 2", "endStrain: 1"),
    }
    start = prepared(folder / "start", case)
    found = {}
    for ranks, one, _ in onRanks(start, folder):
        balance = table(one, "balance")
        assert max(abs(row["volumeChange"]) for row in balance) < 1e-6 and balance[-1]["changedSide"] == 0, balance[-1]
        found[ranks] = [*table(one, "form", "a.csv"), *table(one, "form", "b.csv")], table(one, "blood", "suspension.csv")
        last = table(one, "mean", "profile.csv")[-6:]
        rate = found[ranks][1][-1]["strain"] / found[ranks][1][-1]["time_s"]
        for row in last:
            assert abs(row["u_m_s"] - rate * row["position_m"]) < 0.12 * rate * 8.4e-6, row
        assert table(one, "balance", "budget.csv")[-1]["residualShare"] < 5e-3
        late = [row for row in found[ranks][1] if row["strain"] > 0.5]
        byImages, byCells = (statistics.mean(row[key] for row in late) for key in ("relativeViscosity_images", "relativeViscosity"))
        assert abs(byImages / byCells - 1) < 0.1, (byImages, byCells)
    for ranks in (2, 4):
        for one, other in zip(found[1][0], found[ranks][0], strict=True):
            assert abs(one["D12_inertia"] - other["D12_inertia"]) < 3e-4, (ranks, one, other)
        for one, other in zip(found[1][1], found[ranks][1], strict=True):
            assert abs(one["relativeViscosity"] - other["relativeViscosity"]) < 3e-3, (ranks, one, other)
    # With the gradient along z the flow is the same: shapes agree except for the effect of the lattice.
    upright = prepared(folder / "upright", {**case, **{name: CASE[name] for name in ("system/mesh.yaml", "constant/flow.yaml")}})
    run(upright, "dmpFlow", ranks=2)
    for one, other in zip(found[1][0], [*table(upright, "form", "a.csv"), *table(upright, "form", "b.csv")], strict=True):
        assert abs(one["D12_inertia"] - other["D12_inertia"]) < 3e-3, (one, other)


BEADS = {
    **CASE,
    "system/mesh.yaml": "domain: {size: [11.2 um, 8.4 um, 8.4 um], periodic: [true, true, true]}\n"
                        f"cells: [{SPHERE.format('a', -1.4, 0, 1.2).replace('2.4 um', '1.6 um')}]\n"
                        "bodies: [{name: free, shape: {type: sphere, radius: 1.4 um}, edge: 0.4 um, centre: [2.8 um, 0.2 um, 4.1 um]},\n"
                        "  {name: held, shape: {type: sphere, radius: 1.4 um}, edge: 0.4 um, centre: [-4.2 um, -2.8 um, -4.0 um]}]\n",
    "constant/bodies.yaml": "free: {density: 1000 kg/m^3, motion: free}\nheld: {motion: held}\n",
    "system/control.yaml": CASE["system/control.yaml"].replace("endStrain: 2", "endStrain: 1"),
    "system/observers.yaml": CASE["system/observers.yaml"] + "motion: {type: body, every: 0.2 strain}\n",
}


def test_bodies(folder):
    """A free and a held sphere on the sliding faces, beside a cell: the same on 1, 2 and 4 ranks, in one run and in two; the budget closes."""
    start = prepared(folder / "start", BEADS)
    found = {}
    for ranks, case, record in onRanks(start, folder):
        budget = table(case, "balance", "budget.csv")
        assert budget[-1]["residualShare"] < 5e-3 and budget[-1]["workOfImages_J"] > 0, budget[-1]
        # From the first steps, when the flow meets the held sphere; between walls it is twice as large.
        assert record["observers"]["balance"]["momentumDriftShare"] < 8e-3, record["observers"]["balance"]
        assert table(case, "balance")[-1]["changedSide"] == 0
        found[ranks] = table(case, "motion", "free.csv"), budget
        rate = budget[-1]["strain"] / budget[-1]["time_s"]
        first, last = found[ranks][0][0], found[ranks][0][-1]
        assert 0.3 < last["angularVelocity_y_1_s"] / rate < 0.7, last
        assert last["centre_x_m"] - first["centre_x_m"] > 0.5 * rate * last["time_s"] * 4.1e-6, (first, last)
        held = table(case, "motion", "held.csv")[-1]
        assert held["velocity_x_m_s"] == 0 and held["force_x_N"] < 0, held  # the flow at its place is in -x
    for ranks in (2, 4):
        for one, other in zip(found[1][0], found[ranks][0], strict=True):
            assert abs(one["centre_x_m"] - other["centre_x_m"]) < 1e-3 * 0.7e-6 and abs(one["velocity_x_m_s"] - other["velocity_x_m_s"]) < 1e-3 * 2.6e-3, (one, other)
        for one, other in zip(found[1][1], found[ranks][1], strict=True):
            assert abs(one["workOfImages_J"] - other["workOfImages_J"]) <= 1e-3 * abs(one["workOfImages_J"]), (one, other)
    parts = same_in_parts(folder / "2", start, "dmpFlow", 13, ranks=2)
    for observer, file in (("motion", "free.csv"), ("motion", "held.csv"), ("balance", "budget.csv")):
        assert series(folder / "2", observer, file) == series(parts, observer, file), observer


def test_restart(folder):
    """A run in two parts ends with the bits of a run in one, on 1 and 2 ranks; on another number it goes on from the same images."""
    case = {**CASE, "system/control.yaml": CASE["system/control.yaml"].replace("endStrain: 2", "endStrain: 1")}
    start = prepared(folder / "start", case)
    for ranks in (1, 2):
        whole = copied(start, folder / f"whole{ranks}")
        run(whole, "dmpFlow", ranks=ranks)
        parts = same_in_parts(whole, start, "dmpFlow", 13, ranks=ranks)
        for observer, file in (("form", "b.csv"), ("blood", "suspension.csv"), ("mean", "profile.csv"), ("balance", "budget.csv")):
            assert series(whole, observer, file) == series(parts, observer, file), observer
    other = copied(start, folder / "other")
    run(other, "dmpFlow", "-steps", "13", ranks=2)
    run(other, "dmpFlow", ranks=1)
    for one, two in zip(table(folder / "whole1", "blood", "suspension.csv"), table(other, "blood", "suspension.csv"), strict=True):
        assert abs(one["relativeViscosity"] - two["relativeViscosity"]) < 1e-3, (one, two)
    # At another shear rate images continue from where they are: the offset is that of the strain, whatever the rate.
    physical = prepared(folder / "physical", {**case, "constant/flow.yaml": "type: leesEdwards\nCa: 0.3\n", "constant/fluid.yaml": "density: 1000 kg/m^3\nviscosity: 1e-3 Pa s\n"})
    run(physical, "dmpFlow", "-set", "system/control.yaml:/endStrain=0.5")
    run(physical, "dmpFlow", "-set", "constant/flow.yaml:/Ca=0.15", ranks=2)
    said = subprocess.run(["h5dump", "-d", "data/imageOffset", "-y", "-w", "0", last_checkpoint(physical)], capture_output=True, text=True, check=True).stdout
    offset = float(said.split("DATA {")[1].split(",")[0])
    strain = table(physical, "blood", "suspension.csv")[-1]["strain"]
    turns = (8.4e-6 * strain - offset) / 11.2e-6
    assert abs(turns - round(turns)) < 1e-9 and abs(offset) <= 5.6e-6, (strain, offset)


def test_refused(folder):
    """Features that such a box does not support yet, and keys that do not apply to it."""
    def refused(words, code=2, **changes):
        said = run(make(folder / "refused", CASE, **changes), "membraneMesh", code=code).stderr
        assert words in said, f"{words} is not in\n{said}"

    flow = CASE["constant/flow.yaml"]
    refused("found velocityVerlet, which does not know periodic images that slide; write 'integrator: implicit'", **{
        "constant/contact.yaml": CASE["constant/contact.yaml"],
        "system/numerics.yaml": CASE["system/numerics.yaml"].replace("integrator: implicit", "integrator: velocityVerlet").replace("implicit: {step: 0.05, tolerance: 1e-5, error: 1}\n", "")})
    refused("axis z is not periodic and has no walls", **{"system/mesh.yaml": CASE["system/mesh.yaml"].replace("[true, true, true]", "[true, true, false]")})
    refused("walls", **{"constant/flow.yaml": flow + "walls: {normal: z}\n"})
    refused("gradient", **{"constant/flow.yaml": flow + "gradient: x\n"})
    refused("wallStress", **{"system/observers.yaml": "wall: {type: wallStress, every: 0.1 strain}\n"})
    refused("Did you mean 'leesEdwards'", **{"constant/flow.yaml": flow.replace("leesEdwards", "LeesEdwards")})


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as temporary:
        globals()["test_" + sys.argv[2]](pathlib.Path(temporary))
    print("passed")
