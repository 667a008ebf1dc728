"""Numbers from tables: period, crossings, means with errors, tank-treading. Series are columns of a DataFrame of one cell."""
import math

import numpy


def _alongOf(table, along):
    if along:
        return along
    return "strain" if "strain" in table and table["strain"].iloc[-1] != table["strain"].iloc[0] else "time_s"


def _series(table, column, along):
    if "cell" in table and table["cell"].nunique() > 1:
        raise ValueError("this table has several cells: choose one, as in table[table.cell == 1]")
    x, y = table[_alongOf(table, along)].to_numpy(float), table[column].to_numpy(float)
    isThere = numpy.isfinite(y)
    return x[isThere], y[isThere]


def period(table, column, along=None, clear=0.05):
    """Period of an oscillation and its standard error, in strain (or along='time_s'): mean distance of the places where the series goes up
    through its mean, once it has been below it by `clear` of its range. (nan, nan) where there are fewer than two."""
    x, y = _series(table, column, along)
    if len(y) == 0:
        return math.nan, math.nan
    mean, low = y.mean(), y.mean() - clear * (y.max() - y.min())
    crossings, wasBelow = [], False
    for k in range(1, len(y)):
        wasBelow = wasBelow or y[k - 1] < low
        if wasBelow and y[k - 1] < mean <= y[k]:
            crossings.append(x[k - 1] + (mean - y[k - 1]) / (y[k] - y[k - 1]) * (x[k] - x[k - 1]))
            wasBelow = False
    distances = numpy.diff(crossings)
    if len(distances) == 0:
        return math.nan, math.nan
    error = distances.std(ddof=1) / math.sqrt(len(distances)) if len(distances) > 1 else math.nan
    return float(distances.mean()), float(error)


def crossing(table, column, level, along=None):
    """First strain (or time) at which the series reaches a level, from either side; nan where it never does."""
    x, y = _series(table, column, along)
    if len(y) and y[0] == level:
        return float(x[0])
    for k in range(1, len(y)):
        if (y[k - 1] - level) * (y[k] - level) <= 0:
            return float(x[k - 1] + (level - y[k - 1]) / (y[k] - y[k - 1]) * (x[k] - x[k - 1]))
    return math.nan


def mean(table, column, since=None, until=None, along=None):
    """Mean and standard error by blocks, from `since` to `until` (strain, or along='time_s'); without `since`, of the second half.

    Blocks of b values are put together until neighbours are independent (libs/core/blockAverage.hpp has method and sources)."""
    x, y = _series(table, column, along)
    end = x[-1] if until is None else until
    begin = (x[0] + end) / 2 if since is None else since
    y = y[(x >= begin) & (x <= end)]
    if len(y) == 0:
        raise ValueError(f"no values of {column} lie there")

    def variance(b):  # of the mean, by blocks of b
        count = len(y) // b
        means = y[:count * b].reshape(count, b).mean(axis=1)
        return ((means - means.mean()) ** 2).mean() / (count - 1) if count > 1 else math.nan
    single, b = variance(1), 1
    while len(y) // (2 * b) > 1 and single > 0 and b < 3 * variance(b) / single:
        b *= 2
    square = 2 * variance(2 * b) - variance(b) if len(y) // (2 * b) > 1 else variance(b)
    return float(y.mean()), math.sqrt(square) if square > 0 else math.sqrt(max(variance(b), 0)) if len(y) > 1 else math.nan


def unwrapped(angles):
    """An axis' inclination [rad] followed from row to row: an axis has no direction, so that angles that differ by pi are the same."""
    return numpy.unwrap(2 * numpy.asarray(angles, dtype=float)) / 2


def tankTreadingFrequency(table, since=None, column="angleTurned_rad", along="time_s"):
    """Turns of the material in each unit of time (along='time_s') or strain, by a straight line through the angle from `since` on; without it,
    of the second half. The column is the angle by which the material has turned, of the observer `shape`."""
    x, y = _series(table, column, along)
    begin = (x[0] + x[-1]) / 2 if since is None else since
    chosen = x >= begin
    if chosen.sum() < 2:
        raise ValueError(f"fewer than two values of {column} lie after {begin}")
    return float(abs(numpy.polyfit(x[chosen], y[chosen], 1)[0]) / (2 * math.pi))
