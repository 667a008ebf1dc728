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
            raise FileNotFoundError(self.file)

    def _words(self, *options):
        return ["-case", str(self.file.parent), self.file.name, *map(str, options)]

    def list(self):
        """Names of the cases with their values."""
        return programs.runJson("caseSweep", *self._words("-list", "-quiet"))

    def run(self, jobs=None, ranks=None, retry=False, show=False):
        """Runs what is not done. True where all cases are done, False where some were stopped; raises CorpuscleError where some failed."""
        options = [] if jobs is None else ["-jobs", jobs]
        options += [] if ranks is None else ["-ranks", ranks]
        options += ["-retry"] if retry else []
        return programs.run([programs.program("caseSweep"), *self._words(*options)], allowed=(0, 5), show=show)[0] == 0

    @property
    def folder(self):
        """Of the cases."""
        return self.file.parent / programs.runJson("caseDict", f"{self.file.name}", "-case", self.file.parent).get("cases", "cases")

    @property
    def summary(self):
        """summary.csv as a DataFrame: a row for each case."""
        return tables.readTable(self.folder / "summary.csv")

    def __getitem__(self, name):
        """A case by its name."""
        return Case(self.folder / name)
