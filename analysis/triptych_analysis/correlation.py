"""The correlation of a factor's levels: Pearson's r between the values of two levels over the configurations that both have
(the paper's Figures 4, 5, 11, 12, 13), and speed-ups from lines through the same pairs (Figures 6 and 7)."""

import numpy as np
import pandas as pd

from .dataset import natural_order
from .splits import Split, scope, split
from .tables import InputError

# A line through fewer pairs would be meaningless: two points always lie on a line, and three often nearly do by chance.
LEAST_PAIRS = 4
BOX = ["mean", "minimum", "lower_quartile", "median", "upper_quartile", "maximum"]


def pearson(x, y):
    """Pearson's r; NaN for fewer than two pairs, or if x or y is constant."""
    if len(x) < 2 or np.ptp(x) == 0 or np.ptp(y) == 0:
        return np.nan
    x, y = x - x.mean(), y - y.mean()
    return float(np.clip((x @ y) / np.sqrt((x @ x) * (y @ y)), -1, 1))


def correlations(dataset, of_split):
    """One row for every unordered pair of levels: factor, a, b, pairs, r, samples, held. r is NaN if there are fewer
    than LEAST_PAIRS pairs or a level is constant."""
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
    """The box of a factor in the overview plot, from the r of its matrix; None if there is no r."""
    r = matrix["r"].dropna()
    if r.empty:
        return None
    quartiles = np.percentile(r, [0, 25, 50, 75, 100])
    levels = len(set(matrix["a"]) | set(matrix["b"]))
    return {"levels": levels, "cells": len(r), "samples": matrix["samples"].iloc[0],
            **dict(zip(BOX, [r.mean(), *quartiles])), "held": matrix["held"].iloc[0]}


def speed_ups(dataset, of_split, reference):
    """For every level except the reference: value(reference) = intercept + speed_up · value(level), fitted by least
    squares to the pairs. The error is defined as in the paper, (1 − r)·speed_up. mean_ratio is the geometric mean of
    value(reference)/value(level), which does not depend on an intercept."""
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
        if not np.isfinite(r):  # a line needs values that differ
            continue
        slope = float((x - x.mean()) @ (y - y.mean()) / ((x - x.mean()) @ (x - x.mean())))
        error = (1 - r) * slope
        of = scope(dataset, np.concatenate([of_split.rows[both, i], of_split.rows[both, base]]))
        rows.append((of_split.factor, level, reference, len(x), slope, error, slope - error, slope + error, r,
                     y.mean() - slope * x.mean(), float(np.exp(np.mean(np.log(y / x)))), of["held"]))
    return pd.DataFrame(rows, columns=columns)


def require_references(datasets, references):
    """Raises InputError for a reference level that no data set has. A level may exist in one suite only."""
    for factor, level in references.items():
        levels = {each for data in datasets for each in split(data, factor).levels}
        if not levels:
            raise InputError(f"reference {factor}={level}: no record has a factor {factor}")
        if level not in levels:
            raise InputError(f"reference {factor}={level}: the levels of that factor are {', '.join(natural_order(levels))}")


def reference_of(of_split, references):
    """The requested level if it exists, otherwise the first one."""
    asked = references.get(of_split.factor)
    return asked if asked in of_split.levels else of_split.levels[0]


def stacks(dataset):
    """Correlation along a series of sizes of the same data, which are the levels generate:NAME:SIZE of `data`. Returns
    {name: matrix}."""
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
