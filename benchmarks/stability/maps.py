"""Maps of the stability runs (SVG and PNG, by gnuplot) and the tables of docs/stability.md, from results.csv and libs/simulation/safeRange.csv."""
import csv
import pathlib
import subprocess

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
PICTURES, PAGE, RANGES = ROOT / "docs" / "pictures", ROOT / "docs" / "stability.md", ROOT / "libs" / "simulation" / "safeRange.csv"
MARKS = ("<!-- tables: written by stability.py -draw -->", "<!-- end of tables -->")
VERDICTS = ("stable", "inaccurate", "failed")
POINTS = {"stable": "pt 7 ps 1.1 lc rgb '#2a9d4a'", "inaccurate": "pt 9 ps 1.4 lc rgb '#e69f00'", "failed": "pt 2 ps 1.3 lw 3 lc rgb '#c1121f'"}
NAMES = {"box": "box", "capsule": "capsule", "redCell": "red cell"}


def rows():
    with open(HERE / "results.csv") as text:
        return list(csv.DictReader(text))


def declared():
    """Safe ranges: (axis, integrator): (low, high)."""
    if not RANGES.exists():
        return {}
    with open(RANGES) as text:
        lines = [line for line in text if not line.startswith("#")]
    return {(row["axis"], row["integrator"]): (float(row["low"]), float(row["high"])) for row in csv.DictReader(lines)}


def worst(runs):
    return max((run["verdict"] for run in runs), key=VERDICTS.index) if runs else None


def panel(points, more=""):
    """Commands of one panel: points (x, y, verdict)."""
    blocks, plots = [], []
    for verdict in VERDICTS:
        here = [f"{x} {y}" for x, y, v in points if v == verdict]
        if here:
            panel.count += 1
            blocks.append(f"$p{panel.count} << E\n" + "\n".join(here) + "\nE")
            plots.append(f"$p{panel.count} with points {POINTS[verdict]} notitle")
    return "\n".join([*blocks, more, "plot " + ", ".join(plots or ["NaN notitle"])])


panel.count = 0


def picture(name, size, commands):
    PICTURES.mkdir(exist_ok=True)
    for terminal, ending in (("pngcairo", "png"), ("svg", "svg")):
        script = [f"set terminal {terminal} size {size[0]},{size[1]} font 'Sans,11'" + (" background '#ffffff'" if terminal == "svg" else ""),
                  f"set output '{PICTURES / name}.{ending}'", "set grid lc rgb '#dddddd'", *commands]
        subprocess.run(["gnuplot"], input="\n".join(script) + "\n", text=True, check=True)


def key(y):
    """Legend, as labels along the top."""
    words = {"stable": "stable", "inaccurate": "inaccurate", "failed": "failed"}
    lines, x = [], 0.30
    for verdict, word in words.items():
        lines += [f"set label '{word}' at screen {x + 0.012},{y} left front point {POINTS[verdict]} offset 0.8,0"]
        x += 0.14
    return lines


def rectangle(xs, ys):
    return f"set object 1 rectangle from {xs[0]},{ys[0]} to {xs[1]},{ys[1]} fillcolor rgb '#e8f5ea' fillstyle solid noborder behind"


def logRange(values, room=2):
    return f"[{min(values) / room}:{max(values) * room}]"


def drawImplicit(table, safe):
    """Ca and Re, a panel for each cell and step."""
    runs = [r for r in table if r["map"] in ("implicit", "edge") and r["scheme"] == "implicit" and r["Ca"] and float(r["lambda"]) == 1]
    if not runs:
        return
    steps = sorted({float(r["step"]) for r in runs})
    commands = [*key(0.975), f"set multiplot layout 2,{len(steps)} margins 0.06,0.99,0.10,0.90 spacing 0.018,0.09", "set logscale xy", "set format '10^{%T}'",
                f"set xrange {logRange([float(r['Ca']) for r in runs], 3)}", f"set yrange {logRange([float(r['Re']) for r in runs], 3)}", "set xtics 100", "set ytics 10"]
    Ca, Re, step = (safe.get((axis, "implicit")) for axis in ("Ca", "Re", "implicit.step"))
    for scene in ("capsule", "redCell"):
        for k, dt in enumerate(steps):
            points = [(r["Ca"], r["Re"], r["verdict"]) for r in runs if r["scene"] == scene and float(r["step"]) == dt]
            shade = rectangle(Ca, Re) if Ca and Re and step and dt <= step[1] * 1.0001 else "unset object 1"
            commands += [f"set title '{NAMES[scene]}, step {dt:g}' offset 0,-0.6", "set ylabel 'Re' offset 1" if k == 0 else "unset ylabel",
                         "set format y '10^{%T}'" if k == 0 else "set format y ''", "set xlabel 'Ca' offset 0,0.6" if scene == "redCell" else "unset xlabel",
                         panel(points, shade)]
            if not points:
                continue
            commands.append("unset label")
    commands.append("unset multiplot")
    picture("stabilityImplicit", (1500, 640), commands)


