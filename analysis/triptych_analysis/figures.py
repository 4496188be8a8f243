"""The figures of the paper that can be drawn from the tables, and additional figures for instructions and for the choice of a
technique. Each function takes an Analysis and yields pairs (name, matplotlib figure). If the paper contains a figure, `every`
adds the number of that figure to the name."""

import numpy as np
import pandas as pd

from . import drawing, views
from .dataset import natural_order, view_of

NUMBERS = {  # suite → name of the figure → number of the figure in the paper
    "volume": {"distribution": "03", "correlation_boxes": "04", "correlation_device": "05", "speed_up_device": "06",
               "speed_up_camera_path": "07", "mean_data_camera_path": "08"},
    "particles": {"distribution": "10", "correlation_boxes": "11", "correlation_data": "12",
                  "correlation_camera_path": "13", "mean_data_technique": "14"}}


def every(analysis):
    """Yields all figures as (file name without extension, figure)."""
    for make in (_distributions, _boxes, _matrices, _means, _speed_ups, _predictions, _paths, _stacks, _counts, _effects):
        for what, made in make(analysis):
            number = NUMBERS.get(analysis.dataset.suite, {}).get(what)
            yield (f"figure_{number}_{what}" if number else what), made


def _about(analysis, text, samples=None):
    """Returns a title that consists of the text, the suite, the signal with its clock, and the number of observations."""
    dataset = analysis.dataset
    of = f"{dataset.clock} time" if dataset.signal == "time" else "instructions per frame"
    return f"{text}\n{dataset.suite}, {of}" + (f", {samples} samples" if samples else "")


def _axis(analysis):
    return "time per frame, ms" if analysis.dataset.signal == "time" else "instructions per frame"


def _distributions(analysis):
    bins, fits = analysis.table("histograms"), analysis.table("distributions")
    if bins.empty:
        return
    fits = fits[fits["of"] == "all"]
    made, panels = drawing.figure(8, 3.2 * len(fits), len(fits), 2, squeeze=False)
    unit = analysis.dataset.unit
    for row, fit in zip(panels, fits.itertuples()):
        of = bins[(bins["of"] == "all") & (bins["clock"] == fit.clock)]
        for axes, scale in zip(row, ("linear", "log10")):
            here = of[of["scale"] == scale]
            low, high = here[f"from_{unit}"].to_numpy(), here[f"to_{unit}"].to_numpy()
            axes.bar(low, here["count"], high - low, align="edge", color="#9dbbd8", edgecolor="white", linewidth=0.4)
            middle = np.sqrt(low * high) if scale == "log10" else (low + high) / 2
            axes.plot(middle, here["expected"], color=drawing.INK, label="log-normal fit")
            axes.axvline(getattr(fit, f"mean_{unit}"), color=drawing.RED, label="mean")
            if scale == "log10":
                axes.set_xscale("log")
            clock = f", {fit.clock} clock" if analysis.dataset.signal == "time" else ""
            axes.set_xlabel(f"{_axis(analysis)}{clock}")
            axes.set_ylabel("configurations")
        row[0].legend(frameon=False)
        row[1].set_title(f"{fit.samples} samples: D = {fit.ks_d:.3f}, Lilliefors p = {fit.lilliefors_p:.3g}", fontsize=8)
    made.suptitle(_about(analysis, "Distribution, with a log-normal fit"), fontsize=10)
    yield "distribution", made


def _boxes(analysis):
    cells = analysis.table("correlations")
    if cells.empty:
        return
    r = {factor: of["r"].dropna().to_numpy() for factor, of in cells.groupby("factor", sort=False)}
    made, axes = drawing.figure(7, 1.3 + 0.36 * len(r))
    drawing.boxes(axes, list(r), list(r.values()))
    axes.set_xlabel("Pearson's r between two levels (number of pairs in brackets; diamond: mean)")
    axes.set_title(_about(analysis, "Correlation of the levels of each factor"))
    yield "correlation_boxes", made


