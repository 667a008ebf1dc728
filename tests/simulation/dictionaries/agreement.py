"""The JSON schemas accept what the reader accepts: on mutated dictionaries of the repository, and on generated quantities.

    python3 agreement.py SOURCE READER [SEED]      READER: readDictionaries

What the schema rejects, the reader rejects. What only the reader rejects is covered by a rule of READER_ONLY. Values have the types of YAML 1.2.
"""
import pathlib
import random
import re
import sys
import tempfile

import yaml

import yaml12
from reader import Reader, Schemas
from repositoryFiles import dictionaries, kind

# Rules that a schema cannot express: between keys, on lengths of lists, and on text that YAML has already converted to a number.
READER_ONLY = [re.compile(p) for p in (
    r"only decimal numbers are read",                          # 0x10 and 0o17 are 16 and 15 to YAML
    r"not a finite number",                                    # .nan
    r"beyond what can be computed with",                       # 1e-101, for a key that allows both signs
    r"'1e-400' is not a whole number",                         # to YAML it is 0, a whole number
    r"stands twice|a blank is missing after",                  # faults of the text, found before it is parsed
    r"that of 'cell'",                                         # of a ready cell, which is inserted before a case is read
    r"(write|expected) FILE:/path",                            # the form of a text, of keys of a study
    r"has no law that resists shear", r"the zero vector", r"needs at least one value", r"an even number", r"all zero",
    r"more than one of|give either size|a rectangle has two|too coarse for this sheet|no particles here",
    r"local.*global|thickness|write held|through the glass",
)]
VALUES = ("8 um", "8", "8.5", "-1", "0", "-8 um", "0 um", "1e400", "1e-400", "1e-3", "1e3", "1.5", "+2", "08", ".5", "2.", "[1, 2, 3]", "[1 um, 2 um, 3 um]",
          "[1 um, 2 um]", "[]", "{}", "{a: 1}", "{type: lucy}", "none", "auto", "never", "all", "true", "True", "yes", "null", "~", '""', "'8 um'", "'0.5'",
          '"true"', "8 uM", "100 steps", "0 steps", "1.5 steps", "0.1 strain", "3 dx", "-3 dx", "5 min", "1/s", "10 1/s", "1 kg/m^3", "1e-3 Pa s", "1 cP",
          "5 uN/m", "5 dyn/cm", "1 pN", "1e-19 J", "10 mm/s", "1e-3 m/s^2", "x", "z", "shear", "harmonic", "latestTime", "1.2 ms", "[true, true, false]",
          "[velocity]", "[speed]", "0x10", "0o17", ".nan", ".inf", "-.inf", "nan", "inf", "1_000", "12:30:00", "2026-11-25", "rbc", "1a", "no", "a b")
KEYS = ("type", "k", "Gs", "edge", "every", "size", "unknown", "Ca", "shearRate", "none", "true", "1a", "a b", "a:b", "no", "name")


def scalar(node):
    if node.style or any(c in node.value for c in ",[]{}") or node.value[:1] in "#&*!|>@`%'\"":
        return '"' + node.value.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n") + '"'
    return node.value


def text_of(node):
    """One line of YAML; a mutated node may hold text that is used unchanged."""
    if isinstance(node, str):
        return node
    if isinstance(node, yaml.ScalarNode):
        return scalar(node)
    if isinstance(node, yaml.SequenceNode):
        return "[" + ", ".join(map(text_of, node.value)) + "]"
    return "{" + ", ".join(f"{text_of(k)}: {text_of(v)}" for k, v in node.value) + "}"


def places(node):
    """All (container, index): of a table the index of the pair, of a list that of the item."""
    if isinstance(node, (yaml.MappingNode, yaml.SequenceNode)):
        for i, child in enumerate(node.value):
            yield node, i
            yield from places(child[1] if isinstance(node, yaml.MappingNode) else child)


def values_by_key(texts):
    """All values of each key anywhere, as text."""
    values = {}

    def collect(node):
        if isinstance(node, yaml.MappingNode):
            for key, value in node.value:
                values.setdefault(key.value, []).append(text_of(value))
                collect(value)
        elif isinstance(node, yaml.SequenceNode):
            for item in node.value:
                collect(item)
    for text in texts:
        collect(yaml12.compose(text))
    return values


def mutated(text, rng, values):
    root = yaml12.compose(text)
    all_places = list(places(root)) if root else []
    if not all_places:
        return text
    for _ in range(rng.choice((1, 1, 1, 2))):
        node, i = rng.choice(all_places)
        if i >= len(node.value):
            continue
        if isinstance(node, yaml.SequenceNode):
            change = rng.randrange(3)
            if change == 0:
                del node.value[i]
            elif change == 1:
                node.value.insert(i, node.value[i])
            else:
                node.value[i] = rng.choice(VALUES)
            continue
        key, value = node.value[i]
        change = rng.randrange(12)
        if change > 7:
            node.value[i] = (key, rng.choice(values[key.value] if isinstance(key, yaml.ScalarNode) and key.value in values else VALUES))
        elif change == 0:
            del node.value[i]
        elif change == 1:
            node.value.append((rng.choice(KEYS), rng.choice(VALUES)))
        elif change == 2:
            name = text_of(key)
            node.value[i] = (rng.choice((name.capitalize(), name.lower(), name[:-1] or "x", name + "s", rng.choice(KEYS))), value)
        else:
            node.value[i] = (key, rng.choice(VALUES))
    return text_of(root)


