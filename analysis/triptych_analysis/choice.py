"""Answers to typical questions of researchers: which technique is best for N spheres, which factor influences a value most, and
which mean values the levels of two factors have (the paper's Figures 8 and 14)."""

from fnmatch import fnmatchcase

import numpy as np
import pandas as pd

from .correlation import LEAST_PAIRS
from .dataset import number
from .splits import fullest_block, levels_in, scope, split

FARTHEST = 10


def mean_values(dataset, rows, columns):
    """Returns the mean value for each combination of levels of two factors, which the columns `rows` and `columns` name. The
    column `row` contains the level of the first factor, `column` the level of the second factor, `samples` the number of
    observations, `mean_UNIT` their mean, and `held` the factors with only one level, such as "step=1, viewport=64" (see scope()).
    The means are taken over the observations that splits.fullest_block() selects, so that they differ only in the two factors.
    Returns an empty table if either factor has fewer than two levels in this block. A combination that was not measured has no
    row."""
    mean = f"mean_{dataset.unit}"
    chosen = fullest_block(dataset, [rows, columns])
    of_row, of_column = levels_in(dataset, rows, chosen), levels_in(dataset, columns, chosen)
    cells = []
    if len(of_row) > 1 and len(of_column) > 1:
        held = scope(dataset, chosen)["held"]
        for row, of in of_row.items():
            for column, here in levels_in(dataset, columns, of).items():
                cells.append((rows, columns, row, column, len(here), dataset.values[here].mean(), held))
    return pd.DataFrame(cells, columns=["rows", "columns", "row", "column", "samples", mean, "held"])


def by_count(dataset, generator="uniform"):
    """Returns the mean value (column `mean_UNIT`) for each device, technique and number of spheres. `count` is the number of
    spheres in the data set generate:GENERATOR:COUNT, and `samples` the number of observations. For each device, only
    configurations that were measured with the same techniques and counts are used, so that the means differ only in these."""
    mean = f"mean_{dataset.unit}"
    data, prefix = dataset.factor("data"), f"generate:{generator}:"
    counted = [i for i, each in enumerate(data.levels) if each.startswith(prefix)]
    rows = []
    for device, of_device in levels_in(dataset, "device", np.arange(len(dataset))).items():
        own = of_device[np.isin(data.codes[of_device], counted)]
        for technique, of in levels_in(dataset, "technique", fullest_block(dataset, ["data", "technique"], own)).items():
            for level, here in levels_in(dataset, "data", of).items():
                count = number(level[len(prefix):])
                if count:
                    rows.append((device, technique, int(count), len(here), dataset.values[here].mean()))
    return pd.DataFrame(rows, columns=["device", "technique", "count", "samples", mean])


def technique_for(counts, device, count):
    """Ranks the techniques for a number of spheres on the devices that match a glob, cheapest first. `counts` is the table from
    by_count(). If the number of spheres was not measured, the value is interpolated or extrapolated along a line through the
    logarithms of the two nearest counts. The column `from` is "measured" or names these two counts. `to_least` is the ratio to
    the cheapest technique on the same device. A technique has no row if it was measured with only one other count, or if the
    nearest count is more than a factor of FARTHEST away. Returns an empty table if there are no values by count."""
    if counts is None or counts.empty:
        return pd.DataFrame(columns=["device", "technique", "from", "to_least"])
    mean = counts.columns[-1]
    rows = []
    for (of_device, technique), of in counts.groupby(["device", "technique"]):
        if fnmatchcase(of_device, device):
            value, source = _at_count(of["count"].to_numpy(dtype=float), of[mean].to_numpy(), count)
            if source:
                rows.append((of_device, technique, value, source))
    found = pd.DataFrame(rows, columns=["device", "technique", mean, "from"])
    found["to_least"] = found[mean] / found.groupby("device")[mean].transform("min")
    return found.sort_values(["device", mean]).reset_index(drop=True)


def _at_count(counts, values, count):
    if count in counts:
        return values[counts == count][0], "measured"
    distance = np.abs(np.log(counts / count))
    if len(counts) < 2 or distance.min() > np.log(FARTHEST) * (1 + 1e-9):
        return np.nan, None
    low, high = sorted(np.argsort(distance, kind="stable")[:2], key=lambda each: counts[each])
    logs = np.log(values)
    slope = (logs[high] - logs[low]) / np.log(counts[high] / counts[low])
    return float(np.exp(logs[low] + slope * np.log(count / counts[low]))), f"{counts[low]:.0f} and {counts[high]:.0f}"


def effects(dataset, factors):
    """Returns the influence of each factor while all other factors are fixed, largest first. `levels` is the number of levels of
    the factor, and `keys` the number of combinations of the other factors that were measured with at least two of these levels.
    `share` is the mean variance of ln(value) along the factor, divided by the variance of ln(value). This is the total-effect
    index of Homma & Saltelli (1996); shares may add up to more than 1. `largest_ratio` is the largest geometric mean of the
    ratio between two levels, which the columns `cheap` and `expensive` name, and `pairs` is the number of ratios in that mean."""
    total = np.log(dataset.values).var() if len(dataset) else 0
    rows = []
    for factor in factors:
        of_split = split(dataset, factor)
        logs = np.log(of_split.values(dataset))
        paired = logs[np.isfinite(logs).sum(axis=1) > 1]
        if not len(paired) or not total > 0:
            continue
        ratio, low, high, pairs = _largest_ratio(of_split.levels, logs)
        rows.append((factor, len(of_split.levels), len(paired), np.nanvar(paired, axis=1).mean() / total,
                     ratio, low, high, pairs))
    found = pd.DataFrame(rows, columns=["factor", "levels", "keys", "share", "largest_ratio", "cheap", "expensive", "pairs"])
    return found.sort_values("share", ascending=False, kind="stable").reset_index(drop=True)


def _largest_ratio(levels, logs):
    """Returns the largest geometric mean of value(expensive)/value(cheap) among all pairs of levels, the two levels and the
    number of value pairs. `logs` contains ln(value) with a row for each combination of the other factors and a column for each
    level, and NaN for a missing value."""
    best = (np.nan, None, None, 0)
    for i in range(len(levels)):
        for j in range(i + 1, len(levels)):
            difference = logs[:, j] - logs[:, i]
            difference = difference[np.isfinite(difference)]
            if len(difference) < LEAST_PAIRS:
                continue
            ratio = float(np.exp(np.abs(difference.mean())))
            if not ratio <= best[0]:
                cheap, expensive = (i, j) if difference.mean() >= 0 else (j, i)
                best = (ratio, levels[cheap], levels[expensive], len(difference))
    return best