def drawRatio(table, safe):
    """Viscosity ratio and Ca, the worst of three Re, a panel for each cell and step."""
    runs = [r for r in table if r["scheme"] == "implicit" and r["Ca"] and r["map"] in ("implicit", "ratio")]
    ratios = {r["lambda"] for r in runs if r["map"] == "ratio"} | {"1"}
    steps = sorted({float(r["step"]) for r in runs if r["map"] == "ratio"})
    if len(ratios) < 2:
        return
    Cas = {r["Ca"] for r in runs if r["map"] == "ratio"}
    commands = [*key(0.965), f"set multiplot layout 1,{2 * len(steps)} margins 0.06,0.99,0.16,0.84 spacing 0.018,0.1", "set logscale xy", "set format '10^{%T}'",
                "set format x '%g'", "set xrange [0.1:100]", "set yrange [2e-4:50]", "set xtics (0.2,1,5,50)", "set ytics 10"]
    ratio, Ca, step = (safe.get((axis, "implicit")) for axis in ("lambda", "Ca", "implicit.step"))
    for scene in ("capsule", "redCell"):
        for k, dt in enumerate(steps):
            here = [r for r in runs if r["scene"] == scene and float(r["step"]) == dt]
            points = [(x, y, v) for x in sorted(ratios) for y in sorted(Cas)
                      if (v := worst([r for r in here if r["lambda"] == x and r["Ca"] == y and float(r["Re"]) in (1e-4, 1e-2, 1)]))]
            shade = rectangle(ratio, Ca) if ratio and Ca and step and dt <= step[1] * 1.0001 else "unset object 1"
            first = scene == "capsule" and k == 0
            commands += [f"set title '{NAMES[scene]}, step {dt:g}' offset 0,-0.6", "set ylabel 'Ca' offset 1" if first else "unset ylabel",
                         "set format y '10^{%T}'" if first else "set format y ''", "set xlabel 'viscosity ratio' offset 0,0.5", panel(points, shade), "unset label"]
    commands.append("unset multiplot")
    picture("stabilityRatio", (1500, 400), commands)


def label(run):
    """Label of a scene of the explicit map."""
    words = [NAMES[run["scene"]], run["scheme"].replace("velocityVerlet", "Verlet")]
    words += [f"Ca {run['Ca']}"] if run["Ca"] else []
    words += [f"Re {run['Re']}"] + ([f"lambda {run['lambda']}"] if run["lambda"] not in ("", "1") else [])
    words += [f"{run['axis']} {run['value']}"] if run["axis"] else []
    return ", ".join(words)


def explicitScenes(table):
    """The runs of each label, and the limit of the step that is decisive."""
    found = {}
    for run in table:
        if run["times"] and run["map"] == "limits":
            found.setdefault((label(run), run["limit"]), []).append(run)
    merged = {}  # where `least` is a limit that has runs by its name too
    for (name, limit), runs in found.items():
        binding = limit if limit != "least" else next((r["boundBy"] for r in runs if r["boundBy"]), limit)
        merged.setdefault((name, binding), []).extend(runs)
    return merged


