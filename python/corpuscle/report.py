"""One page about a case: pictures, a view of the cells that can be turned, curves, settings, and what the run cost.

    corpuscle.report(corpuscle.Case("myCell"))                                         # writes myCell/postProcessing/report.html
    corpuscle.report(corpuscle.Case("fine"), others=[corpuscle.Case("coarse")])        # with the curves of another case

The page is one file that needs nothing else: pictures, meshes and curves are in it. The program `caseReport` calls this.
"""
import base64
import html
import io
import json
import math
import os
import pathlib
import re
import tempfile

import numpy
import pandas

from . import programs, results, tables

HERE = pathlib.Path(__file__).resolve().parent
MOST_POINTS = 400_000    # of all meshes in the view; beyond, fewer times are shown
MOST_CURVES = 12         # cells that have a curve each; more are shown as median and range
MOST_SAMPLES = 1500      # of a curve
FIELDS = ("areaStrain", "tension1", "stretch")  # colours of the view, the first that the results have, if none is asked for


ALONG = ("strain", "time_s", "stage")  # columns over which curves are drawn


class ReportError(ValueError):
    """What cannot be reported, in a sentence for the user."""


def report(case, output=None, field=None, names=None, references=(), pictures=4, warn=print, others=()):
    """Writes the page and returns its path.

    output      HTML file; postProcessing/report.html of the case if none is given
    field       colours cells in pictures and view: an array of the results, or "none"
    names       tables whose curves are drawn; all if none are given
    references  CSV files with a column strain, time_s or stage: other columns are drawn beside those of the same name, and compared with them
    pictures    number of times in the picture; 0: no picture
    warn        is called with what is left out, and why
    others      cases whose curves are drawn beside those of this one, and whose settings are compared with its own
    """
    output = pathlib.Path(output) if output else case.folder / "postProcessing" / "report.html"
    record = case.record
    if not record:
        raise ReportError(f"{case.folder} has no run.json: run the case first")
    unknown = [name for name in names or () if name not in case.tables]
    if unknown:
        raise ReportError(f"there is no table {unknown[0]!r}; there are {', '.join(case.tables) or 'none'}")
    given = [_Reference(path) for path in references]
    beside = _distinct(case, others)
    surfaces = [name for name in case.streams if name not in ("fluid", "walls")]
    field = _field(case, surfaces, field)
    warnings = _warnings(case)
    sections = [_head(case, record, warnings)]
    if pictures and case.streams:
        sections.append(_picture(case, field, pictures, warn))
    if surfaces:
        sections.append(_view(case, surfaces, field, record.get("application") == "membraneRelax"))
    curves = _Curves(case, names, given, beside, warn)
    sections += [_differences(beside), curves.comparison(), curves.section(), curves.values(), _budget(record), _cost(record), _groups(record), _settings(case), _list("Warnings", warnings)]
    title = html.escape(case.folder.resolve().name)
    page = (HERE / "report.html").read_text(encoding="utf-8")
    for mark, text in (("@TITLE@", title), ("@SCRIPT@", (HERE / "report.js").read_text(encoding="utf-8")), ("@BODY@", "\n".join(filter(None, sections)))):
        page = page.replace(mark, text)
    output.parent.mkdir(parents=True, exist_ok=True)
    scratch = output.with_name(output.name + f".{os.getpid()}.new")
    try:
        scratch.write_text(page, encoding="utf-8")
        scratch.replace(output)
    finally:
        scratch.unlink(missing_ok=True)
    return output


def _table(rows, head=None, kind=""):
    """Rows of texts, which are HTML already."""
    top = "<thead><tr>" + "".join(f"<th>{one}</th>" for one in head) + "</tr></thead>" if head else ""
    body = "".join("<tr>" + "".join(f"<td>{one}</td>" for one in row) + "</tr>" for row in rows)
    return f'<div class="wide"><table class="{kind}">{top}<tbody>{body}</tbody></table></div>'


