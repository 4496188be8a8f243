"""Tests the ray-tracing study with made-up times whose ratios are known. No device is needed."""

import io
import tempfile
import unittest
from contextlib import redirect_stderr
from pathlib import Path

import numpy as np

from triptych_analysis import dataset, rays


def observed(rows):
    """Creates a data set from tuples (device, count, camera, technique, structure, ms)."""
    columns = list(zip(*rows))
    factors = {name: dataset.factor_of(list(texts))
               for name, texts in zip(("device", "data", "camera", "technique", "structure"),
                                      (columns[0], [f"generate:uniform:{n}" for n in columns[1]], *columns[2:5]))}
    values = np.array(columns[5], dtype=float)
    return dataset.Dataset("particles", "time", "ms", "wall", values, factors, values, values, None)


ROWS = [("a", 1000, "far", "tiles", "static", 2.0), ("a", 1000, "far", "point", "static", 4.0),
        ("a", 1000, "near", "tiles", "static", 9.0), ("a", 1000, "near", "point", "static", 8.0),
        ("a", 1000, "far", "bvh", "static", 1.0), ("a", 1000, "near", "bvh", "static", 16.0),
        ("a", 1000, "far", "ray_query", "static", 3.0), ("a", 1000, "near", "ray_query", "static", 20.0),
        ("a", 1000, "far", "bvh", "rebuild", 6.0), ("a", 1000, "far", "ray_query", "rebuild", 7.0)]


class Rays(unittest.TestCase):
    def test_the_fastest_of_each_kind_is_compared_in_each_scene(self):
        table = rays.compare(rays.observations(observed(ROWS))).set_index("mode")
        # The time of the fastest ray-tracing technique, divided by the time of the fastest other technique, is 1 / 2 for the view
        # far and 16 / 8 for the view near. The geometric mean of these ratios is 1.
        self.assertAlmostEqual(table.loc["static", "ratio"], 1)
        self.assertEqual(table.loc["static", "scenes"], 2)
        self.assertEqual(table.loc["static", "rays"], "bvh")

    def test_a_scene_that_was_not_rebuilt_is_left_out(self):
        table = rays.compare(rays.observations(observed(ROWS))).set_index("mode")
        self.assertAlmostEqual(table.loc["rebuild", "ratio"], 3)
        self.assertEqual(table.loc["rebuild", "scenes"], 1)
        self.assertNotIn("refit", table.index)

    def test_the_table_has_a_dash_for_what_was_not_measured(self):
        text = rays.markdown(rays.compare(rays.observations(observed(ROWS))))
        self.assertEqual(text.splitlines()[-1], "| a | 1,000 | `point` | `bvh` | 1.00 | – | 3.00 |")

    def test_a_source_that_is_missing_is_an_error(self):
        with tempfile.TemporaryDirectory() as folder, redirect_stderr(io.StringIO()) as said:
            self.assertEqual(rays.main([str(Path(folder) / "none.sqlite"), "--out", folder]), 3)
        self.assertIn("no such file", said.getvalue())


if __name__ == "__main__":
    unittest.main()
