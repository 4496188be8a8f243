"""Divides observations by the levels of a factor, and pairs observations with different levels."""

from dataclasses import dataclass

import numpy as np

from .dataset import CAMERA_PARTS, natural_order


@dataclass
class Split:
    """rows[key, level] is the index of the observation with this key and level, or -1. A key is a combination of levels of all
    other factors."""

    factor: str
    levels: list  # in natural order
    rows: np.ndarray

    def values(self, dataset):
        return np.where(self.rows >= 0, dataset.values[self.rows], np.nan)


def split(dataset, factor):
    if factor in CAMERA_PARTS:
        own, stays = dataset.camera_part(factor)
        others = [each.codes for name, each in dataset.factors.items() if name != "camera"] + [stays.codes]
    else:
        own = dataset.factor(factor)
        others = [each.codes for name, each in dataset.factors.items() if name != factor]
    here = np.flatnonzero(own.codes >= 0)
    keys, count = combined([each[here] for each in others], len(here))
    # Drops levels that do not occur.
    present, codes = np.unique(own.codes[here], return_inverse=True)
    rows = np.full((count, len(present)), -1)
    rows[keys[::-1], codes[::-1]] = here[::-1]  # if several observations have the same key and level, the first one is used
    return Split(factor, [own.levels[each] for each in present], rows)


def combined(columns, length):
    """Numbers the different rows of a table of level codes, starting from 0. `columns` are the columns of the table, and `length`
    is the number of its rows. Returns the number of each row, and how many different rows there are."""
    keys = np.zeros(length, dtype=np.int64)
    count = 1
    for column in columns:
        width = int(column.max(initial=-1)) + 2
        _, keys = np.unique(keys * width + column + 1, return_inverse=True)
        count = int(keys.max(initial=-1)) + 1
    return keys, count if length else 0


def factors_of(dataset):
    """Returns the sorted names of the factors with at least two levels. "camera" is replaced by its parts."""
    found = []
    for name in scope(dataset, np.arange(len(dataset)))["varied"]:
        if name == "camera":
            found += [part for part in CAMERA_PARTS if len(split(dataset, part).levels) > 1]
        else:
            found.append(name)
    return sorted(found)


def scope(dataset, rows):
    """Describes observations: their number (`samples`), the names of the factors that vary (`varied`), and the factors that have
    the same level in all of them (`held`), as one string such as "step=1, viewport=64"."""
    held, varied = {}, []
    for name, factor in dataset.factors.items():
        present = np.unique(factor.codes[rows])
        present = present[present >= 0]
        if len(present) == 1:
            held[name] = factor.levels[present[0]]
        elif len(present):
            varied.append(name)
    return {"samples": len(rows), "varied": varied, "held": ", ".join(f"{name}={held[name]}" for name in sorted(held))}


def fullest_block(dataset, factors, among=None):
    """Selects observations (from all observations, or from `among`) whose means can be compared, because they differ only in
    the given factors. A key is a combination of levels of all other factors. Each key was measured with a set of combinations
    of the given factors, and keys with the same set form a group. The group with the largest set is selected; if several groups
    have a set of that size, the group with the most observations. If a given factor is a part of the camera, the whole camera
    is excluded from the key."""
    own = [dataset.factor(each).codes for each in factors]
    here = np.arange(len(dataset)) if among is None else among
    here = here[np.all([each[here] >= 0 for each in own], axis=0)]
    if not len(here):
        return here
    out = {"camera" if each in CAMERA_PARTS else each for each in factors}
    keys, key_count = combined([each.codes[here] for name, each in dataset.factors.items() if name not in out], len(here))
    combinations, combination_count = combined([each[here] for each in own], len(here))
    has = np.zeros((key_count, combination_count), dtype=bool)
    has[keys, combinations] = True
    sets, set_of_key = np.unique(np.packbits(has, axis=1), axis=0, return_inverse=True)
    set_of_key = set_of_key.reshape(-1)
    sizes = np.unpackbits(sets, axis=1).sum(axis=1)
    members = np.bincount(set_of_key[keys], minlength=len(sets))
    fullest = max(range(len(sets)), key=lambda each: (sizes[each], members[each]))
    return here[set_of_key[keys] == fullest]


def levels_in(dataset, factor, rows):
    """Returns {level: its observations} for the observations in `rows`, in natural order."""
    of = dataset.factor(factor)
    codes = of.codes[rows]
    return {level: rows[codes == of.levels.index(level)]
            for level in natural_order({of.levels[each] for each in np.unique(codes) if each >= 0})}
