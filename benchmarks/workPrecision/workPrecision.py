#!/usr/bin/env python3
"""Error against core-seconds: cases of validation, one line for each scheme, over resolution and step.

    workPrecision.py BIN DIRECTORY [CASE ...] [-scheme NAME] [-np 1]     BIN: directory of the programs; all cases without CASE
    workPrecision.py -draw                                              diagrams and table of what has been run, without running

What DIRECTORY holds already is not run again. Points go to results.csv, diagrams beside it (SVG and PNG), tables to README.md. The error of a case is
the largest of its figures of validation (tests/validation/CASE), relative, in per cent; core-seconds are those of the processor (run.json).
"""
import csv
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tests" / "validation"))
import suite

NUMERICS = "system/numerics.yaml:"
PAPER = [NUMERICS + text for text in ("/integrator=velocityVerlet", "/operators=plain", "/coupling=dualIdentity", "/kernel={type: lucy, support: 3 dx}",
                                      "/shifting=none")]
PLAIN = [NUMERICS + text for text in ("/integrator=velocityVerlet", "/operators=plain", "/kernel={type: wendlandC2, support: 3 dx}",
                                      "/shifting={coefficient: 1}")]
VERLET = [NUMERICS + text for text in ("/integrator=velocityVerlet", "/operators=corrected", "/kernel={type: wendlandC2, support: 2.4 dx}",
                                       "/shifting={coefficient: 1}")]
RKL2 = [NUMERICS + "/integrator=rkl2", *PLAIN[1:]]


def implicit(step):
    return [NUMERICS + "/integrator=implicit", *VERLET[1:], NUMERICS + f"/implicit={{step: {step}, tolerance: 1e-3}}"]


# Case: the validation case; resolutions; schemes with their settings. A rate in time is given by a flow of its own: steps of the implicit one are strains.
CASES = {
    "couette": ((16, 32, 64), {
        "paper": PAPER, "explicit, plain": PLAIN, "explicit, corrected": VERLET, "RKL2": RKL2,
        "implicit, 100 steps": implicit(2.8e-5), "implicit, 400 steps": implicit(7e-6)}),
    "taylorGreen2D": ((16, 32, 64), {
        "paper": PAPER, "explicit, plain": PLAIN, "explicit, corrected": VERLET, "RKL2": RKL2,
        "implicit, step 0.1": implicit(0.1), "implicit, step 0.05": implicit(0.05)}),
    "sphereArray": ((8, 12, 24), {"explicit, plain": PLAIN[:1] + PLAIN[1:3], "implicit, step 0.05": implicit(0.05)}),
    "capsuleSkalak": ((6, 8, 12), {
        "paper": PAPER, "explicit, corrected": VERLET, "implicit, step 0.1": implicit(0.1), "implicit, step 0.05": implicit(0.05)}),
    "redCellShear": ((6, 8, 12), {
        "paper": PAPER, "explicit, corrected": VERLET, "implicit, step 0.1": implicit(0.1), "implicit, step 0.05": implicit(0.05)}),
}
COLUMNS = ("case", "scheme", "resolution", "particles", "error_percent", "coreSeconds", "machine", "date")


def recorded():
    path = HERE / "results.csv"
    if not path.exists():
        return []
    with open(path) as text:
        return list(csv.DictReader(text))


def keep(point):
    points = [p for p in recorded() if any(p[key] != str(point[key]) for key in ("case", "scheme", "resolution"))] + [point]
    points.sort(key=lambda p: (list(CASES).index(p["case"]), str(p["scheme"]), int(p["resolution"])))
    with open(HERE / "results.csv", "w") as text:
        writer = csv.DictWriter(text, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(points)


def measure(name, scheme, settings, n, binaries, ranks, directory):
    record, _ = suite.validate(name, n, binaries, ranks, directory / scheme.replace(" ", ""), settings)
    worst = max(abs(figure["error"]) for figure in record["figures"] if figure["unit"] == "%")
    keep({"case": name, "scheme": scheme, "resolution": n, "particles": round(record["particles"]), "error_percent": f"{worst:.4g}",
          "coreSeconds": record["coreSeconds"], "machine": record["machine"], "date": record["date"]})


def draw(name):
    """One diagram a case: lines of schemes over resolutions."""
    points = [p for p in recorded() if p["case"] == name]
    schemes = list(dict.fromkeys(p["scheme"] for p in points))
    if not schemes:
        return
    blocks = [f"$d{k} << E\n" + "\n".join(f"{p['coreSeconds']} {p['error_percent']} {p['resolution']}" for p in points if p["scheme"] == scheme) + "\nE"
              for k, scheme in enumerate(schemes)]
    lines = ", ".join(f"$d{k} with linespoints pt 7 lw 2 lc {k + 1} title '{scheme}', $d{k} using 1:2:3 with labels offset 0.6,0.6 font ',8' tc lt {k + 1} notitle"
                      for k, scheme in enumerate(schemes))
    across = suite.load(name).ACROSS
    for terminal, ending in (("pngcairo size 900,600 font ',11'", "png"), ("svg size 900,600 font ',11'", "svg")):
        script = [f"set terminal {terminal}", f"set output '{HERE / name}.{ending}'", "set logscale xy", "set grid lc rgb '#dddddd'",
                  "set xlabel 'core-seconds'", "set ylabel 'error, %'", f"set title '{suite.load(name).TITLE} (numbers: {across})'",
                  "set key outside right", "set linetype 5 lc rgb '#8b4513'", *blocks, f"plot {lines}"]
        subprocess.run(["gnuplot"], input="\n".join(script) + "\n", text=True, check=True)


def tables():
    """Into README.md, between its marks."""
    lines = []
    for name in CASES:
        points = [p for p in recorded() if p["case"] == name]
        if not points:
            continue
        sizes = sorted({int(p["resolution"]) for p in points})
        lines += [f"### {suite.load(name).TITLE}", "", f"![error against core-seconds]({name}.png)", "",
                  "| scheme | " + " | ".join(f"{n} {suite.load(name).ACROSS}" if n == sizes[0] else str(n) for n in sizes) + " |", "|---|" + "---|" * len(sizes)]
        for scheme in dict.fromkeys(p["scheme"] for p in points):
            cells = {int(p["resolution"]): f"{p['error_percent']} %, {p['coreSeconds']} s" for p in points if p["scheme"] == scheme}
            lines.append(f"| {scheme} | " + " | ".join(cells.get(n, "") for n in sizes) + " |")
        lines += ["", f"{points[0]['machine']}, {max(p['date'] for p in points)}.", ""]
    page = HERE / "README.md"
    before, rest = page.read_text().split(suite.MARKS[0])
    page.write_text(before + suite.MARKS[0] + "\n\n" + "\n".join(lines) + suite.MARKS[1] + rest.split(suite.MARKS[1])[1])


if __name__ == "__main__":
    words = sys.argv[1:]
    if words != ["-draw"]:
        ranks = int(words.pop(words.index("-np") + 1)) if "-np" in words else 1
        only = words.pop(words.index("-scheme") + 1) if "-scheme" in words else None
        binaries, directory, *names = [word for word in words if word not in ("-np", "-scheme")]
        for name in names or CASES:
            if name not in CASES:
                sys.exit(f"workPrecision.py: no case '{name}'; there are {', '.join(CASES)}")
            resolutions, schemes = CASES[name]
            for scheme, settings in schemes.items():
                if only in (None, scheme):
                    for n in resolutions:
                        measure(name, scheme, settings, n, pathlib.Path(binaries).resolve(), ranks, pathlib.Path(directory).resolve())
    for name in CASES:
        draw(name)
    tables()
