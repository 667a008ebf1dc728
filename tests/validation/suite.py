"""Shared by the cases of validation: runs, figures, curves, records, tables and plots.

A case is a folder with case.py, README.md (the page) and references. case.py has
    TITLE, ACROSS        a line for tables; the meaning of a resolution ("particles across the gap")
    RESOLUTIONS          coarse to fine; ./Alltest runs the first
    runs(n)              list of Run: the runs at resolution n
    figures(done, n)     list of Figure, from the folders of these runs, by their names
    curves(done)         Plot of the finest resolution that has been run, or a list: plot.png, plot2.png, ...; done as for figures
    UNBOUNDED            True where the reference has no box, so that the case may be run in another one (validate -domain)
    MISSED               optional: by resolution, figures that are outside their tolerance according to the page, by name (* stands for any words),
                         with the largest error that each may have
"""
import csv
import hashlib
import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass, field, replace
from fnmatch import fnmatchcase

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
TUTORIALS = ROOT / "tutorials"
sys.path.insert(0, str(TUTORIALS))
MARKS = ("<!-- results: written by the script -->", "<!-- end of results -->")
PROGRAMS = ("membraneMesh", "particleFill", "dmpFlow")  # of a case with cells or bodies
SIZE = "system/mesh.yaml:/domain/size="
NO_LIMIT = ("-set", "system/control.yaml:/stop/wallClock=never")  # tutorials have a limit
ENVIRONMENT = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1",
               "OMPI_MCA_hwloc_base_binding_policy": "none"}  # else two simultaneous runs would be bound to the same core


@dataclass
class Run:
    """A case: copied from `source` (a folder with system and constant), changed by `settings` (FILE:/path=value), run by `programs`."""
    name: str
    source: pathlib.Path
    settings: list
    programs: tuple  # the last one is the solver, run on several ranks; others may be functions of the folder, whose files are their `reads`


@dataclass
class Figure:
    """One comparison: |error| must be within `allowed`, both in `unit`. Value and reference are shown where there is one of each."""
    name: str
    error: float
    allowed: float
    unit: str = "%"
    value: float | None = None
    reference: float | None = None
    order: bool = False  # an error that should decrease with the resolution: its observed order is shown
    earlier: bool = False  # against an earlier run of the same case: not meaningful in another box

    def holds(self):
        return abs(self.error) <= self.allowed  # false for nan


def relative(name, value, reference, allowed, **more):
    """Figure of a value in per cent of its reference."""
    return Figure(name, 100 * (value / reference - 1), allowed, "%", value, reference, **more)


def outside(value, low, high, percent=True):
    """By how much a value is beyond the nearest bound, in per cent of the bound or absolute; 0 inside; nan if one of the three is."""
    if any(map(math.isnan, (value, low, high))):
        return math.nan
    if low <= value <= high:
        return 0
    edge = high if value > high else low
    return 100 * (value / edge - 1) if percent else value - edge


def worst(values, key=abs):
    """The value with the largest key; nan if there are no values, or if any of them is not finite."""
    values = list(values)
    return max(values, key=key) if values and all(map(math.isfinite, values)) else math.nan


@dataclass
class Plot:
    xlabel: str
    ylabel: str
    ours: list  # (title, xs, ys), drawn as points
    theirs: list  # the same, drawn as lines
    extra: list = field(default_factory=list)  # commands of gnuplot


def rows(path):
    """Rows of a table with a header; lines that begin with # are skipped."""
    with open(path) as text:
        lines = (line for line in text if not line.startswith("#"))
        return [{key: float(value) if value else math.nan for key, value in row.items()} for row in csv.DictReader(lines)]


def published(path, **where):
    """Curves by their source, from a table with a column `source`: rows of its other columns, those whose columns have the values of `where`."""
    found = {}
    with open(path) as text:
        for row in csv.DictReader(line for line in text if not line.startswith("#")):
            source, row = row.pop("source"), {key: float(value) for key, value in row.items() if key != "source"}
            if all(row[key] == value for key, value in where.items()):
                found.setdefault(source, []).append(row)
    return found


def permitted(table, n, order):
    """Tolerance from `table` at a resolution; if it has none, extrapolated from its coarsest with this order."""
    coarsest = min(table)
    return table.get(n, table[coarsest] * (coarsest / n) ** order)


