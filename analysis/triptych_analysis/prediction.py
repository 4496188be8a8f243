"""The quality of predictions (section 5.3 of the paper). One linear regression for each data structure is compared with one
random forest for all observations. The observations are divided at random, with a given seed, into training and held-out
observations."""

import numpy as np
import pandas as pd
from sklearn.ensemble import RandomForestRegressor
from sklearn.linear_model import LinearRegression

from .dataset import number
from .splits import combined, scope

TRAIN_SHARE = 0.7
LEAST = 40
MOST_FOR_A_TREE = 100_000  # rows in the bootstrap sample of a tree
# The factors that define the data structure, for both suites. As in the paper, these are data, transfer function, acceleration
# and camera, and for particles also the other factors that change the scene.
STRUCTURE = {"adapt", "camera", "colour", "culling", "data", "ert", "fov", "precision", "radius_scale", "skip",
             "transfer_function"}
COLUMNS = ["data", "models", "held_out", "line_r2", "forest_r2", "trained", "structures", "structures_left_out",
           "line_features", "structure", "held"]


def r_squared(values, predicted):
    """Returns R² = 1 − Σ(y − ŷ)²/Σ(y − ȳ)² for the values y, their mean ȳ and the predicted values ŷ. Returns NaN if there are
    fewer than two values or if all values are equal."""
    total = ((values - values.mean()) ** 2).sum() if len(values) > 1 else 0
    return 1 - ((values - predicted) ** 2).sum() / total if total > 0 else np.nan


class Encoder:
    """Turns the levels of a factor into numbers. A viewport becomes its number of pixels, and a step becomes the number of
    samples per voxel, because times depend linearly on both. A category becomes its index among the levels."""

    def __init__(self, dataset, name):
        self.name, self.factor = name, dataset.factors[name]
        numbers = [_number(name, each) for each in self.factor.levels]
        self.numeric = all(each is not None for each in numbers)
        self.of_level = np.array([*(numbers if self.numeric else range(len(numbers))), -1.0])

    def title(self):
        if not self.numeric:
            return f"{self.name} (category)"
        return {"viewport": "viewport (pixels)", "step": "step (samples per voxel)"}.get(self.name, self.name)

    def codes(self, rows):
        return self.of_level[self.factor.codes[rows]][:, None]

    def indicators(self, rows, among):
        """Returns the columns of a linear model for the observations `rows`. A numeric factor has one column, which contains its
        numbers. A category has a column of zeros and ones for every level that occurs in the observations `among`, except the
        first level."""
        if self.numeric:
            return self.codes(rows)
        present = np.unique(self.factor.codes[among])
        return (self.factor.codes[rows][:, None] == present[1:]).astype(float)


def _number(name, level):
    if name == "viewport":
        sides = [number(each) for each in level.split("x")]
        return None if None in sides else sides[0] * sides[-1]
    value = number(level)
    return 1 / value if name == "step" and value else value


def predict(dataset, seed):
    """Returns a table of scores, and the reason if the table is empty. There is one row for each level of `data`, then a row
    "all", rows with the mean, the minimum and the maximum over the levels of `data`, and the forest's score for all held-out
    observations. The columns are COLUMNS:

    data                  the level of `data`, or the name of a summary such as "all"
    models                number of linear models, one for each data structure
    held_out              number of held-out observations that are predicted
    line_r2, forest_r2    R² of the linear models and of the random forest for these observations
    trained               number of training observations of the forest
    structures            number of data structures among the held-out observations
    structures_left_out   number of structures with too few training observations for a linear model
    line_features         the factors that the linear models use, if they vary
    structure             the factors that vary and define the data structure
    held                  the factors that have only one level, such as "shading=none, viewport=64"
    """
    everything = np.arange(len(dataset))
    if len(dataset) < LEAST:
        return pd.DataFrame(columns=COLUMNS), f"there are {len(dataset)} observations; {LEAST} are needed"
    varied = scope(dataset, everything)["varied"]
    if not varied:
        return pd.DataFrame(columns=COLUMNS), "no factor varies"
    order = np.random.default_rng(seed).permutation(len(dataset))
    cut = int(TRAIN_SHARE * len(dataset))
    predicted = _predicted(dataset, varied, order[:cut], order[cut:], seed)
    return _scores(dataset, varied, predicted, cut), ""