def _number(value):
    if isinstance(value, bool) or value is None:
        return html.escape(json.dumps(value))
    if isinstance(value, (int, float)):
        return f"{value:.6g}"
    if isinstance(value, (list, tuple)):
        return html.escape(", ".join(_number(one) for one in value))
    return html.escape(str(value))


def _named(key):
    """A key of run.json, such as wallClock_s, as words with its unit."""
    name, _, unit = key.rpartition("_")
    units = {"s": "s", "m": "m", "m2": "m<sup>2</sup>", "m3": "m<sup>3</sup>", "J": "J", "Ns": "N s", "strain": "strain", "percent": "%"}
    if name and unit in units:
        key, unit = name, f" [{units[unit]}]"
    else:
        unit = ""
    return html.escape(key) + unit


def _duration(seconds):
    seconds = round(seconds)
    hours, minutes = seconds // 3600, seconds // 60 % 60
    return f"{hours} h {minutes} min" if hours else f"{minutes} min {seconds % 60} s" if minutes else f"{seconds} s"


def _list(title, texts):
    if not texts:
        return ""
    return f"<h2>{title}</h2><ul>" + "".join(f"<li>{html.escape(text)}</li>" for text in texts) + "</ul>"


def _warnings(case):
    """Each warning of the logs once, without the numbers of steps, which differ."""
    found = {}
    for log in sorted(case.folder.glob("log.*")):
        for line in log.read_text(encoding="utf-8", errors="replace").splitlines():
            if line.startswith("warning: "):
                text = line[len("warning: "):]
                key = log.name + re.sub(r"[-+]?[0-9][-+.0-9e]*", "#", text)
                first, count = found.get(key, (f"{log.name[4:]}: {text}", 0))
                found[key] = first, count + 1
    return [text if count == 1 else f"{text} (and {count - 1} more like it)" for text, count in found.values()]


def _head(case, record, warnings):
    status, result = record.get("status", "unknown"), record.get("result", {})
    rows = [("status", f'<span class="{html.escape(status)}">{html.escape(status)}</span>' + (f": {html.escape(record['reason'])}" if record.get("reason") else "")),
            ("application", html.escape(record.get("application", ""))), ("started", html.escape(record.get("start", "").replace("T", " ").replace("Z", " UTC")))]
    if "wallClock_s" in record:
        rows.append(("last part of the run", f"{_duration(record['wallClock_s'])} on {record.get('ranks', 1)} rank{'s' if record.get('ranks', 1) != 1 else ''}"))
    if "time_s" in result:
        rows.append(("reached", f"t = {result['time_s']:.6g} s" + (f", strain {result['strain']:.6g}" if result.get("strain") else "")))
    if result.get("brokenBonds"):
        rows.append(("bonds broken", _number(result["brokenBonds"])))
    if result.get("guardMoves"):
        rows.append(("particles moved back across a membrane", _number(result["guardMoves"])))
    if warnings:
        rows.append(("warnings", f"{len(warnings)}, at the end of this page"))
    machine = record.get("machine", {})
    rows.append(("by", html.escape(f"Corpuscle {record.get('version', '')} ({record.get('build', {}).get('git', '')}), {machine.get('processor', '')}, {machine.get('cores', '')} cores")))
    return _table(rows, kind="pairs")


def _field(case, surfaces, asked):
    """The array that colours the cells, or None. An array that no surface has is an error."""
    have = sorted({name for one in surfaces for name in _arrays(case.surface(one))})
    if asked and asked != "none" and asked not in have:
        raise ReportError(f"no cell has an array {asked!r} with one number for each node or triangle; there are {', '.join(have) or 'none'}")
    return None if asked == "none" else asked or next((name for name in FIELDS if name in have), None)


def _arrays(surface):
    """Arrays of one number for each node or triangle."""
    arrays = {name: values for name, values in {**surface.pointData, **surface.cellData}.items() if values.ndim == 1}
    return {name: values for name, values in arrays.items() if len(values) in (len(surface.points), len(surface.triangles))}


