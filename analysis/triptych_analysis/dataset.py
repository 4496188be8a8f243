"""The input of the analysis: one observation for each configuration and device, in a separate data set for each suite and
signal (time or cost). All other modules use these data sets."""

import hashlib
import re
from dataclasses import dataclass, field

import numpy as np
import pandas as pd

from .tables import COST, FACTOR

# The parts of a frame's cost whose instruction counts are the same in every run. The counts for the C library and for the program
# differ from run to run.
COST_PARTS = ("device_code", "driver")
# The parts into which the camera is divided, as in the paper. With camera_path, the path is the factor, and the position on it
# is one of the other factors. With camera_rotation, the position on an orbit is the factor, and the axis of the orbit is one of
# the other factors. With camera_distance, the position on a straight path is the factor, and the axis of the path is one of the
# other factors.
CAMERA_PARTS = ("camera_path", "camera_rotation", "camera_distance")


@dataclass
class Factor:
    """The level of each observation. Observation i has levels[codes[i]], or no level if the code is -1."""

    levels: list
    codes: np.ndarray


@dataclass
class Dataset:
    suite: str
    signal: str  # "time" or "cost"
    unit: str  # "ms" or "instructions"
    clock: str  # "device" or "wall", the same for all observations; for cost, the emulator that counted
    values: np.ndarray
    factors: dict  # name → Factor; includes "device"
    device_ms: np.ndarray  # NaN if the device clock is not trusted; used only for times
    wall_ms: np.ndarray
    duplicates: pd.DataFrame
    notes: list = field(default_factory=list)

    def __len__(self):
        return len(self.values)

    def factor(self, name):
        """Returns the factor with this name, or the factor for a part of the camera (CAMERA_PARTS). All random views count as
        one path."""
        if name not in CAMERA_PARTS:
            return self.factors.get(name) or Factor([], np.full(len(self), -1))
        return self.camera_part(name, of_all=True)[0]

    def camera_part(self, part, of_all=False):
        """Returns a part of the camera as a factor, and the rest of the camera as another factor. An observation whose camera
        lacks the part has no level. Random views have the path "random" if `of_all` is true, and otherwise no path."""
        camera = self.factors.get("camera") or Factor([], np.full(len(self), -1))
        places = [_place(*view_of(each), part, of_all) for each in camera.levels]
        return (_recoded(camera.codes, [each and each[0] for each in places]),
                _recoded(camera.codes, [each and each[1] for each in places]))


def _place(path, position, part, of_all):
    if part == "camera_path":
        return (path, position) if path != "random" or of_all else None
    if part == "camera_rotation":
        return (position, path) if path.startswith("orbit_") else None
    return (position, path) if path in ("path_x", "path_y", "path_z") else None


def _recoded(codes, names):
    """Returns a factor with new names for the old levels. The name None means no level."""
    levels = natural_order({each for each in names if each is not None})
    place = {each: i for i, each in enumerate(levels)}
    new = np.array([place.get(each, -1) for each in names] + [-1])  # the last entry is for code -1
    return Factor(levels, new[codes])


def factor_of(texts):
    """Returns a factor whose levels are given as one string per observation. None means no level."""
    codes, names = pd.factorize(np.asarray(texts, dtype=object))  # None becomes -1
    return _recoded(codes, list(names))


def view_of(camera):
    """Splits a camera into its path and the position on the path: "orbit_y:1/8" → ("orbit_y", "1/8")"""
    path, _, position = camera.partition(":")
    return path, position


def number(text):
    """Returns the string as a number, or None if it is not a number."""
    try:
        return None if "_" in text or text != text.strip() else float(text)
    except ValueError:
        return None


def natural_order(levels):
    """Sorts levels so that numbers, and digits within strings, are ordered by value: "a10" comes after "a9"."""
    levels = list(levels)
    if all(number(each) is not None for each in levels):
        return sorted(levels, key=lambda each: (number(each), each))
    parts = {each: [int(part) if part.isdigit() else part for part in re.split("([0-9]+)", each)] for each in levels}
    return sorted(levels, key=lambda each: (parts[each], each))


def datasets(records, clock="auto"):
    """Returns the data sets in the records: for each suite the times, and also the cost if instructions were counted."""
    found = []
    for suite in sorted(records["suite"].unique()):
        of_suite = records[records["suite"] == suite]
        found.append(_times(suite, of_suite, clock))
        counted = _cost(suite, of_suite)
        if len(counted):
            found.append(counted)
    return found


