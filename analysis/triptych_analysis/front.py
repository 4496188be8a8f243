"""Run time against error, from tables that `triptych export --errors` wrote. The front consists of the settings for which no
other setting has both a smaller time and a smaller error."""

import os

import numpy as np
import pandas as pd

from . import drawing, tables

AGAINST = ("limit", "reference")


def points(folder, against="limit", metric="rms", cost="median_ns"):
    """Returns one row for each configuration and device that has an error and a cost, with the columns device, scene, name,
    error (1 is full scale), cost, and front (whether the row is on the front of its device and scene). Returns None if there is
    no table of errors, because the tables were exported without --errors or because `folder` is a store."""
    if not os.path.exists(os.path.join(folder, "errors.csv")):
        return None
    if against not in AGAINST:
        raise tables.InputError(f"against {against}: expected one of {', '.join(AGAINST)}")
    errors = pd.read_csv(os.path.join(folder, "errors.csv"))
    records = pd.read_csv(os.path.join(folder, "records.csv"), low_memory=False)
    if cost not in records:
        raise tables.InputError(f"{folder}: records.csv has no column {cost}")
    chosen = errors[(errors["against"] == against) & (errors["metric"] == metric)]
    joined = records.merge(chosen, on="record")
    joined = joined.rename(columns={cost: "cost"})[["device", "scene", "name", "error", "cost"]]
    joined = joined[(joined["cost"] > 0) & (joined["error"] > 0)].reset_index(drop=True)
    # The step, the quadrature and similar factors change an image, but not the limit image (the exact solution,
    # relative to which errors are measured). Therefore these factors are removed from the name of the scene.
    joined["scene"] = joined["scene"].map(_subject)
    joined["front"] = False
    for _, rows in joined.groupby(["device", "scene"], sort=True):
        joined.loc[front(rows), "front"] = True
    return joined.sort_values(["device", "scene", "cost"], ignore_index=True)


SAMPLING = ("step", "quadrature", "ert", "adapt", "skip", "voxel")


def _subject(scene):
    return ",".join(each for each in scene.split(",") if not each.startswith(tuple(f"{factor}=" for factor in SAMPLING)))


def front(rows):
    """Returns the index of the rows that no other row beats in both cost and error. Of several equal rows, only the first is
    included."""
    order = rows.sort_values(["cost", "error"], kind="stable")
    best = order["error"].cummin().shift(fill_value=np.inf)
    return order.index[order["error"] < best]


def draw(chosen, most=6):
    """Returns a figure with one panel for each of the first `most` pairs of device and scene, or None if there are no
    points."""
    if chosen is None or chosen.empty:
        return None
    groups = list(chosen.groupby(["device", "scene"], sort=True))[:most]
    made, axes = drawing.figure(4, 3 * len(groups), rows=len(groups), squeeze=False)
    for place, ((device, scene), rows) in zip(axes[:, 0], groups):
        best = rows[rows["front"]]
        place.loglog(rows["cost"], rows["error"], "o", color=drawing.BLUE, markersize=3, label="configuration")
        place.loglog(best["cost"], best["error"], "-s", color=drawing.RED, markersize=4, label="front")
        place.set_title(f"{device}\n{scene}", fontsize=7)
        place.set_xlabel("time per frame in ns, logarithmic")
        place.set_ylabel("error (1 is full scale), logarithmic")
        place.legend(fontsize=7)
    return made
