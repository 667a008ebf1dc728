"""Scenes of the stability map, and the runs of them in the order in which they are made.

A scene is a tutorial's case made small: cells of radius 4 um, 4 particles along it, in a box of 6 x 3 x 4 radii; a run changes it by settings
FILE:/path=value. Every run is compared with its twin, the same run with a finer step.
"""
from dataclasses import dataclass, field

NUMERICS, MESH, FLOW, FLUID, MEMBRANES, CONTROL = (f"{file}.yaml:/" for file in (
    "system/numerics", "system/mesh", "constant/flow", "constant/fluid", "constant/membranes", "system/control"))
RADIUS, VISCOSITY, RATE = 4e-6, 1e-3, 1e3  # m; Pa s; 1/s, of the box
BOX = (6, 3, 4)  # radii: along the flow, the vorticity, across the gap
STEPS = (0.0125, 0.02, 0.05, 0.1, 0.2, 0.5)  # strains of one implicit step; the first is the twin
FINEST = 0.005  # on the coarse grid besides
ADJOINT_BULK = 500  # bulk modulus over mu gammadot of 'soundSpeed: auto' with adjoint operators
TWIN_STEP, BASE_STEP = STEPS[0], 0.05  # for runs that change one parameter
TIMES = (0.5, 0.7, 0.9, 1.0, 1.1, 1.25, 1.5)  # of a limit of the explicit step, without `safety`; the first is the twin

# tutorial, its cell, Ca, Eb; files that replace those of the tutorial
SCENES = {
    "box": ("couette", None, None, None),
    "capsule": ("capsuleShear", "capsule", 0.3, 0.005),
    "redCell": ("rbcShear/Ca0.02", "rbc", 0.1, 0.01),
}
BOX_FILES = {
    "system/control.yaml": "application: sphFlow\nendStrain: 1\n",
    "constant/flow.yaml": f"type: shear\nshearRate: {RATE:g} 1/s\nwalls: {{normal: z}}\n",
}
# couplings and operators of the explicit schemes
EXPLICIT = {
    "velocityVerlet immersed": ("velocityVerlet", "corrected", "immersed", "{type: wendlandC2, support: 2.4 dx}", "{coefficient: 1}"),
    "velocityVerlet dualIdentity": ("velocityVerlet", "plain", "dualIdentity", "{type: wendlandC2, support: 3 dx}", "none"),
    "velocityVerlet corrected": ("velocityVerlet", "corrected", None, "{type: wendlandC2, support: 2.4 dx}", "{coefficient: 1}"),
    "velocityVerlet plain": ("velocityVerlet", "plain", None, "{type: wendlandC2, support: 3 dx}", "none"),
    "rkl2": ("rkl2", "plain", None, "{type: wendlandC2, support: 3 dx}", "none"),
}


@dataclass
class Run:
    name: str
    group: str  # map to which it belongs
    scene: str
    scheme: str
    settings: list
    axis: str = ""  # the parameter that it changes, and the value; empty: the unchanged scene
    value: str = ""
    Ca: float | None = None
    Re: float | None = None
    ratio: float | None = None  # of viscosities
    step: float | None = None  # strain of an implicit step
    limit: str = ""  # of the explicit step, and how many times it
    times: float | None = None
    twin: str = ""
    ranks: int = 1
    stage: int = 0
    options: list = field(default_factory=list)  # of the program


def number(value):
    return f"{value:g}"


def plain(text):
    return "".join(c for c in text if c.isalnum() or c in ".-")


def observers(run):
    """Text of system/observers.yaml, with at least eight observations."""
    (strain,) = (float(text.split("=")[1]) for text in run.settings if text.startswith(CONTROL + "endStrain="))
    kinds = {"balance": "conservation", "wall": "wallStress", **({"deformation": "shape"} if SCENES[run.scene][1] else {})}
    return "".join(f"{name}: {{type: {kind}, every: {min(0.05, strain / 8):g} strain}}\n" for name, kind in kinds.items())


def sceneSettings(scene, Ca, Re, ratio, strain, perRadius=4, box=BOX):
    """Settings that every run of a scene has."""
    _, cell, _, _ = SCENES[scene]
    dx = 4 / perRadius  # um
    settings = [NUMERICS + f"spacing={dx:.8g} um", CONTROL + f"endStrain={strain:g}", CONTROL + "checkpoint={wallClock: never}",
                MESH + "domain/size=[" + ", ".join(f"{4 * length:g} um" for length in box) + "]"]
    if cell:
        settings += [CONTROL + "write={}", CONTROL + "stop={}", MESH + f"cells/0/edge={dx:.8g} um", FLOW + f"Ca={Ca:g}", FLOW + f"inertia={{Re: {Re:g}}}",
                     MEMBRANES + f"{cell}/interior/viscosityRatio={ratio:g}", FLUID + "equationOfState={type: linear}"]
    else:
        settings += [CONTROL + f"write={{strain: {strain:g}}}", FLUID + f"density={Re * VISCOSITY / (RATE * RADIUS**2):.8g} kg/m^3", MESH + "fill/jitter=0.1"]
    return settings


