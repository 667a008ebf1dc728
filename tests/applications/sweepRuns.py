#!/usr/bin/env python3
"""caseSweep with the real programs: a study that is killed and stopped continues, and ends with the results of an undisturbed one.

    sweepRuns.py BIN SOURCE
"""
import csv
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time

BIN, SOURCE = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
STUDY = f"""
template: {SOURCE}/tutorials/rbcShear/Ca0.02
parameters:
  Ca: {{key: constant/flow.yaml:/Ca, values: [0.02, 0.2, 3]}}
  d: {{key: system/mesh.yaml:/cells/0/shape/d, values: [7 um, 8 um]}}
set:
  - system/numerics.yaml:/spacing=1.25 um
  - system/mesh.yaml:/cells/0/edge=1 um
  - system/control.yaml:/endStrain=1
  - "system/control.yaml:/checkpoint={{wallClock: 0.02 s, keep: 2}}"
results:
  D12: {{table: deformation/rbc, column: D12_extent}}
  D12_mean: {{table: deformation/rbc, column: D12_extent, statistic: mean, from: 0.5 strain}}
  half: {{table: deformation/rbc, column: D12_extent, statistic: {{type: crossing, level: 0.57}}}}
"""


def run(folder, *words, code=0):
    done = subprocess.run([str(BIN / "caseSweep"), *words], cwd=folder, capture_output=True, text=True)
    assert done.returncode == code, f"caseSweep {words}: code {done.returncode}\n{done.stdout}{done.stderr}"
    return done.stdout + done.stderr


def summary(folder):
    with open(folder / "cases/summary.csv") as text:
        return list(csv.DictReader(line for line in text if not line.startswith("#")))


def values(folder):
    return [{key: value for key, value in row.items() if key != "runTime_s"} for row in summary(folder)]


