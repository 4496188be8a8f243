"""Run time against error, from the tables of `triptych export --errors`: the settings that no other setting beats in both."""

import os

import numpy as np
import pandas as pd

from . import drawing, tables

AGAINST = ("limit", "reference")


def points(folder, against="limit", metric="rms", cost="median_ns"):
    """One row for each configuration and device that has an error and a cost: device, scene, name, error (full scale), cost, and
    whether it is on the front of its device and scene. None if the folder has no table of errors, because it was exported without
    --errors or because it is a store."""
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
    # The step and the quadrature change an image, but not its limit, so they do not distinguish scenes here.
    joined["scene"] = joined["scene"].map(_subject)
    joined["front"] = False
    for _, rows in joined.groupby(["device", "scene"], sort=True):
        joined.loc[front(rows), "front"] = True
    return joined.sort_values(["device", "scene", "cost"], ignore_index=True)


SAMPLING = ("step", "quadrature", "ert", "adapt", "skip", "voxel")


def _subject(scene):
    return ",".join(each for each in scene.split(",") if not each.startswith(tuple(f"{factor}=" for factor in SAMPLING)))


def front(rows):
    """The index of the rows that no other row beats in both cost and error; the first of equal ones."""
    order = rows.sort_values(["cost", "error"], kind="stable")
    best = order["error"].cummin().shift(fill_value=np.inf)
    return order.index[order["error"] < best]


def draw(chosen, most=6):
    """A figure with an axis for each of the first device and scene pairs; None without points."""
    if chosen is None or chosen.empty:
        return None
    groups = list(chosen.groupby(["device", "scene"], sort=True))[:most]
    made, axes = drawing.figure(4, 3 * len(groups), rows=len(groups), squeeze=False)
    for place, ((device, scene), rows) in zip(axes[:, 0], groups):
        best = rows[rows["front"]]
        place.loglog(rows["cost"], rows["error"], "o", color=drawing.BLUE, markersize=3, label="configuration")
        place.loglog(best["cost"], best["error"], "-s", color=drawing.RED, markersize=4, label="front")
        place.set_title(f"{device}\n{scene}", fontsize=7)
        place.set_xlabel("time of a frame in ns, logarithmic")
        place.set_ylabel("error in full scale, logarithmic")
        place.legend(fontsize=7)
    return made