def _predicted(dataset, varied, trained, held_out, seed):
    """Returns one row for each held-out observation: data, structure, value, forest (its prediction), line (the prediction of
    the linear model, or NaN if there were too few training observations with this structure)."""
    encoders = [Encoder(dataset, each) for each in varied]
    forest = RandomForestRegressor(200, max_depth=25, max_features="sqrt", random_state=seed, n_jobs=-1,
                                   max_samples=MOST_FOR_A_TREE if len(trained) > MOST_FOR_A_TREE else None)
    forest.fit(np.hstack([each.codes(trained) for each in encoders]), dataset.values[trained])
    forest.set_params(n_jobs=1)  # several jobs would add their results in random order, which could change the last digit
    structures, _ = combined([each.codes for name, each in dataset.factors.items() if name in STRUCTURE], len(dataset))
    line = np.full(len(dataset), np.nan)
    to_learn = _by_structure(structures, trained)
    for structure, rows in _by_structure(structures, held_out).items():
        _predict_structure(dataset, to_learn.get(structure, trained[:0]), rows, line)
    data = dataset.factor("data")
    return pd.DataFrame({"data": [data.levels[each] for each in data.codes[held_out]], "structure": structures[held_out],
                         "value": dataset.values[held_out], "line": line[held_out],
                         "forest": forest.predict(np.hstack([each.codes(held_out) for each in encoders]))})


def _by_structure(structures, rows):
    """Returns {structure: its rows}."""
    rows = rows[np.argsort(structures[rows], kind="stable")]
    names, starts = np.unique(structures[rows], return_index=True)
    return dict(zip(names, np.split(rows, starts[1:])))


def _predict_structure(dataset, trained, held_out, line):
    """Fits a linear model to the training observations of one structure, using the factors that vary in it. Writes its
    predictions to `line`, unless there are too few training observations."""
    both = np.concatenate([trained, held_out])
    encoders = [Encoder(dataset, each) for each in scope(dataset, both)["varied"] if each not in STRUCTURE]
    learned, asked = (np.hstack([np.zeros((len(rows), 0)), *(each.indicators(rows, both) for each in encoders)])
                      for rows in (trained, held_out))
    if len(trained) < learned.shape[1] + 3:
        return
    if not learned.shape[1]:
        line[held_out] = dataset.values[trained].mean()
        return
    line[held_out] = LinearRegression().fit(learned, dataset.values[trained]).predict(asked)


def _scores(dataset, varied, predicted, trained):
    lined = predicted.dropna(subset=["line"])
    structures = predicted["structure"].nunique()
    titles = [Encoder(dataset, each).title() for each in varied if each not in STRUCTURE]
    about = (trained, structures, structures - lined["structure"].nunique(), ", ".join(titles),
             ", ".join(each for each in varied if each in STRUCTURE), scope(dataset, np.arange(len(dataset)))["held"])
    rows = [(data, *_score(of_data), *about) for data, of_data in lined.groupby("data")]
    lines = [each[3] for each in rows if np.isfinite(each[3])]
    if len(lined):
        rows.append(("all", *_score(lined), *about))
    for name, of in (("mean", np.mean), ("least", min), ("largest", max)):
        rows.append((f"{name} of data sets", None, None, of(lines) if lines else np.nan, np.nan, *about))
    rows.append(("every held-out observation", None, len(predicted), np.nan,
                 r_squared(predicted["value"].to_numpy(), predicted["forest"].to_numpy()), *about))
    return pd.DataFrame(rows, columns=COLUMNS)


def _score(of):
    value = of["value"].to_numpy()
    return (of["structure"].nunique(), len(of), r_squared(value, of["line"].to_numpy()),
            r_squared(value, of["forest"].to_numpy()))
