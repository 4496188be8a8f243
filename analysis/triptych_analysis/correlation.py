"""The correlation between levels of a factor. Pearson's r of two levels is computed from the configurations that were measured
with both levels (the paper's Figures 4, 5, 11, 12, 13). Speed-ups are computed from lines through the same pairs (Figures 6 and
7)."""

import numpy as np
import pandas as pd

from .dataset import natural_order
from .splits import Split, scope, split
from .tables import InputError

# The smallest number of pairs of values from which a result is computed. With fewer pairs, a regression line, for example, would
# be meaningless, because two points always lie on a line, and three points often nearly do by chance.
LEAST_PAIRS = 4
BOX = ["mean", "minimum", "lower_quartile", "median", "upper_quartile", "maximum"]


def pearson(x, y):
    """Returns Pearson's r, or NaN if there are fewer than two pairs or if x or y is constant."""
    if len(x) < 2 or np.ptp(x) == 0 or np.ptp(y) == 0:
        return np.nan
    x, y = x - x.mean(), y - y.mean()
    return float(np.clip((x @ y) / np.sqrt((x @ x) * (y @ y)), -1, 1))


def correlations(dataset, of_split):
    """Returns one row for every unordered pair of levels `a` and `b` of a factor. `of_split` contains the observations, divided
    by the levels of this factor (splits.Split). `pairs` is the number of configurations that were measured with both levels, and
    `r` is Pearson's r of their values. r is NaN if there are fewer than LEAST_PAIRS pairs or if the values of a level are
    constant. `samples` and `held` are the same in all rows: the number of observations from which any r was computed, and the
    factors that have the same level in all these observations, such as "step=1, viewport=64"."""
    values = of_split.values(dataset)
    there = of_split.rows >= 0
    entered = np.zeros_like(there)
    cells = []
    for i, a in enumerate(of_split.levels):
        for j in range(i + 1, len(of_split.levels)):
            both = there[:, i] & there[:, j]
            pairs = int(both.sum())
            r = pearson(values[both, i], values[both, j]) if pairs >= LEAST_PAIRS else np.nan
            if np.isfinite(r):
                entered[both, i] = entered[both, j] = True
            cells.append((of_split.factor, a, of_split.levels[j], pairs, r))
    matrix = pd.DataFrame(cells, columns=["factor", "a", "b", "pairs", "r"])
    of = scope(dataset, of_split.rows[entered])
    return matrix.assign(samples=of["samples"], held=of["held"])


def box(matrix):
    """Returns the numbers of a factor's box in the overview plot, or None if all correlation coefficients in `matrix`, a table
    from correlations(), are NaN. `levels` is the number of levels of the factor, and `cells` the number of coefficients, whose
    mean and quartiles follow. `samples` and `held` are copied from `matrix`."""
    r = matrix["r"].dropna()
    if r.empty:
        return None
    quartiles = np.percentile(r, [0, 25, 50, 75, 100])
    levels = len(set(matrix["a"]) | set(matrix["b"]))
    return {"levels": levels, "cells": len(r), "samples": matrix["samples"].iloc[0],
            **dict(zip(BOX, [r.mean(), *quartiles])), "held": matrix["held"].iloc[0]}


def speed_ups(dataset, of_split, reference):
    """Returns the speed-up of every level except the reference. `of_split` contains the observations, divided by the levels of
    the factor (splits.Split). The column `speed_up` is the slope of the line value(reference) = intercept + speed_up ·
    value(level), which is fitted to the pairs of values by least squares. `pairs` is the number of pairs, and `r` is Pearson's r
    of the pairs. `error` is (1 − r)·speed_up, as in the paper, and `low` and `high` are the ends of the range speed_up ± error.
    `mean_ratio` is the geometric mean of value(reference)/value(level), which does not depend on an intercept. `held` lists the
    factors that have the same level in all these observations, such as "step=1, viewport=64"."""
    columns = ["factor", "level", "reference", "pairs", "speed_up", "error", "low", "high", "r",
               f"intercept_{dataset.unit}", "mean_ratio", "held"]
    rows = []
    if reference not in of_split.levels:
        return pd.DataFrame(rows, columns=columns)
    values = of_split.values(dataset)
    base = of_split.levels.index(reference)
    for i, level in enumerate(of_split.levels):
        both = (of_split.rows[:, i] >= 0) & (of_split.rows[:, base] >= 0)
        x, y = values[both, i], values[both, base]
        r = pearson(x, y) if i != base and len(x) >= LEAST_PAIRS else np.nan
        if not np.isfinite(r):  # too few pairs, or constant values
            continue
        slope = float((x - x.mean()) @ (y - y.mean()) / ((x - x.mean()) @ (x - x.mean())))
        error = (1 - r) * slope
        of = scope(dataset, np.concatenate([of_split.rows[both, i], of_split.rows[both, base]]))
        rows.append((of_split.factor, level, reference, len(x), slope, error, slope - error, slope + error, r,
                     y.mean() - slope * x.mean(), float(np.exp(np.mean(np.log(y / x)))), of["held"]))
    return pd.DataFrame(rows, columns=columns)


def require_references(datasets, references):
    """Raises InputError if no data set has the level of a reference. It is sufficient if one suite has the level."""
    for factor, level in references.items():
        levels = {each for data in datasets for each in split(data, factor).levels}
        if not levels:
            raise InputError(f"reference {factor}={level}: no record has a factor {factor}")
        if level not in levels:
            raise InputError(f"reference {factor}={level}: the levels of that factor are {', '.join(natural_order(levels))}")


def reference_of(of_split, references):
    """Returns the requested reference level if the factor has it, otherwise the first level."""
    asked = references.get(of_split.factor)
    return asked if asked in of_split.levels else of_split.levels[0]


def stacks(dataset):
    """Correlates different sizes of the same data, which are the levels generate:NAME:SIZE of the factor `data`. Returns
    {name: table from correlations()}."""
    whole = split(dataset, "data")
    by_name = {}
    for i, level in enumerate(whole.levels):
        name, _, size = level.rpartition(":")
        if name.startswith("generate:") and size:
            by_name.setdefault(name, []).append(i)
    found = {}
    for name in sorted(by_name):
        places = by_name[name]
        matrix = correlations(dataset, Split("data", [whole.levels[i] for i in places], whole.rows[:, places]))
        if box(matrix):
            found[name] = matrix
    return found
