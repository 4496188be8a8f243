"""Creates data sets with a known structure for the tests in this folder."""

import itertools

import numpy as np
import pandas as pd

from triptych_analysis import dataset


def factorial(plan, value, signal="time", suite="volume", without=lambda at: False):
    """Returns a data set of all combinations of levels for which `without` is false. `plan` maps factors to their levels, and
    `value` computes the value of a combination."""
    combinations = [dict(zip(plan, each)) for each in itertools.product(*plan.values())]
    combinations = [each for each in combinations if not without(each)]
    values = np.array([value(each) for each in combinations], dtype=float)
    factors = {name: dataset.factor_of([each[name] for each in combinations]) for name in sorted(plan)}
    unit, clock = ("ms", "wall") if signal == "time" else ("instructions", "a counter")
    nothing = np.full(len(values), np.nan)
    return dataset.Dataset(suite, signal, unit, clock, values, factors, nothing, values, pd.DataFrame())


def records(*changes):
    """Returns rows like those of tables.read(). Each argument defines one row, by the columns in which it differs from an
    ordinary record."""
    ordinary = {"run": "r1", "suite": "volume", "plan": "volume/study", "technique": "raycast", "device": "a",
                "configuration": "camera=orbit_y:0/2,data=ball,technique=raycast", "outcome": "measured",
                "injected": None, "median_wall_ns": 11e6, "median_device_ns": 9e6, "device_clock_trusted": 1.0,
                "counted_by": None, "same_as": None, "started_at": "2026-01-01", "store": "s.sqlite", "processor": "p",
                "device_key": "a 1", "factor_camera": "orbit_y:0/2", "factor_data": "ball",
                "cost_device_code": np.nan, "cost_driver": np.nan, "cost_libc": np.nan}
    return pd.DataFrame([{"record": i, **ordinary, **each} for i, each in enumerate(changes, 1)])


ANSCOMBE_X = [10, 8, 13, 9, 11, 14, 6, 4, 12, 7, 5]
ANSCOMBE_Y = [8.04, 6.95, 7.58, 8.81, 8.33, 9.96, 7.24, 4.26, 10.84, 4.82, 5.68]


def anscombe(**more):
    """Returns the first data set of Anscombe (1973), with r = 0.81642 and the regression line 3.0001 + 0.50009 x."""
    return factorial({"device": ["x", "y"], "data": [str(i) for i in range(11)]},
                     lambda at: (ANSCOMBE_X if at["device"] == "x" else ANSCOMBE_Y)[int(at["data"])], **more)