def square(cells):
    """Turns rows with a, b and r into a square, symmetric table with ones on the diagonal."""
    levels = natural_order(set(cells["a"]) | set(cells["b"]))
    table = pd.DataFrame(np.nan, index=levels, columns=levels)
    for each in cells.itertuples():
        table.loc[each.a, each.b] = table.loc[each.b, each.a] = each.r
    for level in levels:
        table.loc[level, level] = 1.0
    return table


def _matrix(analysis, title, cells):
    table = square(cells)
    side = 1.6 + (0.52 if len(table) <= drawing.MOST_NUMBERS else 0.28) * len(table)
    longest = 0.055 * max(map(len, table.index))
    made, axes = drawing.figure(max(5, side + longest + 1.2), max(3.4, side + 0.75 * longest))
    drawing.heat_map(axes, table, "Pearson's r", min(0.0, float(np.nanmin(table.to_numpy()))), 1.0, decimals=2)
    axes.set_aspect("equal")
    axes.set_title(_about(analysis, title, cells["samples"].iloc[0]))
    return made


def _matrices(analysis):
    cells = analysis.table("correlations")
    for factor, of in cells.groupby("factor", sort=False) if not cells.empty else ():
        if len(set(of["a"]) | set(of["b"])) > 2:  # for two levels there is only one number, which is in the table
            yield f"correlation_{factor}", _matrix(analysis, f"Correlation between levels of {factor}", of)


def _means(analysis):
    means = analysis.table("means")
    value = f"mean_{analysis.dataset.unit}"
    for (rows, columns), of in means.groupby(["rows", "columns"], sort=False) if not means.empty else ():
        table = of.pivot(index="row", columns="column", values=value)
        table = table.loc[natural_order(table.index), natural_order(table.columns)]
        made, axes = drawing.figure(max(5, 3.2 + 0.62 * table.shape[1] + 0.05 * max(map(len, table.index))),
                                    1.6 + 0.3 * table.shape[0] + 0.04 * max(map(len, table.columns)))
        drawing.heat_map(axes, table, _axis(analysis), logarithmic=True)
        axes.set_title(_about(analysis, f"Mean, {rows} by {columns}", of["samples"].sum()))
        yield f"mean_{rows}_{columns}", made


def _speed_ups(analysis):
    lines = analysis.table("speed_ups")
    for factor, of in lines.groupby("factor", sort=False) if not lines.empty else ():
        made, axes = drawing.figure(6.5, 1.4 + 0.34 * len(of))
        drawing.bars(axes, of["level"].to_list(), of["speed_up"], of["low"], of["high"])
        reference = of["reference"].iloc[0]
        what = "Speed-up" if analysis.dataset.signal == "time" else "Speed-up in instructions"
        axes.set_xlabel(f"slope of the line that predicts the value with {reference} from the value with this level\n"
                        "(error bar: ± (1 − r)·slope)")
        axes.set_title(_about(analysis, f"{what}, {factor} relative to {reference}"))
        yield f"speed_up_{factor}", made


def _predictions(analysis):
    scores = analysis.table("predictions")
    if scores.empty:
        return
    of = scores[scores["models"].notna()]
    if of.empty:
        return
    made, axes = drawing.figure(6.5, 1.5 + 0.32 * len(of))
    places = np.arange(len(of))
    axes.plot(of["line_r2"].astype(float), places, "s", color=drawing.RED, label="one linear model for each data structure")
    axes.plot(of["forest_r2"].astype(float), places, "o", color=drawing.BLUE, label="one random forest")
    axes.set_yticks(places, [f"{each.data} ({each.held_out:.0f})" for each in of.itertuples()])
    axes.set_ylim(len(of) - 0.5, -0.5)
    axes.set_xlim(right=1.02)
    axes.grid(axis="x", color="#e5e5e5")
    axes.set_xlabel("R² for held-out observations (number of observations in brackets)")
    axes.legend(frameon=False, loc="best")
    axes.set_title(_about(analysis, "Random forest compared with linear regression"))
    yield "prediction", made


