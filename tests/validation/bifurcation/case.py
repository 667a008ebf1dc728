"""Flow through a vessel that divides into two and joins again, against the network law."""
import math
import pathlib

from suite import Figure, Plot, Run, permitted, relative, rows

HERE = pathlib.Path(__file__).parent
TITLE = "flow through a bifurcation"
ACROSS = "particles across the parent vessel"
RESOLUTIONS = (12, 16, 24)
ALLOWED = {12: 4, 16: 2.25, 24: 1}  # %; 1 % at 24, of second order
BALANCE = {12: 2, 16: 1.2, 24: 0.5}  # %, of sums over particles in slabs

D, NU, RHO = 8.0, 1e-6, 1000.0  # um; m^2/s, kg/m^3: constant/fluid.yaml
RATIOS = (1.0, 0.75)  # of the diameters of the daughters; the first has that of the parent
STRAIGHT = (28.0, 68.0)  # um: length of the straight parts of the daughters, which the extrapolation needs twice
ASIDE, ALONG, PARENT = 8.0, 10.0, 12.0  # um: place of a daughter beside the axis, length of its oblique parts along x, half of the parent
GRADIENT = 4e5  # Pa/m
TIMES, LOOKS = 16, 8  # end over the time in which pressure evens out, looks; the flow is taken from the last two


def name(ratio, straight):
    return f"ratio{ratio:g}-straight{straight:g}"


def lengthOf(straight):
    """Length of a daughter between the joints, um."""
    return straight + 2 * math.hypot(ASIDE, ALONG)


def tubes(ratio, straight):
    half = straight / 2
    joint, end = half + ALONG, half + ALONG + PARENT
    legs = [((-end, 0), (-joint, 0), D)]
    for side, wide in ((1, D), (-1, ratio * D)):
        legs += [((-joint, 0), (-half, side * ASIDE), wide), ((-half, side * ASIDE), (half, side * ASIDE), wide), ((half, side * ASIDE), (joint, 0), wide)]
    legs.append(((joint, 0), (end, 0), D))
    return "[" + ", ".join(f"{{from: [{a[0]:g} um, {a[1]:g} um, 0 um], to: [{b[0]:g} um, {b[1]:g} um, 0 um], diameter: {wide:g} um}}" for a, b, wide in legs) + "]"


def runs(n):
    return [run(ratio, straight, n) for ratio in RATIOS for straight in (STRAIGHT if ratio != 1 else STRAIGHT[:1])]


def run(ratio, straight, n):
    dx, box = D / n, straight + 2 * (ALONG + PARENT)
    # Pressure evens out along the vessel like heat, with the diffusivity c^2 R^2/(8 nu); c^2 is 100 times the drop over the density.
    sound = math.sqrt(100 * GRADIENT * 1e-6 * box / RHO)
    spread = (1e-6 * box) ** 2 * 8 * NU / (sound * 0.5e-6 * D) ** 2 / math.pi**2
    end = TIMES * spread
    section = lambda x, y, width: f"{{type: section, every: {end / LOOKS:.8g} s, centre: [{x:g} um, {y:g} um, 0 um], radius: {0.6 * D:g} um, width: {width:g} um}}"
    return Run(name(ratio, straight), HERE, [
        f"system/numerics.yaml:/spacing={dx:.10g} um",
        f"system/mesh.yaml:/domain/size=[{box:g} um, {2 * ASIDE + D + 2 * dx:.10g} um, {D:g} um]",
        f"system/control.yaml:/endTime={end:.8g} s",
        f"system/observers.yaml:/parent={section(-0.5 * box, 0, PARENT)}",
        f"system/observers.yaml:/first={section(0, ASIDE, 0.7 * straight)}",
        f"system/observers.yaml:/second={section(0, -ASIDE, 0.7 * straight)}",
        f"constant/fluid.yaml:/equationOfState={{type: tait, gamma: 7, soundSpeed: {sound:.6g} m/s}}",
        f"constant/flow.yaml:/pressureDrop={GRADIENT * 1e-6 * box:.8g} Pa",
        f"constant/flow.yaml:/walls/tubes={tubes(ratio, straight)}"],
        ("particleFill", "sphFlow"))


def flows(folder):
    """Flow rates of parent, first and second daughter, mean of the last two looks, m^3/s."""
    of = lambda part: [row["flowRate_m3_s"] for row in rows(folder / f"postProcessing/{part}/section.csv")][-2:]
    return [sum(of(part)) / 2 for part in ("parent", "first", "second")]


def split(folder):
    _, first, second = flows(folder)
    return first / second


def figures(done, n):
    allowed, (short, long) = permitted(ALLOWED, n, 2), map(lengthOf, STRAIGHT)
    ratio = RATIOS[1]
    one, other = (split(done[name(ratio, straight)]) for straight in STRAIGHT)
    found = [relative("flow of equal daughters", split(done[name(1, STRAIGHT[0])]), 1, 0.5),
             relative("flow of the daughters, diameters 0.75 : 1, for long ones", (long * other - short * one) / (long - short), ratio**-4, allowed, order=True)]
    for straight in STRAIGHT:
        parent, first, second = flows(done[name(ratio, straight)])
        found.append(relative(f"flow of both daughters against the parent, {straight:g} um", first + second, parent, BALANCE[n], order=True))
    return found


def curves(done):
    ratio = RATIOS[1]
    found = [(1 / lengthOf(straight), split(done[name(ratio, straight)])) for straight in STRAIGHT]
    return Plot("1/length of the daughters, 1/um", "ratio of the flows of the daughters", [("0.75 : 1", *map(list, zip(*found)))],
                [("network law", [0, 0.02], [ratio**-4] * 2)], ["set xrange [0:0.02]", "set yrange [2.9:3.3]"])