def implicit(scene, step, Ca=None, Re=0.01, ratio=1.0, strain=2, more=(), group="one", axis="", value="", stage=0, twinStep=TWIN_STEP, ranks=1,
             perRadius=4, keys="error: 1, tolerance: 3e-3"):
    cell = SCENES[scene][1]
    Ca = SCENES[scene][2] if cell and Ca is None else Ca
    settings = [*sceneSettings(scene, Ca, Re, ratio, strain, perRadius), NUMERICS + "integrator=implicit", NUMERICS + "operators=corrected", NUMERICS + "precision=mixed",
                NUMERICS + "kernel={type: wendlandC2, support: 2.4 dx}", NUMERICS + "shifting={coefficient: 1}",
                *([NUMERICS + "coupling=immersed"] if cell else []), NUMERICS + f"implicit={{step: {step:g}, {keys}}}", *more]
    def named(step):
        words = [scene, "implicit", *([f"Ca{Ca:g}"] if cell else []), f"Re{Re:g}", *([f"lambda{ratio:g}"] if cell else []),
                 *([plain(axis), plain(value)] if axis else []), f"step{step:g}"]
        return "-".join(words)
    return Run(named(step), group, scene, "implicit", settings, axis, value, Ca, Re, ratio if cell else None, step, "", None,
               "" if step == twinStep else named(twinStep), ranks, stage)


def explicit(scene, scheme, limit, times, Ca=None, Re=0.1, ratio=1.0, strain=0.5, more=(), group="limits", axis="", value="", stage=0, ranks=1, perRadius=4,
             box=(4, 3, 3), twinTimes=0.5):
    cell = SCENES[scene][1]
    Ca = SCENES[scene][2] if cell and Ca is None else Ca
    integrator, operators, coupling, kernel, shifting = EXPLICIT[scheme]
    settings = [*sceneSettings(scene, Ca, Re, ratio, strain, perRadius, box), NUMERICS + f"integrator={integrator}", NUMERICS + f"operators={operators}",
                NUMERICS + f"kernel={kernel}", NUMERICS + f"shifting={shifting}", NUMERICS + "implicit={}", NUMERICS + "precision=mixed", NUMERICS + "safety=1",
                *([NUMERICS + f"coupling={coupling}"] if coupling else []), *more]
    def named(times):
        words = [scene, scheme.replace(" ", "-"), *([f"Ca{Ca:g}"] if cell else []), f"Re{Re:g}", *([f"lambda{ratio:g}"] if cell and ratio != 1 else []),
                 *([plain(axis), plain(value)] if axis else []), limit.replace(" ", ""), f"x{times:g}"]
        return "-".join(words)
    return Run(named(times), group, scene, scheme, settings, axis, value, Ca, Re, ratio if cell else None, None, limit, times,
               "" if times == twinTimes else named(twinTimes), ranks, stage, ["-limit", limit, "-times", f"{times:g}"])


def soundSpeed(scene, Ca, Re, times, box, adjoint=True):
    """Sound speed [m/s] for `times` the bulk modulus that `soundSpeed: auto` means (libs/simulation/case.cpp)."""
    gs = {"capsule": 1e-5, "redCell": 3**0.5 / 4 * 5e-4, "box": 0}[scene]
    rate = Ca * gs / (VISCOSITY * RADIUS) if gs else RATE
    nu, gap = rate * RADIUS**2 / Re, box[2] * RADIUS
    speed = rate * gap / 2
    return (times * max(100 * speed**2, ADJOINT_BULK * nu * rate if adjoint else 100 * nu * speed / gap))**0.5


def stiffer(scene, Ca, Eb, bonds, bending):
    """Settings that multiply the stiffness of bonds (of the capsule's sheet) and of bending by these factors, at the same shear rate."""
    cell = SCENES[scene][1]
    law = {"capsule": f"triangles/Gs={1e-5 * bonds:g} N/m", "redCell": f"bonds/k={5e-4 * bonds:g} N/m"}[scene]
    return [MEMBRANES + f"{cell}/{law}", MEMBRANES + f"{cell}/bending/Eb={Eb * bending / bonds:g}", FLOW + f"Ca={Ca / bonds:g}"]


