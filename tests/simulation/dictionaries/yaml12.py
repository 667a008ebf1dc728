"""PyYAML with the types of YAML 1.2's core schema, which editors use: "1e-3" is a number, "yes" a word, "0x10" is 16."""
import math
import re

import yaml


class Loader(yaml.SafeLoader):
    yaml_implicit_resolvers = {}


def add(tag, pattern, first):
    Loader.add_implicit_resolver("tag:yaml.org,2002:" + tag, re.compile(rf"(?:{pattern})\Z"), first)


add("null", "~|null|Null|NULL|", ["~", "n", "N", ""])
add("bool", "true|True|TRUE|false|False|FALSE", list("tTfF"))
add("int", "[-+]?[0-9]+|0o[0-7]+|0x[0-9a-fA-F]+", list("-+0123456789"))
add("float", r"[-+]?(?:\.[0-9]+|[0-9]+(?:\.[0-9]*)?)(?:[eE][-+]?[0-9]+)?|[-+]?\.(?:inf|Inf|INF)|\.(?:nan|NaN|NAN)", list("-+.0123456789"))


def whole(loader, node):
    text = node.value
    return int(text[2:], {"o": 8, "x": 16}[text[1]]) if text[:2] in ("0o", "0x") else int(text)


def real(loader, node):
    text = node.value.lower()
    if text.endswith(".inf"):
        return -math.inf if text[0] == "-" else math.inf
    return math.nan if text == ".nan" else float(text)


def table(loader, node):
    """A table whose keys are text, whatever they look like, and occur only once."""
    pairs = [(loader.construct_object(value, deep=True), key.value) for key, value in node.value]
    if len({key for _, key in pairs}) != len(pairs):
        raise yaml.YAMLError("a key stands twice")
    return {key: value for value, key in pairs}


Loader.add_constructor("tag:yaml.org,2002:int", whole)
Loader.add_constructor("tag:yaml.org,2002:float", real)
Loader.add_constructor("tag:yaml.org,2002:bool", lambda loader, node: node.value.lower() == "true")
Loader.add_constructor("tag:yaml.org,2002:map", table)


def load(text):
    value = yaml.load(text, Loader)
    return {} if value is None else value


def compose(text):
    return yaml.compose(text, Loader)
