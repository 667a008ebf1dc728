"""A parameter study, run by caseSweep."""
import pathlib

from . import programs, tables
from .case import Case


class Study:
    """study.yaml: run it, read its summary, open its cases."""

    def __init__(self, file):
        self.file = pathlib.Path(file)
        if self.file.is_dir():
            self.file /= "study.yaml"
        if not self.file.is_file():
            raise FileNotFoundError(f"{self.file}: there is no such study")

    def _words(self, *options):
        return ["-case", str(self.file.parent), self.file.name, *map(str, options)]

    def list(self):
        """Names of the cases with their values."""
        return programs.runJson("caseSweep", *self._words("-list", "-quiet"))

    def run(self, jobs=None, ranks=None, retry=False, differing=None, show=False):
        """Runs what is not done. True where all cases are done, False where some were stopped; raises CorpuscleError where some failed.

        differing: "keep", "update" or "fresh", of cases that differ from the template by now; without it they are an error."""
        if differing not in (None, "keep", "update", "fresh"):
            raise ValueError(f"differing is {differing!r}; it may be keep, update or fresh")
        options = [] if jobs is None else ["-jobs", jobs]
        options += [] if ranks is None else ["-ranks", ranks]
        options += ["-retry"] if retry else []
        options += [f"-{differing}"] if differing else []
        return programs.run([programs.program("caseSweep"), *self._words(*options)], allowed=(0, 5), show=show)[0] == 0

    @property
    def folder(self):
        """Of the cases."""
        return self.file.parent / programs.runJson("caseDict", f"{self.file.name}", "-case", self.file.parent).get("cases", "cases")

    @property
    def summary(self):
        """summary.csv as a DataFrame: a row for each case."""
        path = self.folder / "summary.csv"
        if not path.is_file():
            raise FileNotFoundError(f"{path}: the study has not been run")
        return tables.readTable(path)

    @property
    def cases(self):
        """Names of all cases."""
        return [one["case"] for one in self.list()]

    def __iter__(self):
        return iter(self.cases)

    def __getitem__(self, name):
        """A case by its name."""
        if not (self.folder / str(name)).is_dir():
            raise KeyError(f"there is no case {name!r}; there are {', '.join(self.cases)}")
        return Case(self.folder / name)
