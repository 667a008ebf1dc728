"""Numbers from tables: period, crossings, means with errors, tank-treading. Series are columns of a DataFrame of one cell."""
import math
import typing

import numpy


def _alongOf(table, along):
    if along:
        return along
    return "strain" if "strain" in table and table["strain"].iloc[-1] != table["strain"].iloc[0] else "time_s"


def _series(table, column, along):
    if "cell" in table and table["cell"].nunique() > 1:
        raise ValueError("this table has several cells: choose one, as in table[table.cell == 1]")
    for name in filter(None, (column, along)):
        if name not in table:
            raise KeyError(f"there is no column {name!r}; there are {', '.join(table.columns)}")
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


class Mean(typing.NamedTuple):
    """A mean with its standard error; isReliable is False where the error is a lower bound: the series is too short, or drifts."""

    value: float
    error: float
    isReliable: bool


def mean(table, column, since=None, until=None, along=None):
    """Mean of a series in time with its standard error by blocks, from `since` to `until` (strain, or along='time_s'); without `since`, of the second
    half. The method is that of averageTable and caseSweep (libs/core/blockAverage.hpp: variance of the mean by blocks of b values, from b = 3 g on,
    what is lacking taken out by the difference to twice the length)."""
    x, y = _series(table, column, along)
    end = x[-1] if until is None else until
    begin = (x[0] + end) / 2 if since is None else since
    margin = 1e-9 * abs(x[-1])
    chosen = (x >= begin - margin) & (x <= end + margin)
    x, y = x[chosen], y[chosen]
    if len(y) == 0:
        raise ValueError(f"no values of {column} lie there")
    steps = numpy.diff(x)
    if len(steps) > 1 and abs(steps[-1] - steps[0]) > 0.01 * steps[0]:  # the end of the run
        x, y, steps = x[:-1], y[:-1], steps[:-1]
    if len(steps) and (abs(steps - steps[0]) > 0.01 * steps[0]).any():
        raise ValueError("the rows are not evenly spaced there; take a range in which they are")

    def variance(blocks):
        return ((blocks - y.mean()) ** 2).sum() / (len(blocks) * (len(blocks) - 1))
    variances, counts, blocks = [], [], y
    while len(blocks) >= 4:
        variances.append(variance(blocks))
        counts.append(len(blocks))
        odd = len(blocks) % 2  # the first is left out then
        blocks = 0.5 * (blocks[odd::2] + blocks[odd + 1::2])
    if not variances:
        return Mean(float(y.mean()), math.sqrt(variance(y)) if len(y) > 1 else math.nan, False)
    square, isReliable = max(variances), False
    for level in range(len(variances) - 1):
        if 2 ** level * variances[0] >= 3 * variances[level]:
            isReliable = counts[level + 1] >= 8
            if isReliable:
                square = max(2 * variances[level + 1] - variances[level], 0.5 * variances[level])
            break
    return Mean(float(y.mean()), math.sqrt(square), bool(isReliable or math.sqrt(square) <= 1e-9 * abs(y.mean())))


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
