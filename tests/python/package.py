#!/usr/bin/env python3
"""The Python package against independent methods: CSV files read directly, volumes from the observer, series in closed form.

    package.py BIN SOURCE
"""
import csv
import json
import math
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

BIN, SOURCE = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
os.environ["CORPUSCLE_BIN"] = str(BIN)
sys.path.insert(0, str(SOURCE / "python"))

import numpy  # noqa: E402
import pandas  # noqa: E402

import corpuscle  # noqa: E402

COARSE = {"system/numerics.yaml:/spacing": "1.25 um", "system/mesh.yaml:/cells/0/edge": "1.2 um", "system/control.yaml:/endStrain": 0.4,
          "system/control.yaml:/write/strain": 0.2, "system/observers.yaml:/balance/every": "0.2 strain"}


def raises(kind, message, call):
    try:
        call()
    except kind as error:
        assert message in str(error), f"'{message}' is not in '{error}'"
        return
    raise AssertionError(f"no {kind.__name__}: {message}")


def analysis(folder):
    x = numpy.arange(0, 40, 0.05)
    wave = pandas.DataFrame({"strain": x, "time_s": 0.01 * x, "y": 0.4 + 0.1 * numpy.sin(2 * math.pi * x / 7.3), "turn": -0.5 * x})
    value, error = corpuscle.period(wave, "y")
    assert abs(value - 7.3) < 0.01 and error < 0.01, (value, error)
    assert abs(corpuscle.period(wave, "y", along="time_s")[0] - 0.073) < 1e-4
    assert math.isnan(corpuscle.period(wave[wave.strain < 8], "y")[0])
    assert abs(corpuscle.crossing(wave, "y", 0.45) - 7.3 / 12) < 1e-3 and math.isnan(corpuscle.crossing(wave, "y", 0.6))
    assert abs(corpuscle.tankTreadingFrequency(wave, column="turn") - 50 / (2 * math.pi)) < 1e-9
    noise = numpy.random.default_rng(3).normal(size=4000)
    mean = corpuscle.mean(pandas.DataFrame({"time_s": numpy.arange(4000.0), "y": noise}), "y", since=0)
    assert abs(mean.value) < 4 * mean.error and abs(mean.error * math.sqrt(4000) - 1) < 0.15 and mean.isReliable, mean
    # The same numbers as averageTable, for correlated values, in a long and in a short series.
    slow = numpy.convolve(noise, numpy.exp(-numpy.arange(200) / 10), "valid")
    for count, isReliable in ((3001, True), (60, False)):
        table = folder / "postProcessing/slow/y.csv"
        table.parent.mkdir(parents=True, exist_ok=True)
        table.write_text("time_s,y\n" + "".join(f"{k},{slow[k]:.17g}\n" for k in range(count)))
        done = subprocess.run([BIN / "averageTable", "slow/y", "-case", folder, "-json"], capture_output=True, text=True, check=True)
        theirs, ours = json.loads(done.stdout)["averages"][0], corpuscle.mean(corpuscle.readTable(table), "y")
        assert abs(ours.value - theirs["mean"]) < 1e-12 and abs(ours.error - theirs["standardError"]) < 1e-12, (ours, theirs)
        assert ours.isReliable == theirs["isReliable"] == isReliable, (ours, theirs)
    uneven = pandas.DataFrame({"time_s": [0.0, 1, 2, 2.5, 3, 4], "y": 1.0})
    raises(ValueError, "not evenly spaced", lambda: corpuscle.mean(uneven, "y", since=0))
    raises(KeyError, "there is no column 'z'", lambda: corpuscle.period(wave, "z"))
    assert numpy.allclose(numpy.diff(corpuscle.unwrapped([1.5, -1.5, -1.2])), [math.pi - 3, 0.3])
    cells = pandas.concat([wave.assign(cell=1), wave.assign(cell=2)])
    raises(ValueError, "several cells", lambda: corpuscle.period(cells, "y"))