def fromOn(table, n):
    """Entry of a table by resolution: that of the largest resolution not above n; below all of them, that of the coarsest."""
    return table[max((k for k in table if k <= n), default=min(table))]


def at(table, x, value, key="strain"):
    """Column `value`, or the function `value` of a row, interpolated between the rows around key = x; nan outside."""
    of = value if callable(value) else lambda row: row[value]
    for a, b in zip(table, table[1:]):
        if a[key] - 1e-9 <= x <= b[key] + 1e-9:
            return of(a) + (x - a[key]) / (b[key] - a[key]) * (of(b) - of(a))
    return math.nan


def module(path, name):
    """A Python file by its path: the compare.py of a tutorial."""
    import importlib.util

    spec = importlib.util.spec_from_file_location(name, path)
    loaded = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(loaded)
    return loaded


def names():
    return sorted(path.parent.name for path in HERE.glob("*/case.py"))


def load(name):
    return module(HERE / name / "case.py", name)


def sets(settings):
    """The command-line words that pass these settings to a program."""
    return [word for setting in settings for word in ("-set", setting)]


def contents(run):
    """Checksum of the files of which a run is made: system and constant of its source, and meshes that its programs read."""
    files = {str(path.relative_to(run.source)): path for part in ("system", "constant") for path in (run.source / part).rglob("*") if path.is_file()}
    files |= {path.name: path for program in run.programs for path in getattr(program, "reads", ())}
    lines = (f"{name} {hashlib.sha256(path.read_bytes()).hexdigest()}\n" for name, path in sorted(files.items()))
    return hashlib.sha256("".join(lines).encode()).hexdigest()[:16]


def same(note, wanted):
    """Whether a folder's settings.json belongs to this run; older ones do not record the contents of files."""
    found = json.loads(note.read_text()) if note.exists() else []
    return found in (wanted, wanted[:3])


def execute(run, folder, binaries, ranks):
    """Makes a run unless it has ended; a stopped run is continued. With other settings or files it starts anew. Returns run.json, with the core-seconds
    of all parts."""
    wanted = [run.settings, [getattr(program, "__name__", program) for program in run.programs],
              os.path.relpath(run.source, ROOT), contents(run)]  # in any clone
    note, record = folder / "settings.json", folder / "run.json"
    if folder.exists() and not same(note, wanted):
        shutil.rmtree(folder)
    options = ["-quiet", "-case", str(folder), *sets(run.settings)]
    if not note.exists():
        for part in ("system", "constant"):
            shutil.copytree(run.source / part, folder / part, dirs_exist_ok=True)
        for program in run.programs[:-1]:
            if callable(program):
                program(folder)
            else:
                subprocess.run([binaries / program, *options], check=True, stdout=subprocess.DEVNULL)
        note.write_text(json.dumps(wanted))
    parts = folder / "parts.json"  # core-seconds of the parts of a run that was stopped; a killed part leaves none
    earlier = json.loads(parts.read_text()) if parts.exists() else []
    if record.exists() and (last := json.loads(record.read_text()))["status"] != "done":
        earlier.append(last.get("performance", {}).get("processorSeconds", 0))
        parts.write_text(json.dumps(earlier))
        record.unlink()
    if not record.exists():
        subprocess.run(["mpirun", "-np", str(ranks), binaries / run.programs[-1], *options, *NO_LIMIT], check=True, env=ENVIRONMENT)
    found = json.loads(record.read_text())
    found["performance"]["processorSeconds"] += sum(earlier)
    return found


def inDomain(run, size):
    """The same run in a box of another size, written as in system/mesh.yaml."""
    return replace(run, settings=[SIZE + size if setting.startswith(SIZE) else setting for setting in run.settings])


def folder(name, n, work, domain=None):
    return work / name / (str(n) if domain is None else f"{n}-{'x'.join(re.findall(r'[0-9.]+', domain))}")


def planned(name, n, work, domain=None):
    """The runs of a case at a resolution, each with its folder."""
    return [(run if domain is None else inDomain(run, domain), folder(name, n, work, domain) / run.name) for run in load(name).runs(n)]


def executeTogether(runs, binaries, jobs):
    """Planned runs, from coarse to fine, `jobs` at a time on one rank each, which avoids the waiting time between ranks. The last run, the most
    expensive in most cases, is made when the others have ended, on as many ranks. All runs before it are tried, even if some fail."""
    with ThreadPoolExecutor(jobs) as pool:
        for future in [pool.submit(execute, run, place, binaries, 1) for run, place in runs[:-1]]:
            future.exception()
    for run, place in runs:  # has ended, or fails here with its message
        execute(run, place, binaries, jobs)


