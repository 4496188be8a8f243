"""Drawing functions shared by all figures. The same input always gives bit-identical SVG files."""

import io

import matplotlib
import matplotlib.ticker
import numpy as np
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure

MOST_NUMBERS = 12  # larger matrices are drawn with colours only
BLUE, RED, INK = "#3b6ea5", "#b5413a", "#222222"
STYLE = {"svg.hashsalt": "triptych", "svg.fonttype": "path", "font.size": 9, "axes.titlesize": 10,
         "axes.spines.top": False, "axes.spines.right": False, "figure.dpi": 100, "font.family": "DejaVu Sans"}


class SvgFigure(Figure):
    """A figure that a notebook can display."""

    def _repr_svg_(self):
        text = io.StringIO()
        save(self, text)
        return text.getvalue()


def figure(width, height, rows=1, columns=1, **more):
    """Creates a figure and its axes. Width and height are in inches."""
    with matplotlib.rc_context(STYLE):
        made = SvgFigure(figsize=(width, height), layout="constrained")
        FigureCanvasSVG(made)
        return made, made.subplots(rows, columns, **more)


def save(made, file):
    with matplotlib.rc_context(STYLE):
        made.savefig(file, format="svg", metadata={"Date": None})


def heat_map(axes, cells, label, low=None, high=None, logarithmic=False, decimals=None):
    """Draws a DataFrame of numbers as coloured cells, with a colour bar. Cells without a number are hatched."""
    values = cells.to_numpy(dtype=float)
    known = values[np.isfinite(values)]
    low, high = (known.min() if low is None else low), (known.max() if high is None else high)
    if not low < high:
        low, high = (low / 2, high * 2) if logarithmic else (low - 0.5, high + 0.5)
    norm = (matplotlib.colors.LogNorm if logarithmic else matplotlib.colors.Normalize)(low, high)
    axes.set_facecolor("white")
    axes.patch.set_hatch("////")
    axes.patch.set_edgecolor("#d5d5d5")
    image = axes.pcolormesh(np.ma.masked_invalid(values), norm=norm, cmap="YlGnBu", edgecolors="white", linewidth=1)
    axes.invert_yaxis()
    axes.set_xticks(np.arange(cells.shape[1]) + 0.5, cells.columns, rotation=45, ha="right", rotation_mode="anchor")
    axes.set_yticks(np.arange(cells.shape[0]) + 0.5, cells.index)
    axes.tick_params(length=0)
    if max(cells.shape) <= MOST_NUMBERS:
        for (row, column), value in np.ndenumerate(values):
            if np.isfinite(value):
                text = f"{value:.{decimals}f}" if decimals is not None else short(value)
                dark = norm(value) > 0.55
                axes.text(column + 0.5, row + 0.5, text, ha="center", va="center", fontsize=7.5,
                          color="white" if dark else INK)
    bar = axes.figure.colorbar(image, ax=axes, shrink=0.8)
    if logarithmic:
        bar.set_ticks(matplotlib.ticker.LogLocator(subs=(1, 2, 5)))
        bar.minorticks_off()
        bar.ax.yaxis.set_major_formatter(lambda value, _: short(value))
    bar.set_label(label)
    bar.outline.set_visible(False)


def short(value):
    """Formats a number with three digits, and from ten thousand on with the suffix k, M or G: 0.123, 4.56, 789, 12.3k"""
    for size, letter in ((1e9, "G"), (1e6, "M"), (1e4, "k")):
        if abs(value) >= size:
            return f"{value / (1e3 if letter == 'k' else size):.3g}{letter}"
    return f"{value:.3g}" if abs(value) < 1000 else f"{value:.0f}"


def boxes(axes, names, samples):
    """Draws a row with a box plot for each name. If there are fewer than three values, only ticks are drawn, because quartiles
    would be meaningless."""
    full = [i for i, each in enumerate(samples) if len(each) >= 3]
    if full:
        axes.boxplot([samples[i] for i in full], positions=full, vert=False, widths=0.5, whis=(0, 100),
                     patch_artist=True, manage_ticks=False, boxprops={"facecolor": "#cfdeec", "edgecolor": BLUE},
                     medianprops={"color": INK, "linewidth": 1.5}, whiskerprops={"color": BLUE},
                     capprops={"color": BLUE}, showmeans=True,
                     meanprops={"marker": "D", "markerfacecolor": RED, "markeredgecolor": "none", "markersize": 4})
    for i, each in enumerate(samples):
        axes.plot(each, np.full(len(each), i), "|", color=INK, markersize=9, alpha=0.6)
    axes.set_yticks(range(len(names)), [f"{name} ({len(each)})" for name, each in zip(names, samples)])
    axes.set_ylim(len(names) - 0.5, -0.5)
    axes.grid(axis="x", color="#e5e5e5")
    axes.set_axisbelow(True)


def bars(axes, names, lengths, low, high):
    """Draws a bar with an error range for each name."""
    places = np.arange(len(names))
    error = np.abs(np.array([np.subtract(lengths, low), np.subtract(high, lengths)], dtype=float))
    axes.barh(places, lengths, height=0.6, color="#9dbbd8", edgecolor=BLUE, xerr=error,
              error_kw={"ecolor": INK, "capsize": 3, "elinewidth": 1})
    for place, length, end in zip(places, lengths, high):
        axes.annotate(short(length), (max(end, length, 0), place), xytext=(4, 0), textcoords="offset points", va="center",
                      fontsize=8)
    axes.set_yticks(places, names)
    axes.set_ylim(len(names) - 0.5, -0.5)
    axes.axvline(1, color=INK, linewidth=0.8, linestyle=":")
    axes.margins(x=0.12)
