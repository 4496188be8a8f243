"""Tests the Pareto front of run time and error with tables whose front is known."""

import os
import tempfile
import unittest

import pandas as pd
from triptych_analysis import front, notebook, tables


class Front(unittest.TestCase):
    def setUp(self):
        self.folder = self.enterContext(tempfile.TemporaryDirectory())

    def write(self, costs, errors):
        pd.DataFrame([
            {"record": i + 1, "device": "gl:x", "scene": f"camera=c,data=ball,step={i}", "name": f"p.s{i}", "median_ns": cost}
            for i, cost in enumerate(costs)]).to_csv(os.path.join(self.folder, "records.csv"), index=False)
        rows = [{"record": i + 1, "against": "limit", "metric": "rms", "error": error} for i, error in enumerate(errors)]
        rows += [{"record": 1, "against": "reference", "metric": "rms", "error": 1e-9},
                 {"record": 1, "against": "limit", "metric": "max", "error": 0.5}]
        pd.DataFrame(rows).to_csv(os.path.join(self.folder, "errors.csv"), index=False)

    def test_what_nothing_beats_is_on_it(self):
        self.write(costs=[10, 20, 30, 40], errors=[0.1, 0.2, 0.05, 0.05])
        found = front.points(self.folder)
        self.assertEqual(list(found[found["front"]]["name"]), ["p.s0", "p.s2"])
        self.assertEqual(set(found["scene"]), {"camera=c,data=ball"})
        self.assertIn("<svg", front.draw(found)._repr_svg_())

    def test_what_has_no_time_is_left_out(self):
        self.write(costs=[10, None], errors=[0.1, 0.05])
        self.assertEqual(list(front.points(self.folder)["name"]), ["p.s0"])

    def test_other_errors_are_chosen(self):
        self.write(costs=[10, 20], errors=[0.1, 0.05])
        self.assertEqual(list(front.points(self.folder, against="reference")["error"]), [1e-9])
        self.assertEqual(list(front.points(self.folder, metric="max")["error"]), [0.5])
        with self.assertRaises(tables.InputError):
            front.points(self.folder, against="truth")

    def test_an_export_without_errors_has_none(self):
        self.assertIsNone(front.points(self.folder))
        self.assertIsNone(front.draw(None))


class Notebook(unittest.TestCase):
    def test_figures_are_named_after_their_headings(self):
        used = set()
        names = [notebook.file_name("Time against error: which settings are worth their time?", used) for _ in range(2)]
        self.assertEqual(names, ["time_against_error.svg", "time_against_error_2.svg"])

    def test_empty_results_are_not_shown(self):
        for value in (None, pd.DataFrame(columns=["a"])):
            self.assertFalse(notebook.show(value, "title", ".", set(), "title"))
        self.assertTrue(notebook.show(pd.DataFrame({"a": [1]}), "", ".", set(), "title"))


if __name__ == "__main__":
    unittest.main()