def drawExplicit(table, safe):
    """Verdicts over multiples of the step's limit, a line for each scene."""
    scenes = explicitScenes(table)
    if not scenes:
        return
    points, tics = [], []
    for k, ((name, limit), runs) in enumerate(reversed(list(scenes.items()))):
        tics.append(f"'{name}: {limit}' {k}")
        points += [(r["times"], k, r["verdict"]) for r in runs]
    shade = f"set object 1 rectangle from 0.45,-1 to 1,{len(scenes)} fillcolor rgb '#e8f5ea' fillstyle solid noborder behind"
    commands = [*key(0.985), "set lmargin at screen 0.52", "set rmargin at screen 0.98", "set tmargin at screen 0.965", "set logscale x", "set xrange [0.45:9]",
                f"set yrange [-1:{len(scenes)}]", "set xtics (0.5,0.7,0.9,1.1,1.5,2,4,8)", "set ytics (" + ", ".join(tics) + ") font ',10'",
                "set xlabel 'step over the limit named (without the factor safety)'", "set arrow 1 from 1,-1 to 1," + str(len(scenes)) + " nohead lw 1.5 lc rgb '#555555'",
                panel(points, shade)]
    picture("stabilityExplicit", (1250, 60 + 24 * len(scenes) + 60), commands)


def drawChanges(table, safe):
    """One change at a time: a line for each, a column for each scene and scheme."""
    runs = [r for r in table if r["map"] == "one" and r["axis"]]
    if not runs:
        return
    columns = [(scene, scheme) for scheme in ("implicit", "explicit") for scene in NAMES]
    lines = list(dict.fromkeys((r["axis"], r["value"]) for r in runs))
    order = list(dict.fromkeys(axis for axis, _ in lines))
    lines.sort(key=lambda line: (order.index(line[0]), float(line[1]) if line[1].replace(".", "").replace("-", "").isdigit() else 0))
    def verdicts(axis, value):
        for x, (scene, scheme) in enumerate(columns):
            here = [r for r in runs if (r["axis"], r["value"], r["scene"]) == (axis, value, scene)]
            if scheme == "implicit":
                yield x, worst([r for r in here if r["scheme"] == "implicit" and r["twin"] and float(r["step"]) <= 0.05])
            else:
                yield x, worst([r for r in here if r["times"] == "0.9"])
    lines = [line for line in lines if any(verdict for _, verdict in verdicts(*line))]
    points, tics = [], []
    for k, (axis, value) in enumerate(reversed(lines)):
        tics.append(f"'{axis} {value}' {k}")
        points += [(x, k, verdict) for x, verdict in verdicts(axis, value) if verdict]
    if not points:
        return
    names = [f'"{NAMES[scene]}\\n{"implicit, 0.05" if scheme == "implicit" else "Verlet, 0.9 x"}" {x}' for x, (scene, scheme) in enumerate(columns)]
    commands = [*key(0.985), "set lmargin at screen 0.33", "set rmargin at screen 0.97", "set tmargin at screen 0.965", "set bmargin 3.5", "set xrange [-0.5:5.5]",
                f"set yrange [-1:{len(lines)}]", "set xtics (" + ", ".join(names) + ") font ',10'", "set ytics (" + ", ".join(tics) + ") font ',10'", panel(points)]
    picture("stabilityChanges", (900, 80 + 22 * len(lines) + 60), commands)


