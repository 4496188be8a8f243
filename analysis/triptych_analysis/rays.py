"""Shows when ray tracing is faster than other techniques. Compares the fastest technique that traces rays with the fastest
other technique, using a run of particles/ray_tracing. analysis/rays runs this program."""

import argparse
import os
import sys

import numpy as np
import pandas as pd

from . import dataset, drawing, tables

PLAN = "particles/ray_tracing"
MODES = ("static", "refit", "rebuild")
SCENE = ["device", "data", "camera", "radius_scale", "viewport"]


def observations(data):
    """Returns one row for each observation, with its time and its factors. `mode` states how the hierarchy is updated in each
    frame. It is None for techniques without a hierarchy, which were measured only with the default level of the factor
    `structure`."""
    rows = pd.DataFrame({name: [factor.levels[code] if code >= 0 else None for code in factor.codes]
                         for name, factor in data.factors.items()})
    rows["ms"] = data.values
    for column in [*SCENE, "structure"]:
        if column not in rows:
            rows[column] = None
    rows = rows.assign(**{column: rows[column].fillna("") for column in SCENE})
    structure = rows["structure"].fillna(MODES[0])
    traces = set(rows.loc[structure != MODES[0], "technique"])
    rows["mode"] = structure.where(rows["technique"].isin(traces), None)
    rows["count"] = rows["data"].str.rsplit(":", n=1).str[-1].astype(int)
    return rows


def compare(rows):
    """Returns one row for each device, number of spheres and mode. `ratio` is the time of the fastest technique with rays
    divided by the time of the fastest other technique, as a geometric mean over all scenes (views and radii). `rays` and
    `other` are the techniques that were fastest most often."""
    others = rows[rows["mode"].isna()]
    best = others.loc[others.groupby(SCENE)["ms"].idxmin()].set_index(SCENE)
    found = []
    for mode in MODES:
        traced = rows[rows["mode"] == mode]
        fastest = traced.loc[traced.groupby(SCENE)["ms"].idxmin()].set_index(SCENE)
        both = fastest.join(best, rsuffix="_other", how="inner")
        both["ratio"] = both["ms"] / both["ms_other"]
        for (device, count), of in both.groupby([both.index.get_level_values("device"), "count"]):
            found.append({"device": device, "spheres": count, "mode": mode, "scenes": len(of),
                          "rays": of["technique"].mode().iloc[0], "other": of["technique_other"].mode().iloc[0],
                          "ratio": float(np.exp(np.log(of["ratio"]).mean()))})
    return pd.DataFrame(found, columns=["device", "spheres", "mode", "scenes", "rays", "other", "ratio"])


def markdown(table):
    """Returns a Markdown table with a row for each device and number of spheres."""
    ratios = " | ".join(f"Time ratio, {mode}" for mode in MODES)
    lines = [f"| Device | Spheres | Fastest without rays | Fastest with rays | {ratios} |",
             "|---|---|---|---|" + "---|" * len(MODES)]
    for (device, count), of in table.groupby(["device", "spheres"]):
        ratio = of.set_index("mode")["ratio"]
        first = of.iloc[0]
        cells = [f"{ratio[mode]:.2f}" if mode in ratio.index else "–" for mode in MODES]
        lines.append(f"| {device} | {count:,} | `{first.other}` | `{first.rays}` | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def draw(table):
    made, axes = drawing.figure(6.5, 4)
    styles = dict(zip(MODES, ("-", "--", ":")))
    devices = list(dict.fromkeys(table["device"]))
    for (device, mode), of in table.groupby(["device", "mode"], sort=False):
        axes.plot(of["spheres"], of["ratio"], styles[mode], marker="o", markersize=3, color=f"C{devices.index(device)}",
                  label=f"{device}, {mode}")
    axes.axhline(1, color=drawing.INK, linewidth=0.8)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel("spheres")
    axes.set_ylabel("time with rays / time without rays")
    axes.legend(fontsize=7, frameon=False)
    return made


def run(arguments):
    times = dataset.datasets(tables.read(arguments.source, arguments.plan))[0]
    table = compare(observations(times))
    if table.empty:
        raise tables.InputError(f"{', '.join(arguments.source)}: no scene of {arguments.plan} was drawn both by a "
                                "technique that traces rays and by another technique")
    os.makedirs(arguments.out, exist_ok=True)
    table.to_csv(os.path.join(arguments.out, "rays.csv"), index=False, lineterminator="\n")
    drawing.save(draw(table), os.path.join(arguments.out, "rays.svg"))
    print(markdown(table))
    for note in times.notes:
        print(f"note: {note}", file=sys.stderr)
    return 0


def main(words=None):
    parser = argparse.ArgumentParser(
        prog="rays", description="Prints a Markdown table of ratios: the time of the fastest technique that traces rays, divided by "
        "the time of the fastest other technique. Writes the table to OUT as rays.csv, and as the figure rays.svg.",
        epilog="Exit codes: 0 success, 3 usage or I/O error.")
    parser.add_argument("source", nargs="+", help="a folder that `triptych export` wrote, or a store")
    parser.add_argument("--out", required=True, help="write the table and the figure to this folder")
    parser.add_argument("--plan", default=PLAN, help=f"use the records of this plan, SUITE/PLAN (default: {PLAN})")
    try:
        return run(parser.parse_args(words))
    except SystemExit as left:  # argparse exits with code 2, which has another meaning in Triptych
        return left.code and 3
    except (tables.InputError, OSError) as error:
        print(f"rays: {error}", file=sys.stderr)
        return 3


if __name__ == "__main__":
    sys.exit(main())