def _picture(case, field, count, warn):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "picture.png"
        words = [programs.program("renderCase"), "-case", case.folder, "-quiet", "-count", count, "-output", path, "-size", 1600]
        try:
            programs.run(words + (["-field", field] if field else []))
        except programs.CorpuscleError as error:
            warn(f"there is no picture: {error}")
            return ""
        data = base64.b64encode(path.read_bytes()).decode()
    return f'<h2>Pictures</h2><figure><img alt="The case at {count} times" src="data:image/png;base64,{data}"></figure>'


def _packed(values, kind):
    return base64.b64encode(numpy.ascontiguousarray(values, dtype=kind).tobytes()).decode()


def _quantised(values, low, high, most):
    return numpy.clip(numpy.rint((values - low) / numpy.maximum(numpy.subtract(high, low), 1e-300) * most), 0, most)


def _box(case):
    """Size and periodicity of the box [m], or None."""
    try:
        domain = case.used.get("system/mesh.yaml", {}).get("domain", {})
        size = numpy.array([float(str(one).split()[0]) for one in domain["size"]])
        return size, numpy.array([bool(one) for one in domain["periodic"]])
    except (FileNotFoundError, KeyError, TypeError, ValueError):
        return None


def _wrapped(surface, box):
    """The points of each cell, moved as a whole so that its middle lies in the box."""
    points = surface.points.copy()
    if box is None:
        return points
    size, periodic = box
    cells = surface.pointData.get("cell", numpy.zeros(len(points), dtype=int))
    _, which = numpy.unique(cells, return_inverse=True)
    number = which.max() + 1 if len(which) else 0
    middle = numpy.stack([numpy.bincount(which, points[:, k], number) / numpy.bincount(which, minlength=number) for k in range(3)], axis=1)
    move = numpy.zeros_like(middle)
    sliding = surface.fieldData.get("slidingAxis")
    if sliding is not None and len(sliding):  # the next image along this axis is displaced along x
        axis = int(sliding[0])
        times = numpy.floor((middle[:, axis] + size[axis] / 2) / size[axis])
        move[:, axis] -= times * size[axis]
        move[:, 0] -= times * float(surface.fieldData["imageOffset"][0])
    for k in range(3):
        if periodic[k]:
            at = middle[:, k] + move[:, k]
            move[:, k] -= size[k] * numpy.floor((at + size[k] / 2) / size[k])
    return points + move[which]