def _paths(analysis):
    tests = analysis.table("camera_paths")
    if tests.empty:
        return
    values, by_view = views.values_by_view(analysis.dataset)
    made, axes = drawing.figure(7, 4)
    axes.step(np.sort(values), np.arange(1, len(values) + 1) / len(values), where="post", color=drawing.INK,
              linewidth=2.5, label=f"all {len(by_view)} views")
    tests = tests.drop_duplicates("path").set_index("path")
    for path, test in tests.iterrows():
        of = np.sort(np.concatenate([each for view, each in by_view.items() if view_of(view)[0] == path]))
        axes.step(of, np.arange(1, len(of) + 1) / len(of), where="post", linewidth=1.2,
                  label=f"{path}, {test['views']} views: D = {test['d']:.3f}, p = {test['p']:.2g}")
    axes.set_xscale("log")
    axes.set_xlabel(_axis(analysis))
    axes.set_ylabel("share of observations with a smaller value")
    axes.legend(frameon=False, fontsize=8)
    axes.set_title(_about(analysis, "Camera paths compared with all views (two-sample Kolmogorov-Smirnov test)"))
    yield "camera_paths", made


def _stacks(analysis):
    cells = analysis.table("stack_correlations")
    for name, of in cells.groupby("name") if not cells.empty else ():
        yield f"stack_{name.partition(':')[2]}", _matrix(analysis, f"Correlation between sizes of {name}", of)


def _counts(analysis):
    counts = analysis.table("by_count")
    if counts.empty or counts["count"].nunique() < 2:
        return
    value = counts.columns[-1]
    devices = natural_order(counts["device"].unique())
    made, panels = drawing.figure(3.6 * len(devices) + 1.6, 3.8, 1, len(devices), sharey=True, squeeze=False)
    techniques = natural_order(counts["technique"].unique())
    for axes, device in zip(panels[0], devices):
        of_device = counts[counts["device"] == device]
        for i, technique in enumerate(techniques):
            of = of_device[of_device["technique"] == technique].sort_values("count")
            axes.plot(of["count"], of[value], marker="osD^v<>p*h"[i % 10], markersize=4, color=f"C{i}", label=technique)
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_title(device, fontsize=9)
        axes.set_xlabel("spheres")
        axes.grid(color="#e5e5e5")
    panels[0][0].set_ylabel(f"mean, {_axis(analysis)}")
    handles = {label: handle for axes in panels[0] for handle, label in zip(*axes.get_legend_handles_labels())}
    names = [each for each in techniques if each in handles]
    panels[0][-1].legend([handles[each] for each in names], names, frameon=False, loc="upper left",
                         bbox_to_anchor=(1.02, 1), fontsize=8)
    made.suptitle(_about(analysis, "Techniques by number of spheres"), fontsize=10)
    yield "by_count", made


def _effects(analysis):
    effects = analysis.table("effects")
    if effects.empty:
        return
    made, axes = drawing.figure(7, 1.4 + 0.32 * len(effects))
    places = np.arange(len(effects))
    axes.barh(places, effects["share"], height=0.6, color="#9dbbd8", edgecolor=drawing.BLUE)
    for place, each in zip(places, effects.itertuples()):
        ratio = f"  ×{each.largest_ratio:.3g}, {each.cheap} to {each.expensive}" if np.isfinite(each.largest_ratio) else ""
        axes.annotate(ratio, (each.share, place), va="center", fontsize=8)
    axes.set_yticks(places, effects["factor"])
    axes.set_ylim(len(effects) - 0.5, -0.5)
    axes.set_xlim(0, 2.4 * effects["share"].max() or 1)
    axes.set_xlabel("share of the variance of the logarithm that remains if all other factors are fixed\n"
                    "(total-effect index); × largest mean ratio between two levels")
    axes.set_title(_about(analysis, "Influence of each factor"))
    yield "effects", made