def validate(name, n, binaries, ranks, work, domain=None):
    """Runs a case at a resolution. Returns its record, from the results of its runs, made now or earlier, and the folders of its runs."""
    case, done, records = load(name), {}, []
    for run, place in planned(name, n, work, domain):
        done[run.name] = place
        records.append(execute(run, place, binaries, ranks))
    seconds = sum(record["performance"]["processorSeconds"] for record in records)
    machines, days, programs = zip(*map(origin, records))
    return {"resolution": n, "particles": max(record["parameters"]["particles"] for record in records), "coreSeconds": round(seconds, 1),
            "ranks": max(record["ranks"] for record in records), "machine": "; ".join(dict.fromkeys(machines)), "date": max(days),
            "programs": ", ".join(dict.fromkeys(programs)), "figures": [asdict(figure) for figure in case.figures(done, n) if domain is None or not figure.earlier]}, done


def origin(record):
    """Machine (as described by machine()), day, and commit of the programs from a run.json."""
    where = record["machine"]
    family = " ".join(re.sub(r"\([A-Za-z]*\)", "", where["processor"]).split()[:2])
    vectors = {"avx512": "AVX-512", "avx2": "AVX2"}.get(record["performance"]["instructionSet"], "baseline")
    return f"{where['cores']} cores, {family}, {vectors}", record["end"][:10], record["build"]["git"]


def machine():
    command = f'. "{ROOT}/etc/functions.sh"; machine'
    return subprocess.run(["bash", "-c", f"root={ROOT}; {command}"], check=True, capture_output=True, text=True).stdout.strip()


def holds(figure):
    return Figure(**figure).holds()


def missed(case, n, figure):
    """Whether the case's page states that this figure is outside its tolerance at n, and the error is not larger than stated; false for an error of nan."""
    return any(abs(figure["error"]) <= most for words, most in getattr(case, "MISSED", {}).get(n, {}).items() if fnmatchcase(figure["name"], words))


def shown(value, digits=4):
    return "" if value is None else f"{value:.{digits}g}"


def error(figure):
    unit = figure["unit"]
    space = "" if unit in ("", "degrees") else " "
    return f"{figure['error']:+.2g}{space}{'' if unit == 'degrees' else unit}{' deg' if unit == 'degrees' else ''}"


def report(case, record):
    """Prints a record. Returns whether all figures are within their tolerance, except those that the page states as outside."""
    good = True
    for figure in record["figures"]:
        pair = f"{shown(figure['value'])} against {shown(figure['reference'])}" if figure["reference"] is not None else ""
        known = missed(case, record["resolution"], figure)
        word = "within" if holds(figure) else "missed, as its page says:" if known else "OUTSIDE"
        good = good and (known or holds(figure))
        print(f"  {figure['name']:58s} {pair:26s} {error(figure):>12s}  {word} {figure['allowed']:.3g} {figure['unit']}")
    print(f"  {record['particles']:.0f} particles, {record['coreSeconds']:g} core-seconds")
    return good


def orders(records):
    """For figures with an order of convergence, by name: the list of observed orders between neighbouring resolutions."""
    found = {}
    for one, two in zip(records, records[1:]):
        finer = {figure["name"]: figure for figure in two["figures"]}
        for figure in one["figures"]:
            other = finer.get(figure["name"])
            if figure["order"] and other and other["error"]:
                ratio = two["resolution"] / one["resolution"]
                found.setdefault(figure["name"], []).append(math.log(abs(figure["error"] / other["error"])) / math.log(ratio))
    return found


def recorded(name):
    path = HERE / name / "results.json"
    return json.loads(path.read_text()) if path.exists() else []


