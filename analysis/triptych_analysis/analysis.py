"""Runs the paper's complete analysis on one data set, and lists the reason for each part that cannot be computed."""

from dataclasses import dataclass

import numpy as np
import pandas as pd

from . import choice, correlation, distribution, prediction, splits, views

# The pairs of factors for which tables of means are computed: the pairs in the paper's Figures 8 and 14, and pairs with the
# device.
HEAT_MAPS = [("data", "device"), ("data", "camera_path"), ("data", "technique"), ("technique", "device"),
             ("camera_path", "device")]


@dataclass
class Analysis:
    dataset: object
    tables: dict  # name → DataFrame; empty tables are omitted
    left_out: list  # pairs of an omitted analysis and the reason

    def table(self, name):
        """Returns the table with this name, or an empty table if there is none."""
        return self.tables.get(name, pd.DataFrame())

    def empty(self):
        return not set(self.tables) - {"observations", "duplicates", "left_out"}


def analyse(dataset, references=None, seed=1):
    """Analyses a data set. `references` maps factors to the levels to which speed-ups are relative (default: the first level).
    `seed` is used for all random numbers."""
    left_out, tables = [], {}
    tables["distributions"], tables["percentiles"], tables["histograms"] = distribution.distributions(dataset, seed)
    if tables["distributions"].empty:
        left_out.append(("distribution", f"there are {len(dataset)} observations, but at least {distribution.LEAST} are needed, "
                         "and not all may be equal"))
    tables.update(_correlate(dataset, references or {}, left_out))
    tables["means"] = _average(dataset, left_out)
    tables["predictions"], reason = prediction.predict(dataset, seed)
    if reason:
        left_out.append(("prediction", reason))
    tables["camera_paths"] = views.path_tests(dataset, seed)
    if tables["camera_paths"].empty:
        left_out.append(("camera paths compared with all views", "the data contain fewer than two paths"))
    tables.update(_stacks(dataset, left_out))
    tables["by_count"] = choice.by_count(dataset) if dataset.suite == "particles" else pd.DataFrame()
    tables["effects"] = choice.effects(dataset, splits.factors_of(dataset))
    tables["observations"] = observations(dataset)
    tables["duplicates"] = dataset.duplicates
    tables["left_out"] = pd.DataFrame(left_out, columns=["analysis", "reason"])
    return Analysis(dataset, {name: each for name, each in tables.items() if not each.empty}, left_out)


def _correlate(dataset, references, left_out):
    factors = splits.factors_of(dataset)
    matrices, boxes, lines = [], [], []
    for factor in factors:
        by_factor = splits.split(dataset, factor)
        reference = correlation.reference_of(by_factor, references)
        if references.get(factor, reference) != reference:
            left_out.append((f"speed-up relative to {factor}={references[factor]}",
                             f"no record of this data set has that level; speed-ups are relative to {reference} instead"))
        lines.append(correlation.speed_ups(dataset, by_factor, reference))
        matrix = correlation.correlations(dataset, by_factor)
        box = correlation.box(matrix)
        if box:
            boxes.append({"factor": factor, **box})
            matrices.append(matrix)
        else:
            left_out.append((f"correlation of {factor}", f"no two of its {len(by_factor.levels)} levels have "
                             f"{correlation.LEAST_PAIRS} common configurations whose values are not all equal"))
    if not factors:
        left_out.append(("correlation", "every factor has only one level"))
    for factor, level in references.items():
        if factor not in factors:
            left_out.append((f"speed-up relative to {factor}={level}",
                             "the records of this suite have no factor of this name with at least two levels"))
    return {"correlations": _stacked(matrices), "correlation_boxes": pd.DataFrame(boxes), "speed_ups": _stacked(lines)}


def _average(dataset, left_out):
    found = []
    for rows, columns in HEAT_MAPS:
        each = choice.mean_values(dataset, rows, columns)
        if each.empty:
            left_out.append((f"means, {rows} by {columns}", "one of the factors has fewer than two levels in every block "
                             "of comparable configurations"))
        found.append(each)
    return _stacked(found)


def _stacks(dataset, left_out):
    matrices = correlation.stacks(dataset)
    if not matrices:
        left_out.append(("correlation between sizes",
                         "no data set generate:NAME was measured in two sizes with the same configurations"))
    return {"stacks": pd.DataFrame([{"name": name, **correlation.box(each)} for name, each in matrices.items()]),
            "stack_correlations": _stacked([each.assign(name=name) for name, each in matrices.items()])}


def _stacked(frames):
    frames = [each for each in frames if not each.empty]
    return pd.concat(frames, ignore_index=True) if frames else pd.DataFrame()


def observations(dataset):
    """Returns a table with one row for each configuration and device."""
    table = pd.DataFrame({name: np.array([*factor.levels, None], dtype=object)[factor.codes]
                          for name, factor in dataset.factors.items()})
    table[dataset.unit] = dataset.values
    if dataset.signal == "time":
        table["device_ms"], table["wall_ms"] = dataset.device_ms, dataset.wall_ms
    return table