def case(folder):
    original = corpuscle.Case(SOURCE / "tutorials/rbcShear/Ca0.02")
    one = original.clone(folder / "one", COARSE)
    assert one["constant/flow.yaml:/Ca"] == 0.02 and one["system/mesh.yaml:/domain/size"] == ["20 um", "20 um", "20 um"]
    one["constant/flow.yaml:/Ca"] = 0.5
    one.set({"system/mesh.yaml:/cells/0/axis": [0, 0, 1.0], "system/mesh.yaml:/domain/periodic": [True, True, False]})
    assert "edge: 1.2 um" in (one.folder / "system/mesh.yaml").read_text()
    raises(corpuscle.CorpuscleError, "Did you mean 'Ca'?", lambda: one.set({"constant/flow.yaml:/Cb": 1}))
    raises(FileNotFoundError, "is not a case", lambda: corpuscle.Case(folder))
    raises(corpuscle.CorpuscleError, "Did you mean 'Ca'?", lambda: one.clone(folder / "wrong", {"constant/flow.yaml:/Cb": 1}))
    assert not (folder / "wrong").exists()
    raises(ValueError, "del case[key]", lambda: one.set({"constant/flow.yaml:/Ca": None}))
    one["system/mesh.yaml:/cells/0/centre"] = ["0 um", "0 um", "0 um"]
    one.set({"system/mesh.yaml:/cells/0/axis": numpy.array([0, 0, 1])})
    assert corpuscle.case._yaml(["a, b", "8 um", 1.5, True]) == '["a, b", 8 um, 1.5, true]'
    assert "constant/flow.yaml:/Ca" in one and "constant/flow.yaml:/shearRate" not in one and one.get("constant/flow.yaml:/shearRate", 3) == 3
    assert len(one.times) == 0
    assert one.programs == ["membraneMesh", "particleFill", "dmpFlow"]
    assert one.run() is True and one.run() is True  # at the second call the run is already finished
    assert one.record["status"] == "done" and one.record["parameters"]["particles"] > 1000, one.record["parameters"]

    shape = one.table("deformation/rbc")
    with open(one.folder / "postProcessing/deformation/rbc.csv") as text:
        rows = list(csv.DictReader(line for line in text if not line.startswith("#")))
    assert len(shape) == len(rows) and float(rows[-1]["D12_extent"]) == shape.D12_extent.iloc[-1]  # to the last bit
    assert shape.attrs["units"]["time_s"] == "s" and "L - H" in shape.attrs["meanings"]["D12_extent"], shape.attrs
    assert "deformation/rbc" in one.tables
    raises(FileNotFoundError, "deformation/rbc", lambda: one.table("deformation/red"))

    assert numpy.allclose(one.times.strain, [0, 0.2, 0.4]) and one.streams[0] == "fluid"
    balance = one.table("balance/rbc")
    for strain in (0, 0.2, 0.4):
        cell = one.surface("rbc", strain=strain)
        row = balance.iloc[(balance.strain - strain).abs().argmin()]
        assert abs(cell.strain - strain) < 1e-9 and abs(row.strain - strain) < 1e-9
        assert abs(cell.volume / row.volume_m3 - 1) < 1e-6 and abs(cell.area / row.area_m2 - 1) < 1e-6, (cell.volume, row)
    assert {"force", "stretch"} <= set(cell.pointData) and len(cell.cellData["areaStrain"]) == len(cell.triangles)
    fluid = one.particles()
    assert len(fluid.points) == len(fluid.pointData["velocity"]) and fluid.triangles.shape == (0, 3)
    gradient = numpy.polyfit(fluid.points[:, 2], fluid.pointData["velocity"][:, 0], 1)[0]
    assert abs(gradient / one.record["parameters"]["shearRate_1_s"] - 1) < 0.1, gradient
    assert one.surface("rbc", time=0).time == 0
    raises(ValueError, "reach from strain 0 to 0.4", lambda: one.surface("rbc", strain=50))
    raises(ValueError, "these results reach", lambda: one.particles(time=1.0))
    assert one.used["system/control.yaml"]["endStrain"] == 0.4, one.used.keys()
    assert one.run(only="dmpFlow")
    raises(FileNotFoundError, "there are no results of 'red'", lambda: one.surface("red"))
    try:
        import meshio
    except ImportError:
        print("meshio is not installed: its part is left out")
    else:
        cell.meshio().write(folder / "cell.vtu")
        back = meshio.read(folder / "cell.vtu")
        assert numpy.allclose(back.points, cell.points) and (back.cells_dict["triangle"] == cell.triangles).all()

    del one["system/control.yaml:/stop"]
    one["system/control.yaml:/endStrain"] = 0.6
    assert one.run() and len(one.table("deformation/rbc")) > len(shape)  # the run has continued; curves are joined
    assert one.table("deformation/rbc").iloc[:len(shape)].equals(shape)
    one.clean(mesh=True)
    assert one.tables == [] and one.record == {}

    # After an interrupt the solver writes a checkpoint, on several ranks too.
    one["system/control.yaml:/endStrain"] = 50
    for ranks in (1, 2):
        script = f"import sys; sys.path.insert(0, {str(SOURCE / 'python')!r}); import corpuscle; corpuscle.Case({str(one.folder)!r}).run(ranks={ranks})"
        process = subprocess.Popen([sys.executable, "-c", script], stderr=subprocess.PIPE, text=True)
        while len(list((one.folder / "postProcessing").glob("deformation/rbc.csv"))) == 0 or one.record.get("status") != "running":
            assert process.poll() is None, process.communicate()
            time.sleep(0.05)
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        assert "KeyboardInterrupt" in process.communicate(timeout=60)[1]
        assert one.record["status"] == "stopped" and list((one.folder / "checkpoints").glob("*.h5")), one.record
        one.clean(mesh=True)


def study(folder):
    (folder / "study.yaml").write_text(f"""
template: {SOURCE}/tutorials/rbcShear/Ca0.02
parameters:
  Ca: {{key: constant/flow.yaml:/Ca, values: [0.02, 3]}}
set: [{', '.join(f'{key}={value}' for key, value in COARSE.items())}]
results:
  D12: {{table: deformation/rbc, column: D12_extent}}
""")
    one = corpuscle.Study(folder)
    assert [row["case"] for row in one.list()] == ["Ca0.02", "Ca3"]
    assert one.run()
    assert one.cases == ["Ca0.02", "Ca3"] == list(one)
    raises(KeyError, "there are Ca0.02, Ca3", lambda: one["Ca4"])
    raises(corpuscle.CorpuscleError, "differ", lambda: [(folder / "study.yaml").write_text((folder / "study.yaml").read_text().replace("1.2 um", "1 um")), one.run()])
    assert one.run(differing="fresh")
    summary = one.summary
    assert list(summary.Ca) == [0.02, 3] and (summary.status == "done").all()
    assert summary.D12.iloc[1] == one["Ca3"].table("deformation/rbc").D12_extent.iloc[-1].round(15) or \
        abs(summary.D12.iloc[1] - one["Ca3"].table("deformation/rbc").D12_extent.iloc[-1]) < 1e-11
    assert "D12_extent of deformation/rbc" in summary.attrs["meanings"]["D12"]


for check in (analysis, case, study):
    with tempfile.TemporaryDirectory() as temporary:
        check(pathlib.Path(temporary))
    print(check.__name__, "passed")