def tables(table):
    """Writes into the page, between its marks: counts, bounds of the explicit limits, and every run that is not stable."""
    def counted(name, runs):
        numbers = [sum(r["verdict"] == verdict for r in runs) for verdict in VERDICTS]
        return f"| {name} | {len(runs)} | " + " | ".join(map(str, numbers)) + " |"
    implicit = [r for r in table if r["scheme"] == "implicit"]
    inside = [r for r in implicit if isPromised(r)]
    explicit = [r for r in table if r["times"]]
    seconds = sum(float(r["coreSeconds"]) for r in table)
    lines = ["| runs | number | stable | inaccurate | failed |", "|---|---|---|---|---|", counted("all", table), counted("implicit step", implicit),
             counted("implicit step, Ca 0.001 to 10, Re 1e-4 to 1, lambda 0.2 to 50, step at most 0.05", inside),
             counted("explicit, step at most 0.9 of the limit", [r for r in explicit if float(r["times"]) <= 0.9]),
             counted("explicit, step 1.0 of the limit", [r for r in explicit if float(r["times"]) == 1]),
             counted("explicit, step above the limit", [r for r in explicit if float(r["times"]) > 1]), "",
             f"{seconds:.0f} core-seconds; {table[0]['machine']}; {min(r['date'] for r in table)}" +
             (f" to {max(r['date'] for r in table)}" if len({r["date"] for r in table}) > 1 else "") + ".", ""]
    lines += ["### Explicit limits, scene by scene", "", "| scene | limit | largest step that was stable | smallest that was not | its sign |", "|---|---|---|---|---|"]
    for (name, limit), runs in explicitScenes(table).items():
        bad = sorted((float(r["times"]), r["verdict"], r["sign"]) for r in runs if r["verdict"] != "stable")
        good = [float(r["times"]) for r in runs if r["verdict"] == "stable" and (not bad or float(r["times"]) < bad[0][0])]
        lines.append(f"| {name} | {limit} | {max(good):g} | " + (f"{bad[0][0]:g} | {bad[0][1]}: {bad[0][2]} |" if bad else "none | |") if good else
                     f"| {name} | {limit} | none | {bad[0][0]:g} | {bad[0][1]}: {bad[0][2]} |")
    rest = [r for r in table if r["verdict"] != "stable" and r not in [x for runs in explicitScenes(table).values() for x in runs]]
    lines += ["", "### Every other run that is not stable", "", "| scene | scheme | what | step | verdict | sign | strain |", "|---|---|---|---|---|---|---|"]
    for r in sorted(rest, key=lambda r: (r["scheme"] != "implicit", r["scene"], r["axis"], r["value"], r["Ca"], r["Re"], r["step"])):
        what = ", ".join([*([f"Ca {r['Ca']}"] if r["Ca"] else []), f"Re {r['Re']}", *([f"lambda {r['lambda']}"] if r["lambda"] not in ("", "1") else []),
                          *([f"{r['axis']} {r['value']}"] if r["axis"] else [])])
        lines.append(f"| {NAMES[r['scene']]} | {r['scheme']} | {what} | {r['step'] or r['times'] + ' x ' + r['limit']} | {r['verdict']} | {r['sign']} | {r['strainOfSign']} |")
    if PAGE.exists():
        before, after = PAGE.read_text().split(MARKS[0])
        PAGE.write_text(before + MARKS[0] + "\n\n" + "\n".join(lines) + "\n\n" + MARKS[1] + after.split(MARKS[1])[1])
    return lines


def isPromised(run):
    return (run["scheme"] == "implicit" and float(run["step"]) <= 0.05 and not run["axis"] and (
        not run["Ca"] or (1e-3 <= float(run["Ca"]) <= 10 and 0.2 <= float(run["lambda"]) <= 50)) and 1e-4 <= float(run["Re"]) <= 1)


def draw():
    table, safe = rows(), declared()
    drawImplicit(table, safe)
    drawRatio(table, safe)
    drawExplicit(table, safe)
    drawChanges(table, safe)
    tables(table)
    for run in outside(table, safe):
        print(f"{run['run']}: {run['verdict']} ({run['sign']}), though inside the declared range")


def outside(table, safe):
    """Runs that are not stable although every axis is inside its declared range; explicit steps up to the least limit."""
    axes = {"jitter": "fill.jitter", "resolution": "a/dx", "bulk modulus": "bulkModulus", "shifting": "shifting.coefficient", "tolerance": "implicit.tolerance"}
    def inside(run):
        integrator = "implicit" if run["scheme"] == "implicit" else run["scheme"].split()[0]
        values = {"Ca": run["Ca"], "Re": run["Re"], "lambda": run["lambda"], "implicit.step": run["step"], axes.get(run["axis"], run["axis"]): run["value"]}
        for axis, value in values.items():
            limits = safe.get((axis, integrator))
            try:
                if limits and value and not limits[0] * 0.9999 <= float(value) <= limits[1] * 1.0001:
                    return False
            except ValueError:
                return False
        return True
    return [run for run in table if run["verdict"] != "stable" and (not run["times"] or (float(run["times"]) <= 1 and run["limit"] in ("least", run["boundBy"]))) and inside(run)]