def changes(scene, explicitScheme):
    """Axis, value and settings of the runs that change one parameter; `perRadius` or `ranks` are set where that is the parameter."""
    _, cell, Ca, Eb = SCENES[scene]
    Re, box = (0.1, (4, 3, 3)) if explicitScheme else (0.01, BOX)
    for times in (0.1, 10, 100):
        speed = soundSpeed(scene, Ca, Re, times, box)
        yield "bulk modulus", number(times), [FLUID + f"equationOfState={{type: linear, soundSpeed: {speed:.6g} m/s}}"], {}
    if cell:
        for times in (0.1, 10, 100):
            yield "bonds", number(times), stiffer(scene, Ca, Eb, times, 1), {}
            yield "bending", number(times), stiffer(scene, Ca, Eb, 1, times), {}
        law = {"capsule": "{type: arealStrain, limit: 0.05}", "redCell": "{type: bondStretch, limit: 1.05}"}[scene]
        yield "rupture", "on", [MEMBRANES + f"{cell}/rupture={law}", FLOW + "Ca=2"], {}
        yield "rupture", "off", [FLOW + "Ca=2"], {}
        for edge in (0.7, 1.5) if scene == "capsule" else (0.7, 1.2):
            yield "edge", f"{edge:g} dx", [MESH + f"cells/0/edge={edge:g} um"], {}
    for jitter in (0, 0.2, 0.3):
        yield "jitter", number(jitter), [MESH + f"fill/jitter={jitter:g}"], {}
    for n in (5, 6) if scene == "redCell" else (3, 6):  # 3 are too few for the rim of a red cell's dimple
        yield "resolution", number(n), [], {"perRadius": n}
    for kernel in ("{type: lucy, support: 2.6 dx}", "{type: quintic, support: 2.8 dx}", "{type: wendlandC2, support: 3 dx}",
                   "{type: wendlandC2, support: 2 dx}"):
        yield "kernel", kernel.split("type: ")[1].rstrip("}").replace(", support: ", " "), [NUMERICS + f"kernel={kernel}"], {}
    yield "ranks", "2", [], {"ranks": 2}
    for coefficient in (0.1, 0.3, 3):
        yield "shifting", number(coefficient), [NUMERICS + f"shifting={{coefficient: {coefficient:g}}}"], {}
    yield "operators", "plain", [NUMERICS + "operators=plain"], {}
    yield "shifting", "none, plain operators", [NUMERICS + "operators=plain", NUMERICS + "shifting=none"], {}
    yield "precision", "double", [NUMERICS + "precision=double"], {}


def implicitFactorial():
    """Ca x Re x step, and the viscosity ratio with Ca and step: coarse first."""
    for scene in ("capsule", "redCell"):
        for Ca in (1e-3, 1e-2, 0.1, 1, 10):
            for Re in (1e-4, 1e-3, 1e-2, 0.1, 1):
                coarse = Ca in (1e-3, 0.1, 10) and Re in (1e-4, 1e-2, 1)
                for step in ((FINEST,) if coarse else ()) + STEPS:
                    stage = 1 if coarse and step in (TWIN_STEP, BASE_STEP, 0.2) else 4 if Re in (1e-4, 1e-2, 1) else 6
                    yield implicit(scene, step, Ca, Re, group="implicit", stage=stage)
        for ratio in (0.2, 5, 50):
            for Ca in (1e-3, 0.1, 10):
                for Re in (1e-4, 0.01, 1):
                    for step in (TWIN_STEP, BASE_STEP, 0.2):
                        yield implicit(scene, step, Ca, Re, ratio, group="ratio", stage=3 if Re == 0.01 else 5)
        for step in (TWIN_STEP, BASE_STEP, 0.2):  # 0.2 is beyond the declared safe range
            for Ca, Re, ratio in ((1e-5, 0.01, 1), (1e-4, 0.01, 1), (100, 0.01, 1), (0.1, 1e-6, 1), (0.1, 1e-5, 1), (0.1, 10, 1), (0.1, 100, 1), (0.1, 0.01, 0.02), (0.1, 0.01, 200)):
                yield implicit(scene, step, Ca, Re, ratio, group="edge", stage=5)
    for Re in (1e-6, 1e-4, 1e-2, 1, 10, 100):
        for step in STEPS:
            yield implicit("box", step, Re=Re, group="implicit", stage=1)


