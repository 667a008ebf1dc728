"""The command line of programs in Python, with the options, messages and exit codes of the others (docs/core.md)."""
import dataclasses
import difflib
import json
import sys
import textwrap

DONE, USAGE, CASE, IO = 0, 1, 2, 4


class UsageError(ValueError):
    """A wrong command line."""


@dataclasses.dataclass
class Usage:
    """options: (name, argument, text); a name with an argument takes a value, which may be given several times."""

    name: str
    text: str
    options: list
    samples: list

    COMMON = [("case", "DIR", "The case directory (default: the current one)."), ("quiet", "", "Only warnings and errors on the terminal."),
              ("json", "", "The result, or the problems, as JSON on standard output."), ("help", "", "Show this text."),
              ("version", "", "Show the version and how it was built.")]

    def parse(self, words):
        """{name: [values]} of the options that are there."""
        known = {name: argument for name, argument, _ in self.options + self.COMMON}
        found, words = {}, list(words)
        while words:
            word = words.pop(0)
            if not word.startswith("-"):
                raise UsageError(f"unexpected argument '{word}'")
            name = word[1:]
            if name not in known:
                near = difflib.get_close_matches(name, known, 1)
                hint = f" Did you mean '-{near[0]}'?" if near else ""
                raise UsageError(f"unknown option '{word}'.{hint} Options: {' '.join('-' + one for one in known)}")
            if known[name] and not words:
                raise UsageError(f"option -{name} needs its value, {known[name]}")
            found.setdefault(name, []).append(words.pop(0) if known[name] else True)
        return found

    def help(self):
        rows = [(f"-{name}{' ' + argument if argument else ''}", text) for name, argument, text in self.options + self.COMMON]
        width = max(len(first) for first, _ in rows)
        lines = [textwrap.fill(text, 118, initial_indent=f"  {first:{width}}  ", subsequent_indent=" " * (width + 4)) for first, text in rows]
        samples = "\n".join(f"  {one}" for one in self.samples)
        return (f"{self.name}: {self.text}\n\nUsage: {self.name} [options]\n\n" + "\n".join(lines) + f"\n\nSample runs:\n{samples}\n\n"
                "Exit codes: 0 done, 1 wrong usage, 2 invalid case, 3 numerics failed, 4 reading or writing failed, 5 stopped early.")

    def json(self):
        options = [{"name": name, "argument": argument, "text": text} for name, argument, text in self.options + self.COMMON]
        return json.dumps({"name": self.name, "text": self.text, "arguments": [], "optionalArguments": 0, "options": options, "samples": self.samples}, indent=2)

    def run(self, words, work, version):
        """Runs work(options), which returns what -json prints, and returns the exit code. ValueError: an invalid case; OSError: reading or writing
        failed. version: a function that returns the line of -version."""
        try:
            options = self.parse(words)
        except UsageError as error:
            print(f"{self.name}: {error}. See {self.name} -help", file=sys.stderr)
            return USAGE
        asJson = "json" in options
        if "help" in options:
            print(self.json() if asJson else self.help())
            return DONE
        try:
            if "version" in options:
                print(version())
                return DONE
            result = work(options)
        except UsageError as error:
            return self._fail(f"{error}. See {self.name} -help", USAGE, asJson)
        except (ValueError, OSError, ImportError, RuntimeError) as error:
            code = getattr(error, "code", IO if isinstance(error, (OSError, ImportError)) else CASE)
            return self._fail(str(error), code, asJson)
        if asJson:
            print(json.dumps(result, indent=2))
        return DONE

    def _fail(self, text, code, asJson):
        print(f"{self.name}: {text}", file=sys.stderr)
        if asJson:
            print(json.dumps({"problems": [{"message": text}]}, indent=2))
        return code