def _times(suite, records, choice):
    notes = []
    emulated = records["counted_by"].notna()
    wall = np.where(records["median_wall_ns"] > 0, records["median_wall_ns"], np.nan)
    fit = _aside(records, notes, [(~(wall > 0), "without a time")], emulated)
    fit, duplicates = _latest(fit, notes)
    trusted = (fit["device_clock_trusted"] == 1) & (fit["median_device_ns"] > 0)
    device = np.where(trusted, fit["median_device_ns"] / 1e6, np.nan)
    clock = _clock(fit, trusted, choice, notes)
    if clock == "device":
        if not trusted.all():
            notes.append(f"{(~trusted).sum()} records without a trusted device time are not used")
        fit, device = fit[trusted], device[trusted.to_numpy()]
    wall = fit["median_wall_ns"].to_numpy() / 1e6
    return Dataset(suite, "time", "ms", clock, device if clock == "device" else wall, _factors(fit), device, wall,
                   duplicates, notes)


def _cost(suite, records):
    notes = []
    parts = [COST + each for each in COST_PARTS]
    none = pd.Series(False, records.index)
    if not set(parts) <= set(records.columns):
        records = records.iloc[:0]
    else:
        records = records[records[parts].notna().all(axis=1)]
    fit = _aside(records, notes, [], none.loc[records.index])
    fit, duplicates = _latest(fit, notes)
    values = fit[parts].sum(axis=1).to_numpy(dtype=float) if len(fit) else np.zeros(0)
    nothing = np.full(len(fit), np.nan)
    counted = ", ".join(natural_order(set(fit["counted_by"].dropna())))
    return Dataset(suite, "cost", "instructions", counted, values, _factors(fit), nothing, nothing, duplicates, notes)


def _aside(records, notes, more, emulated):
    """Drops records that are not observations. Adds a note for each reason, with the number of dropped records."""
    outcome = records["outcome"].astype(str)
    reasons = [(outcome != "measured", "with the outcome '" + outcome + "' on " + records["device"].astype(str)),
               (records["injected"].notna(), "with an injected fault"),
               # A record with copied frames is not an independent observation, because its value always equals that of its
               # original.
               (records["same_as"].notna(), "with frames copied from an equivalent configuration"),
               (records["technique"] == "speed_of_light", "of a technique that makes no image"),
               (emulated, "with instructions counted by an emulator, which distorts times,")]
    reasons += [(wrong, text + " on " + records["device"].astype(str)) for wrong, text in more]
    aside = pd.Series(None, index=records.index, dtype=object)
    for wrong, text in reversed(reasons):
        text = text if isinstance(text, pd.Series) else pd.Series(text, index=records.index)
        aside = aside.where(~np.asarray(wrong, dtype=bool), text)
    for reason, count in aside.value_counts().sort_index().items():
        notes.append(f"{count} records {reason} are not used")
    return records[aside.isna()]


def _latest(records, notes):
    """Returns the latest record of every configuration on every device, and a table of the earlier records, which are dropped.
    This table has a row for each dropped record: its device and configuration, the run and the store of the record that is used
    instead (`taken`), and those of the dropped record (`dropped`). The level of a device is its id, followed by a hash if several
    drivers or processors have the same id."""
    identity = records["device_key"].fillna("") + records["processor"].map(lambda each: f"|{each}" if each else "")
    level = records["device"].copy()
    for device, of_device in identity.groupby(records["device"]):
        names = sorted(of_device.unique())
        if len(names) == 1:
            continue
        for name in names:
            short = f"{device}@{hashlib.sha256(name.encode()).hexdigest()[:8]}"
            notes.append(f"{short} stands for the device with the key and processor {name}")
            level[of_device.index[of_device == name]] = short
    records = records.assign(level=level, place=records["run"] + " in " + records["store"])
    records = records.sort_values(["level", "configuration", "started_at", "run"], kind="stable")
    taken = records.drop_duplicates(["level", "configuration"], keep="last")
    dropped = records[records.duplicated(["level", "configuration"], keep="last")]
    places = taken.set_index(["level", "configuration"])["place"]
    keys = pd.MultiIndex.from_frame(dropped[["level", "configuration"]])
    duplicates = pd.DataFrame({"device": dropped["level"].to_numpy(),
                               "configuration": dropped["configuration"].to_numpy(),
                               "taken": places.reindex(keys).to_numpy(), "dropped": dropped["place"].to_numpy()})
    return taken, duplicates


def _clock(fit, trusted, choice, notes):
    if choice != "auto":
        return choice
    for device, count in (~trusted).groupby(fit["level"]).sum().items():
        if count:
            notes.append(f"the wall clock is used for all records, because {count} records of {device} have no trusted "
                         "device time")
    return "device" if trusted.all() else "wall"


def _factors(fit):
    """Returns the factors of the records. A factor with several levels is omitted if no configuration names it, because each
    device chose the level itself."""
    factors = {}
    configurations = fit["configuration"].unique()
    for column in sorted(each for each in fit.columns if each.startswith(FACTOR)):
        name, texts = column[len(FACTOR):], fit[column]
        if texts.isna().all():
            continue
        named = re.compile(f"(^|,){re.escape(name)}=")
        if texts.nunique() > 1 and not any(named.search(each) for each in configurations):
            continue
        factors[name] = factor_of(texts)
    factors["device"] = factor_of(fit["level"])
    return dict(sorted(factors.items()))