def interrupted(folder, how, after):
    """Starts the study and ends it by a signal, once this number of cases have ended and another one is in its solver."""
    process = subprocess.Popen([str(BIN / "caseSweep")], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    while process.poll() is None:
        done = {row["case"] for row in (summary(folder) if (folder / "cases/summary.csv").exists() else []) if row["status"] == "done"}
        if len(done) >= after and any(path.parent.parent.name not in done for path in folder.glob("cases/Ca*/checkpoints/*.h5")):
            process.send_signal(how)
            break
        time.sleep(0.01)
    said = process.communicate(timeout=60)[0]
    assert process.returncode != 0, f"the study ended before it was stopped:\n{said}"
    return process.returncode


def starts(folder):
    """How often each program was begun in each case, from the heads of its log."""
    counts = {}
    for log in sorted(folder.glob("cases/*/log.caseSweep")):
        for program in ("membraneMesh", "particleFill", "dmpFlow"):
            counts[log.parent.name, program] = sum(line.startswith(f"{program} ") for line in log.read_text().splitlines())
    return counts


def goesOn(folder):
    calm, troubled = folder / "calm", folder / "troubled"
    longer = STUDY.replace("endStrain=1", "endStrain=4")  # solvers run long enough that a fast machine does not finish them between two checks
    for study in (calm, troubled):
        study.mkdir()
        (study / "study.yaml").write_text(longer)
    said = run(calm)
    assert "Ca0.2-d8um" in said and "D12_mean" in said, said
    assert [row["status"] for row in summary(calm)] == 6 * ["done"]
    ended = values(calm)
    assert len({row["D12"] for row in ended}) == 6 and all(0.3 < float(row["D12"]) < 0.7 for row in ended), ended
    table = [line for line in open(calm / "cases/Ca3-d8um/postProcessing/deformation/rbc.csv") if not line.startswith("#")]
    last = list(csv.DictReader(table))[-1]  # with an independent reader
    assert abs(float(ended[5]["D12"]) - float(last["D12_extent"])) < 1e-10

    assert interrupted(troubled, signal.SIGKILL, 1) == -signal.SIGKILL
    before = {row["case"] for row in summary(troubled) if row["status"] == "done"}
    assert interrupted(troubled, signal.SIGTERM, 3) == 5
    assert "6 cases" not in run(troubled, "-list", "-quiet")
    run(troubled)
    assert [row["status"] for row in summary(troubled)] == 6 * ["done"]
    for one, other in zip(values(calm), values(troubled)):
        assert one == other, (one, other)  # the same bits
    counts = starts(troubled)
    assert all(counts[name, program] == 1 for name in before for program in ("membraneMesh", "particleFill", "dmpFlow")), counts
    assert sum(counts.values()) > 18, counts  # something was interrupted
    again = run(troubled)
    assert "done before" in again and starts(troubled) == counts, again

    page = (calm / "cases/report.html").read_text()
    assert page.count("<svg") == 6 and "Ca0.02-d7um" in page and "src=" not in page, page.count("<svg")
    # Results are read again without a run; a missing column is reported.
    (calm / "study.yaml").write_text(longer.replace("{table: deformation/rbc, column: D12_extent}", "{table: deformation/rbc, column: D12_extend}"))
    assert "Did you mean 'D12_extent'?" in run(calm, "-collect")
    assert starts(calm) == {key: 1 for key in starts(calm)}


def refuses(folder):
    study = folder / "refused"
    study.mkdir()
    wrong = STUDY.replace("values: [7 um, 8 um]", "values: [7 Pa, 8 um]").replace("/endStrain=1", "/endStrian=1")
    (study / "study.yaml").write_text(wrong)
    said = run(study, code=2)
    assert "Did you mean 'endStrain'?" in said and "case Ca0.02-d7Pa: system/mesh.yaml:" in said, said
    assert not (study / "cases").exists()
    (study / "study.yaml").write_text(STUDY.replace("flow.yaml", "flaw.yaml"))
    assert "Did you mean 'constant/flow.yaml'?" in run(study, code=2)
    (study / "study.yaml").write_text(STUDY.replace("template:", "templat:"))
    assert "study.yaml:2:1: templat: " in run(study, code=2)
    for right, misspelt, message in (("column: D12_extent}", "column: D12_extend}", "results.D12.column: found 'D12_extend'; the columns of deformation/rbc"),
                                     ("{table: deformation/rbc,", "{table: deformatoin/rbc,", "Did you mean 'deformation'?"),
                                     ("{table: deformation/rbc,", "{table: deformation/rcb,", "Did you mean 'rbc'?"),
                                     ("{table: deformation/rbc,", "{table: deformation,", "write OBSERVER/FILE")):
        (study / "study.yaml").write_text(STUDY.replace(right, misspelt, 1))
        said = run(study, code=2)  # before anything runs
        assert message in said and "study.yaml:1" in said and not (study / "cases").exists(), said
    (study / "study.yaml").write_text(STUDY)
    assert "there is no case 'Ca9'" in run(study, "-only", "Ca9", code=1)
    assert "one of -keep, -update and -fresh" in run(study, "-keep", "-fresh", code=1)
    assert "there is no such file" in run(study, "other.yaml", code=2)
    listed = json.loads(run(study, "-list", "-json", "-quiet"))
    assert [one["case"] for one in listed][:2] == ["Ca0.02-d7um", "Ca0.02-d8um"] and listed[0]["values"] == {"Ca": 0.02, "d": "7 um"}, listed
    # A single case, as a job of an array; a failure in one case.
    run(study, "-only", "3", "-quiet")
    assert sorted(path.name for path in study.glob("cases/Ca*")) == ["Ca0.2-d7um"]
    (study / "study.yaml").write_text(STUDY.replace("values: [7 um, 8 um]", "values: [7 um, 100 um]"))
    said = run(study, "-json", code=3)  # one line for each event, which -json sends to standard error
    told = re.findall(r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ \[\d/6\] (\S+): (\w+ starts|done|failed)", said, re.M)
    assert ("Ca3-d7um", "dmpFlow starts") in told and ("Ca3-d7um", "done") in told and ("Ca3-d100um", "failed") in told, said
    cases = json.loads(said[:said.index("\n}\n") + 3])["cases"]
    assert cases[0]["values"] == {"Ca": 0.02, "d": "7 um"} and cases[0]["results"]["D12"] > 0.3, cases
    assert "3 of 6 cases failed" in said and "ended with code 2" in said, said
    assert [row["status"] for row in summary(study)] == 3 * ["done", "failed"], summary(study)
    assert "Cases that failed" in (study / "cases/report.html").read_text()


def changes(folder):
    """A longer run continues from its checkpoint; after any other change a case is made anew, with the result of a new one; ranks stop with a checkpoint."""
    study, new = folder / "changes", folder / "new"
    for one in (study, new):
        one.mkdir()
    single = STUDY.replace("[0.02, 0.2, 3]", "[0.2]").replace("[7 um, 8 um]", "[8 um]")
    (study / "study.yaml").write_text(single)
    run(study)
    short = summary(study)[0]
    (study / "study.yaml").write_text(single.replace("endStrain=1", "endStrain=1.4"))
    assert "-update goes on" in run(study, code=2)
    run(study, "-update")
    log = (study / "cases/Ca0.2-d8um/log.caseSweep").read_text()
    assert log.count("\nmembraneMesh ") + log.startswith("membraneMesh ") == 1 and summary(study)[0]["D12"] != short["D12"]
    harder = single.replace("endStrain=1", "endStrain=1.4").replace("set:\n", "set:\n  - constant/membranes.yaml:/rbc/bending/Eb=1\n")
    (study / "study.yaml").write_text(harder)
    (new / "study.yaml").write_text(harder)
    assert "Eb is 0.01 and would be 1" in run(study, "-update", code=2)
    assert "only reads" in run(study, "-collect", "-fresh", code=1)
    old = summary(study)[0]
    run(study, "-fresh")
    run(new)
    assert summary(study)[0]["D12"] == summary(new)[0]["D12"] != old["D12"], (summary(study), summary(new), old)
    subprocess.run([str(BIN / "cleanCase"), "-quiet", "-case", str(study / "cases/Ca0.2-d8um")], check=True)
    run(study)
    assert summary(study)[0]["D12"] == summary(new)[0]["D12"]
    (study / "other.yaml").write_text(harder)
    assert "is of the study study.yaml" in run(study, "other.yaml", code=2)
    (study / "study.yaml").write_text(harder.replace("results:", "programs: [membraneMesh, partikelFill]\nresults:"))
    assert "Did you mean 'particleFill'?" in run(study, code=2)

    ranks = folder / "ranks"
    ranks.mkdir()
    (ranks / "study.yaml").write_text(single.replace("endStrain=1", "endStrain=60"))
    process = subprocess.Popen([str(BIN / "caseSweep"), "-ranks", "2"], cwd=ranks, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    while not list(ranks.glob("cases/*/checkpoints/*.h5")):
        assert process.poll() is None, process.communicate()[0]
        time.sleep(0.05)
    start = time.time()
    process.send_signal(signal.SIGTERM)
    said = process.communicate(timeout=60)[0]
    assert process.returncode == 5 and time.time() - start < 20, (process.returncode, time.time() - start, said)
    record = json.loads((ranks / "cases/Ca0.2-d8um/run.json").read_text())
    assert record["status"] == "stopped" and "signal SIGTERM" in record["reason"], record["reason"]


def scripts(folder):
    """The files for SLURM and Snakemake run the cases in a shell; without a cluster, by setting the cluster's variable."""
    study = folder / "scripts"
    study.mkdir()
    (study / "study.yaml").write_text(STUDY)
    run(study, "-slurm", "-snakemake")
    assert "'Ca0.2-d8um'" in (study / "study.slurm").read_text()  # by name: the list may grow
    environment = dict(os.environ, PATH=f"{BIN}:{os.environ['PATH']}", SLURM_ARRAY_TASK_ID="4", SLURM_SUBMIT_DIR=str(study))
    subprocess.run(["bash", "study.slurm"], cwd=study, env=environment, check=True, capture_output=True)
    assert [path.name for path in sorted(study.glob("cases/Ca*"))] == ["Ca0.2-d8um"]
    assert "#SBATCH --array=1-6" in (study / "study.slurm").read_text()


def main():
    with tempfile.TemporaryDirectory() as folder:
        for check in (goesOn, refuses, changes, scripts):
            check(pathlib.Path(folder))
            print(check.__name__, "passed")


main()