SHEET = "{a: {bonds: {type: harmonic, k: 1 N/m}, "
# A place for a quantity of each dimension: file, text with % for the quantity, valid units.
PLACES = [
    ("system/numerics.yaml", "spacing: %", "um|nm|mm|m|cm|\u00b5m|\u03bcm|pm|km"),
    ("constant/fluid.yaml", "{density: 1 kg/m^3, viscosity: 1 Pa s, layers: [{above: %, viscosity: 1 cP}]}", "um|mm|m|nm"),
    ("system/mesh.yaml", "{domain: {size: [1 um, 1 um, 1 um], periodic: [true, true, true]}, cells: [{name: a, shape: {type: sphere, radius: 1 um}, edge: %}]}",
     "um|nm|dx|m"),
    ("system/control.yaml", "{application: dmpFlow, endTime: %}", "s|ms|us|min|h|ns|\u00b5s"),
    ("system/control.yaml", "{application: dmpFlow, endTime: 1 s, startFrom: %}", "s|ms|us"),
    ("system/control.yaml", "{application: dmpFlow, endTime: 1 s, stop: {wallClock: %}}", "s|h|min"),
    ("system/observers.yaml", "a: {type: shape, every: %}", "s|ms|strain|steps|step|min|us"),
    ("constant/flow.yaml", "{type: shear, shearRate: %}", "1/s|1/min|s^-1|Hz|kHz|1/ms|rad/s|s\u207b\u00b9|1 / s|ms^-1"),
    ("constant/flow.yaml", "{type: poiseuille, bodyForce: %}", "m/s^2|mm/s^2|m s^-2|m/s\u00b2|N/kg|um/ms^2|m*s^-2"),
    ("constant/flow.yaml", "{type: taylorGreen, speed: %}", "m/s|mm/s|um/s|m s^-1|cm/s|um/ms|m\u00b7s\u207b\u00b9|m/min"),
    ("constant/fluid.yaml", "{density: %, viscosity: 1 Pa s}", "kg/m^3|g/cm^3|g/mL|kg m^-3|g/l|kg/m\u00b3|pg/um^3|g.cm^-3|kg/L"),
    ("constant/fluid.yaml", "{density: 1 kg/m^3, viscosity: %}",
     "Pa s|mPa s|cP|P|mPa.s|mPa*s|Pa\u00b7s|N s/m^2|kg/m/s|g/cm/s|dyn s/cm^2|kg m^-1 s^-1|mPa ms|uPa s|bar s|mmHg s|N*s*m^-2"),
    ("constant/membranes.yaml", "{a: {bonds: {type: harmonic, k: %}}}", "N/m|uN/m|pN/um|dyn/cm|mdyn/cm|J/m^2|N m^-1|kg/s^2|pN/nm|mN.m^-1|erg/cm^2|Pa m"),
    ("constant/membranes.yaml", SHEET + "volume: {modulus: %}}}", "Pa|kPa|bar|mbar|mmHg|mmH2O|cmH2O|dyn/cm^2|N/m^2|pN/um^2|J/m^3|N m^-2|kg/m/s^2|N/m\u00b2"),
    ("constant/membranes.yaml", SHEET + "volume: {modulus: 1 Pa, rest: %}}}", "um^3|fL|pL|m^3|fl|mL|\u00b5m\u00b3|mm^3|L"),
    ("constant/membranes.yaml", SHEET + "area: {local: 1 N/m, rest: %}}}", "um^2|m^2|nm^2|\u00b5m\u00b2|cm^2"),
    ("constant/membranes.yaml", SHEET + "viscosity: {shear: %}}}", "N s/m|uN s/m|Pa s m|P m|kg/s|dyn s/cm|pN s/um|N*s/m|cP um|N s m^-1|g/s"),
    ("constant/membranes.yaml", SHEET + "bending: {type: dihedral, kappa: %}}}", "J|aJ|pN nm|pN um|N m|N m/rad|erg|kg m^2/s^2|fJ|N*m|J/rad^2|N m/rad^2|pN.nm|N m rad^-1"),
    ("constant/membranes.yaml", SHEET + "bending: {type: helfrich, kappa: 1 J, spontaneousCurvature: %}}}", "1/m|1/um|um^-1|1/\u00b5m|nm^-1"),
    ("system/relax.yaml", "{cell: {name: a, shape: {type: sphere, radius: 1 um}, edge: 1 um}, protocol: resting, forceScale: %}", "pN|nN|N|dyn|uN|kg m/s^2|g*um/ms^2"),
    ("constant/flow.yaml", "{type: shear, Ca: %}", ""),
    ("constant/membranes.yaml", SHEET + "bending: {type: helfrich, kappa: 1 J, areaDifference: {ratio: 1, reduced: %}}}}", ""),
    ("system/control.yaml", "{application: dmpFlow, endTime: 1 s, checkpoint: {keep: %}}", ""),
    ("system/numerics.yaml", "{spacing: 1 um, densityBalance: %}", ""),
]
NUMBERS = ("8", "8.5", "+3", "-3", "0", "0.0", "-0.5", ".5", "2.", "1e-3", "1E3", "1.5e+3", "1e99", "1e100", "1e-101", "1e400", "0e5", "012", "1e", "1e1.5", "--1",
           "1 000", "1,5", "", "e5", "1e0003", "\u22121", "0x1", "1/3", "nan", "inf", "1.2.3", "100", "1e2")