def _view(case, names, field, areStages):
    """Meshes of all cells and bodies at the times of the results, for report.js."""
    box = _box(case)
    streams = {name: results.entries(case.folder / "results" / f"{name}.pvd") for name in names}
    streams = {name: entries for name, entries in streams.items() if entries}
    if not streams:
        return ""
    times = sorted({time for entries in streams.values() for time, _ in entries})
    last = {name: results.readSurface(entries[-1][1]) for name, entries in streams.items()}
    count = sum(len(surface.points) for surface in last.values())
    most = max(1, min(len(times), MOST_POINTS // max(count, 1)))
    shown = [times[round(k * (len(times) - 1) / max(most - 1, 1))] for k in range(most)] if most > 1 else times[-1:]
    frames, low, high, strains = [], numpy.full(3, math.inf), numpy.full(3, -math.inf), []
    if box is not None:
        low, high = -box[0] / 2, box[0] / 2
    for time in shown:
        frame, strain = {}, math.nan
        for name, entries in streams.items():
            nearest = min(entries, key=lambda entry: abs(entry[0] - time))
            surface = results.readSurface(nearest[1])
            points, strain = _wrapped(surface, box), surface.strain
            frame[name] = surface, points, _perNode(surface, field) if field else numpy.zeros(0)
            low, high = numpy.minimum(low, points.min(axis=0)), numpy.maximum(high, points.max(axis=0))
        frames.append(frame)
        strains.append(strain)
    known = numpy.concatenate([values for frame in frames for _, _, values in frame.values()])
    known = known[numpy.isfinite(known)]
    bounds = [float(known.min()), float(known.max())] if len(known) else None
    if bounds and bounds[0] < 0 < bounds[1]:  # the grey in the middle of the colours is 0
        bounds = [-max(-bounds[0], bounds[1]), max(-bounds[0], bounds[1])]
    data = {"low": low.tolist(), "high": high.tolist(), "box": None if box is None else box[0].tolist(), "field": field if bounds else None, "bounds": bounds, "frames": []}
    data["meshes"] = {name: {"triangles": _packed(surface.triangles, "<u4"), "cells": _packed(surface.pointData.get("cell", numpy.ones(len(surface.points))), "<u4")}
                      for name, surface in last.items()}
    for time, strain, frame in zip(shown, strains, frames):
        label = f"strain {strain:.4g}" if math.isfinite(strain) and (strain or time == 0) else f"t = {time:.4g} s"
        one = {"label": f"stage {time:g}" if areStages else label, "meshes": {}}
        for name, (surface, points, values) in frame.items():
            mesh = {"points": _packed(_quantised(points, low, high, 65535), "<u2")}
            if bounds:
                mesh["values"] = _packed(_quantised(numpy.nan_to_num(values, nan=bounds[0]), *bounds, 255), "u1")
            if "broken" in surface.cellData and surface.cellData["broken"].any():
                mesh["broken"] = _packed(surface.cellData["broken"] != 0, "u1")
            one["meshes"][name] = mesh
        data["frames"].append(one)
    fewer = f" {len(shown)} of {len(times)} times are shown." if len(shown) < len(times) else ""
    legend = f'<span id="legend">{html.escape(field)}: {bounds[0]:.4g} <i></i> {bounds[1]:.4g}</span>' if bounds else ""
    meshes = json.dumps(data, separators=(",", ":")).replace("<", "\\u003c")
    return (f'<h2>Cells</h2><p>Drag to turn, use the wheel or two fingers to zoom.{fewer}</p><div id="view"><canvas></canvas></div>'
            f'<p id="controls"><button>play</button> <input type="range" min="0" max="{len(shown) - 1}" value="{len(shown) - 1}" aria-label="time"> '
            f'<span id="label"></span> {legend}</p><script type="application/json" id="meshes">{meshes}</script>')


def _perNode(surface, field):
    """The field at the nodes; that of triangles averaged over those that meet in a node."""
    values = _arrays(surface).get(field)
    if values is None:
        return numpy.full(len(surface.points), math.nan)
    if field in surface.pointData and len(values) == len(surface.points):
        return values.astype(float)
    alive = surface.cellData["broken"] == 0 if "broken" in surface.cellData else numpy.ones(len(surface.triangles), dtype=bool)
    corners = surface.triangles[alive].ravel()
    of = numpy.repeat(values[alive].astype(float), 3)
    count = numpy.bincount(corners, minlength=len(surface.points))
    return numpy.bincount(corners, of, len(surface.points)) / numpy.where(count > 0, count, numpy.nan)


def _along(table):
    if "strain" in table and table["strain"].max() > 0:
        return "strain"
    return next((name for name in ALONG[1:] if name in table), None)


def _distinct(case, others):
    """The other cases by their names: the last parts of their paths, as many as tell them and the case itself apart."""
    for one in others:
        if not one.record:
            raise ReportError(f"{one.folder} has no run.json: run the case first")
    paths = [one.folder.resolve().parts for one in (case, *others)]
    if len(set(paths)) < len(paths):
        raise ReportError("a case is compared with itself, or twice with the same one")
    count = next(n for n in range(1, max(map(len, paths)) + 1) if len({parts[-n:] for parts in paths}) == len(paths))
    names = ["/".join(parts[-count:]) for parts in paths]
    return [_Other(name, one) for name, one in zip(names, (case, *others))]


class _Other:
    """A case whose curves are drawn: its name and its tables."""

    def __init__(self, name, case):
        self.name, self.case, self._tables = name, case, {}

    def curve(self, table, along, column):
        """A column over `along`, the median where there are several cells; None where the case has no such numbers."""
        if table not in self._tables:
            try:
                self._tables[table] = self.case.table(table)
            except (FileNotFoundError, ValueError):
                self._tables[table] = None
        rows = self._tables[table]
        if rows is None or column not in rows or along not in rows or not pandas.api.types.is_numeric_dtype(rows[column]):
            return None
        curve = rows.groupby(along)[column].median()
        return curve if numpy.isfinite(curve).any() else None


def _entries(settings, path=""):
    """Entries of nested settings by their paths, FILE:/a/b/0 as for -set."""
    if isinstance(settings, dict) and settings:
        for key, value in settings.items():
            yield from _entries(value, f"{path}/{key}" if path else f"{key}:")
    elif isinstance(settings, list) and any(isinstance(one, (dict, list)) for one in settings):
        for k, value in enumerate(settings):
            yield from _entries(value, f"{path}/{k}")
    else:
        yield path, settings


def _differences(beside):
    """The settings in which the cases differ, as the runs understood them."""
    if len(beside) < 2:
        return ""
    all_ = [dict(_entries(one.case.used)) for one in beside]
    keys = list(dict.fromkeys(key for entries in all_ for key in entries))
    rows = [(html.escape(key), *("" if key not in entries else _number(entries[key]) for entries in all_))
            for key in keys if any(entries.get(key) != all_[0].get(key) or key not in entries for entries in all_)]
    head = ("setting", *(html.escape(one.name) for one in beside))
    return "<h2>Settings that differ</h2>" + (_table(rows, head) if rows else "<p>None.</p>")


def _thinned(rows):
    return rows.iloc[::max(1, -(-len(rows) // MOST_SAMPLES))]


class _Reference:
    """A CSV file with comments, a head and numbers."""

    def __init__(self, path):
        self.path = pathlib.Path(path)
        if not self.path.is_file():
            raise ReportError(f"{path}: there is no such reference")
        try:
            self.table = pandas.read_csv(self.path, comment="#")
        except (ValueError, UnicodeDecodeError) as error:
            raise ReportError(f"{path} is no CSV file: {error}") from error
        self.table.columns = [str(name).strip() for name in self.table.columns]
        self.along = next((name for name in ALONG if name in self.table), None)
        if self.along is None:
            raise ReportError(f"{path} has no column strain, time_s or stage; it has {', '.join(self.table.columns)}")
        texts = [name for name in self.table if not pandas.api.types.is_numeric_dtype(self.table[name])]
        if texts:
            raise ReportError(f"{path}: the column {texts[0]} is not of numbers")
        self.table = self.table.sort_values(self.along)


class _Curves:
    """Curves of all tables over strain, over time where the flow has no strain, or over stages of membraneRelax."""

    def __init__(self, case, names, references, beside, warn):
        self.references, self.compared, self.parts = references, [], []
        self.name, self.others, self.last = beside[0].name, beside[1:], []
        used = set()
        for name in names or case.tables:
            try:
                table = case.table(name)
            except ValueError as error:
                warn(f"{name} is left out: {error}")
                continue
            along = _along(table)
            if along is None or len(table) < 2:
                continue
            key = self._key(table, along)
            if key is not None and key != "cell":
                continue  # rows of another kind, as layers of a profile
            before = len(self.compared)
            figures = [self._figure(name, table, along, key, column, used) for column in table.columns if column not in (*ALONG, "cell")]
            figures = list(filter(None, figures))
            if figures:
                title = table.attrs["title"].split(" of Corpuscle, ")[-1]
                self.parts.append((len(self.compared) == before, "residualShare" in table or "density_max" in table, name, title, figures))
        for one in references:
            if one not in used:
                raise ReportError(f"{one.path} has no column that a table has too (it has {', '.join(one.table.columns)}); "
                                  f"the tables are {', '.join(names or case.tables) or 'none'}")

    @staticmethod
    def _key(table, along):
        """The column that tells rows of one time apart, if there is one."""
        if not table[along].duplicated().any():
            return "cell" if "cell" in table else None
        return "cell" if "cell" in table else next((name for name in table.columns if name not in ALONG), None)

    def _figure(self, name, table, along, key, column, used):
        values = table[column]
        if not pandas.api.types.is_numeric_dtype(values) or not numpy.isfinite(values).any():
            return None
        groups = [(str(cell), rows) for cell, rows in table.groupby("cell")] if key == "cell" else [("", table)]
        same = [one for one in self.references if one.along == along and column in one.table]
        beside = [(one.name, one.curve(name, along, column)) for one in self.others]
        beside = [(label, curve) for label, curve in beside if curve is not None]
        both = numpy.concatenate([values, *(curve for _, curve in beside)])
        if numpy.nanmax(both) == numpy.nanmin(both) and not same:
            return None  # nothing to see; the last value is in run.json
        if beside:
            self._compareLast(name, table, along, column, dict(beside))
        for one in same:
            used.add(one)
            self._compare(name, groups, along, column, one)
        meaning = table.attrs["meanings"].get(column, "")
        label = html.escape(column)
        return (f'<figure>{self._svg(groups, along, column, table.attrs["units"].get(column, ""), same, beside)}'
                f'<figcaption><b>{label}</b>: {html.escape(meaning)}</figcaption></figure>')

    def _compare(self, name, groups, along, column, reference):
        for cell, rows in groups[:MOST_CURVES]:
            x, y = rows[along].to_numpy(), rows[column].to_numpy()
            at = reference.table[along].to_numpy()
            inside = (at >= x[0]) & (at <= x[-1])
            if not inside.any():
                continue
            expected = reference.table[column].to_numpy()[inside]
            difference = numpy.interp(at[inside], x, y) - expected
            scale = numpy.abs(expected).max()
            self.compared.append((html.escape(f"{name}: {column}" + (f", cell {cell}" if len(groups) > 1 else "")), html.escape(reference.path.name), str(int(inside.sum())),
                                  f"{numpy.sqrt((difference**2).mean()):.3g}", f"{numpy.abs(difference).max():.3g}",
                                  f"{100 * numpy.abs(difference).max() / scale:.2g} %" if scale > 0 else "", f"{difference[-1]:+.3g}"))

    def _compareLast(self, name, table, along, column, beside):
        """Values of all cases where the shortest of the runs ends."""
        curves = {self.name: table.groupby(along)[column].median(), **beside}
        curves = {label: curve.dropna() for label, curve in curves.items()}
        end = min(curve.index.max() for curve in curves.values())
        at = {label: f"{numpy.interp(end, curve.index, curve):.6g}" for label, curve in curves.items()}
        self.last.append((html.escape(f"{name}: {column}"), f"{end:.6g}", *(at.get(label, "") for label in (self.name, *(one.name for one in self.others)))))

    def values(self):
        """A table of the last values of all cases."""
        if not self.last:
            return ""
        head = ("curve", "at", *(html.escape(name) for name in (self.name, *(one.name for one in self.others))))
        return ("<h2>Last values</h2><details><summary>At the last strain, time or stage that all of these cases have reached; medians where there are "
                f"several cells</summary>{_table(self.last, head)}</details>")

    def comparison(self):
        if not self.compared:
            return ""
        head = ("curve", "reference", "points", "root mean square difference", "largest difference", "of the largest value", "at the last point")
        return "<h2>Comparison</h2>" + _table(self.compared, head)

    def section(self):
        if not self.parts:
            return ""
        self.parts.sort(key=lambda part: part[:2])  # first what is compared, last what checks the run
        several = "".join(f'<details{" open" if k == 0 else ""}><summary>{html.escape(name)}: {html.escape(title)}</summary>'
                          f'<div class="plots">{"".join(figures)}</div></details>' for k, (_, _, name, title, figures) in enumerate(self.parts))
        return "<h2>Curves</h2>" + several

    def _svg(self, groups, along, column, unit, references, beside):
        import matplotlib
        matplotlib.use("Agg")
        from matplotlib.figure import Figure
        with matplotlib.rc_context({"svg.fonttype": "none", "svg.hashsalt": "report", "font.size": 9, "axes.grid": True, "grid.color": "#dddddd"}):
            figure = Figure(figsize=(4.2, 2.7), layout="constrained")
            axes = figure.add_subplot()
            own = self.name if beside else "run" if references else None
            if len(groups) <= (1 if beside else MOST_CURVES):
                for cell, rows in groups:
                    thin = _thinned(rows)
                    axes.plot(thin[along], thin[column], lw=1.2, label=f"cell {cell}" if len(groups) > 1 else own)
            else:
                all_ = _thinned(pandas.concat([rows.set_index(along)[column] for _, rows in groups], axis=1))
                low, middle, high = (all_.quantile(share, axis=1) for share in (0.1, 0.5, 0.9))
                axes.fill_between(middle.index, low, high, alpha=0.25, lw=0, label="80 % of the cells")
                axes.plot(middle.index, middle, lw=1.2, label=own if beside else "median")
            for label, curve in beside:
                thin = _thinned(curve)
                axes.plot(thin.index, thin, lw=1.2, ls="--", label=label)
            for one in references:
                axes.plot(one.table[along], one.table[column], "o", ms=3, mfc="none", label=one.path.stem)
            if references:  # as far as the run has come
                first, last = groups[0][1][along].min(), groups[0][1][along].max()
                axes.set_xlim(first - 0.02 * (last - first), last + 0.02 * (last - first))
            axes.set_xlabel("time [s]" if along == "time_s" else along)
            axes.set_ylabel(column if not unit else f"{column} [{unit}]")
            if axes.get_legend_handles_labels()[1] and len(axes.lines) <= 8:
                axes.legend(fontsize=7)
            text = io.StringIO()
            figure.savefig(text, format="svg", metadata={"Date": None})
        return text.getvalue()[text.getvalue().index("<svg"):]


def _budget(record):
    for name, observer in record.get("observers", {}).items():
        if isinstance(observer, dict) and "residualShare" in observer:
            rows = [(_named(key), _number(value)) for key, value in observer.items()]
            return f"<h2>Budget of energy and momentum</h2><p>Observer {html.escape(name)}, over the whole run.</p>" + _table(rows, kind="pairs")
    return ""


def _cost(record):
    rows = [(_named(key), _number(value)) for key, value in record.get("performance", {}).items()]
    rows += [(f"steps limited by: {html.escape(name)}", _number(count)) for name, count in record.get("stepsLimitedBy", {}).items()]
    rows += [(_named(key), _number(value)) for key, value in record.get("extremes", {}).items()]
    return "<h2>Cost and steps</h2><p>Of the last part of the run.</p>" + _table(rows, kind="pairs") if rows else ""


def _groups(record):
    rows = [(html.escape(key), _number(value)) for key, value in record.get("groups", {}).items()]
    rows += [(_named(key), _number(value)) for key, value in record.get("parameters", {}).items() if key != "commandLine"]
    return "<h2>Dimensionless groups and parameters</h2>" + _table(rows, kind="pairs") if rows else ""


def _settings(case):
    """The settings of the run, as it understood them."""
    path = case.folder / "used.yaml"
    if not path.is_file():
        return ""
    parts = re.split(r"^(?=\S+\.yaml:$)", path.read_text(encoding="utf-8"), flags=re.MULTILINE)
    blocks = [part for part in parts if re.match(r"\S+\.yaml:\n", part)]
    several = ((part.split(":", 1)[0], part.split(":", 1)[1].lstrip("\n")) for part in blocks)
    return "<h2>Settings</h2>" + "".join(f"<details><summary>{html.escape(name)}</summary><pre>{html.escape(text)}</pre></details>" for name, text in several)