def implicitChanges():
    for scene in SCENES:
        for step in (TWIN_STEP, BASE_STEP):
            yield implicit(scene, step, stage=2)
            for axis, value, more, options in changes(scene, False):
                yield implicit(scene, step, more=more, axis=axis, value=value, stage=2, **options)
            if SCENES[scene][1]:
                for preconditioner in ("twoLevel", "withMembrane", "blockJacobi"):
                    yield implicit(scene, step, axis="preconditioner", value=preconditioner, stage=2, keys=f"error: 1, tolerance: 3e-3, preconditioner: {preconditioner}")
            for method in ("backwardEuler",):
                yield implicit(scene, step, axis="method", value=method, stage=2, keys=f"error: 1, tolerance: 3e-3, method: {method}")
            for tolerance in ("0.1", "0.01", "1e-5"):
                yield implicit(scene, step, axis="tolerance", value=tolerance, stage=2, keys=f"error: 1, tolerance: {tolerance}")
    for scene in ("capsule", "redCell"):  # as in a case by default: the error of the positions sets the step
        for Ca in (1e-3, 0.1, 10):
            for step in (0.2, 0.5):
                yield implicit(scene, step, Ca, axis="error", value="1e-3", stage=2, keys="tolerance: 3e-3")
            yield implicit(scene, TWIN_STEP, Ca, axis="error", value="1e-3", stage=2, keys="tolerance: 3e-3")


def explicitScenes():
    """Scheme, the limit in units of which the step is given, and the properties of the scene."""
    for scheme in ("velocityVerlet plain", "velocityVerlet corrected"):
        speed = soundSpeed("box", None, 1, 16, (4, 3, 3), "corrected" in scheme)
        yield "box", scheme, "viscous", {}
        yield "box", scheme, "acoustic", {"Re": 1, "more": [FLUID + f"equationOfState={{type: linear, soundSpeed: {speed:.6g} m/s}}"], "axis": "bulk modulus", "value": "16", "strain": 0.3}
    yield "box", "rkl2", "acoustic", {"strain": 0.5}
    for scheme in ("velocityVerlet immersed", "velocityVerlet dualIdentity"):
        dual = "dual" in scheme
        for scene in ("capsule", "redCell"):
            cell = SCENES[scene][1]
            yield scene, scheme, "least", {}
            yield scene, scheme, "least", {"Ca": 0.02, "strain": 0.3}
            yield scene, scheme, "least", {"Ca": 1e-3, "Re": 1, "strain": 0.2}
            yield scene, scheme, "least", {"Ca": 10, "Re": 1}
            if not dual:
                yield scene, scheme, "least", {"ratio": 50, "strain": 0.04}
                yield scene, scheme, "least", {"ratio": 200, "strain": 0.01}
            yield scene, scheme, "least", {"ratio": 5 if dual else 0.2, "strain": 0.2}
            law = {"capsule": "{type: arealStrain, limit: 0.05}", "redCell": "{type: bondStretch, limit: 1.05}"}[scene]
            yield scene, scheme, "least", {"Ca": 2, "more": [MEMBRANES + f"{cell}/rupture={law}"], "axis": "rupture", "value": "on"}
            # limits that are not the least: the acoustic one has a reserve
            yield scene, scheme, "spring", {"Ca": 0.02, "strain": 0.3}
            if not dual:  # with nodes as particles half the spring limit is there 2.7 times the acoustic one
                yield scene, scheme, "spring", {"Ca": 1e-3, "Re": 1, "strain": 0.2}
                yield scene, scheme, "viscous", {}
            # of the membrane, in mu a: 2
            yield scene, scheme, "membrane viscosity", {"more": [MEMBRANES + f"{cell}/viscosity={{shear: 8e-9 N s/m}}"], "axis": "membrane viscosity", "value": "2",
                                           "strain": 0.05 if dual else 0.2}


def explicitRuns():
    for scene, scheme, limit, options in explicitScenes():
        for times in (*TIMES, *((2, 4, 8) if limit in ("acoustic", "least") else ())):
            yield explicit(scene, scheme, limit, times, stage=1 if times in (0.5, 0.9, 1.1) else 4, **options)
    for scene in SCENES:
        scheme = "velocityVerlet immersed" if SCENES[scene][1] else "velocityVerlet corrected"
        for axis, value, more, options in changes(scene, True):
            for times in (0.5, 0.9):
                yield explicit(scene, scheme, "least", times, more=more, axis=axis, value=value, strain=0.3, group="one", stage=3, **options)


def everyRun():
    """All runs, coarse first; twins before what is compared with them."""
    found = {}
    for run in (*implicitFactorial(), *implicitChanges(), *explicitRuns()):
        found.setdefault(run.name, run)
    for run in list(found.values()):
        if run.twin:
            twin = found[run.twin]
            twin.stage = min(twin.stage, run.stage)
    return sorted(found.values(), key=lambda run: (run.stage, bool(run.twin)))


if __name__ == "__main__":
    runs = everyRun()
    for stage in sorted({run.stage for run in runs}):
        print(stage, sum(run.stage == stage for run in runs))
    print(len(runs))