FACTORS = ("m", "s", "kg", "g", "N", "dyn", "Pa", "bar", "P", "J", "erg", "Hz", "W", "L", "l", "mmHg", "min", "h", "rad", "deg", "um", "ms", "mPa", "pN", "km2", "mm",
           "1", "dx", "um^3", "s^2", "s^-1", "m^-3", "m^2", "m\u00b2", "parsec", "M", "S", "kmin", "mdeg", "cmH2O", "s^0", "m^1", "s^-0", "^2", "m^")


def quantity(units, rng):
    number = rng.choice(NUMBERS) if rng.random() < 0.5 else rng.choice(NUMBERS[:13])
    if not units and rng.random() < 0.7:
        return number
    if rng.random() < 0.5 or not units:
        unit = rng.choice(units) if units and rng.random() < 0.9 else rng.choice(("", *FACTORS))
    else:
        unit = rng.choice(FACTORS)
        for _ in range(rng.randrange(4)):
            unit += rng.choice((" ", "*", "/", ".", "\u00b7", " / ", " * ", "  ", "//", "-", ". ")) + rng.choice(FACTORS)
        if units and rng.random() < 0.4:
            unit = rng.choice(units) + rng.choice(("/s s", " m/m", "^1", "^2", " ", "s", "", "\u00b2", "/", " .", "^-1"))
    return number + rng.choice((" ", " ", " ", " ", "", "  ", "*")) + unit


def in_yaml(text, rng):
    if text.strip() and rng.random() < 0.7 and not re.search(r"[,\[\]{}#&*!|>'\"%@`]|: |^[-?] |^ | $|^-+$", text):
        return text
    return '"' + text + '"'


class Comparison:
    def __init__(self, reader, schemas):
        self.reader, self.schemas, self.faults, self.accepted, self.refused = reader, schemas, [], 0, 0

    def compare(self, file, text):
        try:
            data = yaml12.load(text)
        except (yaml.YAMLError, ValueError):
            return None
        problems, faults = self.reader.problems(file, text), self.schemas.faults(file, data)
        if not problems:
            self.accepted += 1
        else:
            self.refused += 1
        if not problems and faults:
            self.faults.append(f"{file}: only the schema refuses\n  {text}\n  {faults}")
        elif problems and not faults and not all(any(rule.search(p) for rule in READER_ONLY) for p in problems):
            self.faults.append(f"{file}: only the reader refuses\n  {text}\n  {problems}")
        return not problems


def main():
    source, program, rng = pathlib.Path(sys.argv[1]), sys.argv[2], random.Random(int(sys.argv[3]) if len(sys.argv) > 3 else 29)
    files = [(kind(f), (source / f).read_text()) for f in dictionaries(source)]
    with tempfile.TemporaryDirectory() as folder:
        reader = Reader(program, folder)
        reader.problems("system/observers.yaml", "")
        comparison = Comparison(reader, Schemas(folder))
        values = values_by_key(text for _, text in files)
        for _ in range(1500):
            file, text = rng.choice(files)
            comparison.compare(file, mutated(text, rng, values))
        mutants = f"{comparison.accepted} mutants accepted, {comparison.refused} refused"
        enough = comparison.accepted > 150 and comparison.refused > 500
        for file, place, units in PLACES:
            accepted = 0
            for _ in range(150):
                accepted += comparison.compare(file, place.replace("%", in_yaml(quantity(units.split("|") if units else [], rng), rng))) or 0
            for unit in units.split("|") if units else []:  # the reader accepts each listed unit
                if not comparison.compare(file, place.replace("%", "2 " + unit)):
                    comparison.faults.append(f"{file}: '2 {unit}' is refused: {reader.problems(file, place.replace('%', '2 ' + unit))}")
            enough = enough and accepted >= 15
            if accepted < 15:
                print(f"only {accepted} quantities accepted in {place}")
        reader.close()
    print("\n".join(comparison.faults[:30] + [mutants, f"{comparison.accepted + comparison.refused} texts, {len(comparison.faults)} faults"]))
    return 1 if comparison.faults or not enough else 0


if __name__ == "__main__":
    sys.exit(main())