def table(case, records):
    """Errors of every figure over the resolutions, with order and cost."""
    head = [f"{case.ACROSS}", *(str(r["resolution"]) for r in records)]
    lines = ["| " + " | ".join([*head, "order", "allowed at the finest"]) + " |", "|" + "---|" * (len(head) + 2)]
    observed = orders(records)
    names_ = list(dict.fromkeys(figure["name"] for record in records for figure in record["figures"]))
    for name in names_:
        cells, last = [], None
        for record in records:
            here = [figure for figure in record["figures"] if figure["name"] == name]
            cells.append(error(here[0]) + ("" if holds(here[0]) else " **outside**") if here else "")
            last = here[0] if here else last
        order = ", ".join(f"{value:.1f}" for value in observed.get(name, []))
        reference = f" ({shown(last['reference'])})" if last["reference"] is not None else ""
        lines.append("| " + " | ".join([name + reference, *cells, order, f"{last['allowed']:.3g} {last['unit']}"]) + " |")
    lines.append("| " + " | ".join(["particles", *(f"{r['particles']:.0f}" for r in records), "", ""]) + " |")
    lines.append("| " + " | ".join(["core-seconds", *(f"{r['coreSeconds']:g}" for r in records), "", ""]) + " |")
    return "\n".join(lines)


def keep(name, record, plot):
    """Puts a record into the case's results.json, its page and its plot, and writes RESULTS.md anew."""
    records = [other for other in recorded(name) if other["resolution"] != record["resolution"]] + [record]
    records.sort(key=lambda other: other["resolution"])
    (HERE / name / "results.json").write_text(json.dumps(records, indent=1) + "\n")
    if record is records[-1]:
        for k, one in enumerate(plot if isinstance(plot, list) else [plot], 1):
            draw(one, HERE / name / f"plot{k if k > 1 else ''}.png")
    page = HERE / name / "README.md"
    before, rest = page.read_text().split(MARKS[0])
    after = rest.split(MARKS[1])[1]
    def ran(r):
        of = f", programs of {r['programs']}" if "programs" in r else ""
        return f"{r['machine']}, {r['ranks']} rank{'s' if r['ranks'] > 1 else ''}, {r['date']}{of}"

    runs = "; ".join(sorted(set(map(ran, records))))
    page.write_text(f"{before}{MARKS[0]}\n\n{table(load(name), records)}\n\n`validate {name} -resolution n`; {runs}.\n\n{MARKS[1]}{after}")
    results()


def results():
    lines = ["# Validation: what has been run", "",
             "Each case has a page in its folder. Errors at the finest resolution run; written by `validate CASE -record`.", "",
             "| case | resolution | figure | error | allowed | core-seconds | date, machine, programs |", "|---|---|---|---|---|---|---|"]
    for name in names():
        records, case = recorded(name), load(name)
        if not records:
            continue
        last = records[-1]
        for k, figure in enumerate(last["figures"]):
            first = [f"[{case.TITLE}]({name}/README.md)", f"{last['resolution']} {case.ACROSS}"] if k == 0 else ["", ""]
            end = [f"{last['coreSeconds']:g}", ", ".join(last[key] for key in ("date", "machine", "programs") if key in last)] if k == 0 else ["", ""]
            word = "" if holds(figure) else " **outside**"
            lines.append("| " + " | ".join([*first, figure["name"], error(figure) + word, f"{figure['allowed']:.3g} {figure['unit']}", *end]) + " |")
    (HERE / "RESULTS.md").write_text("\n".join(lines) + "\n")


def draw(plot, path):
    """Draws a plot with gnuplot: our results as points, references as lines."""
    blocks, parts = [], []
    for k, (title, xs, ys, style) in enumerate([(*c, "lines lw 2") for c in plot.theirs] + [(*c, "points pt 7 ps 0.6") for c in plot.ours]):
        blocks.append(f"$d{k} << E\n" + "\n".join(f"{x:.8g} {y:.8g}" for x, y in zip(xs, ys)) + "\nE")
        number = (k if k < len(plot.theirs) else k - len(plot.theirs)) + 1
        colour = "rgb '#aaaaaa'" if k < len(plot.theirs) != len(plot.ours) else number  # several references to a curve: all in grey
        if colour != number and title:  # told apart by dashes
            style += f" dt {1 + sum(bool(before) for before, _, _ in plot.theirs[:k])}"
        parts.append(f"$d{k} with {style} lc {colour} " + (f"title '{title}'" if title else "notitle"))
    script = "\n".join(["set terminal pngcairo size 900,600 font ',11'", f"set output '{path}'", "set grid lc rgb '#dddddd'",
                        "set linetype 5 lc rgb '#8b4513'", f"set xlabel '{plot.xlabel}'", f"set ylabel '{plot.ylabel}'", *plot.extra, *blocks,
                        "plot " + ", ".join(parts)])
    subprocess.run(["gnuplot"], input=script + "\n", text=True, check=True)
