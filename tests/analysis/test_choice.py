"""Tests the choice of a technique by the number of spheres, and the influence of each factor."""

import unittest

import numpy as np

import synthetic
from triptych_analysis import analysis, choice, correlation, tables


def spheres(**more):
    """Returns times of two techniques: quad takes 1 + N/1000 ms, and tiles takes 3 + N/4000 ms for N spheres. Therefore,
    quad is faster below 2667 spheres, and tiles is faster above."""
    def value(at):
        count = int(at["data"].split(":")[2])
        return 1 + count / 1e3 if at["technique"] == "quad" else 3 + count / 4e3
    return synthetic.factorial({"device": ["gl:x", "gl:y"], "technique": ["quad", "tiles"],
                                "data": ["generate:uniform:1000", "generate:uniform:16000", "generate:layer:1000"],
                                "camera": ["orbit_y:0/2", "orbit_y:1/2"]}, value, suite="particles", **more)


class Techniques(unittest.TestCase):
    def test_as_measured(self):
        counts = choice.by_count(spheres())
        of = choice.technique_for(counts, "gl:x", 1000)
        self.assertEqual(list(of["technique"]), ["quad", "tiles"])
        self.assertEqual(list(of["mean_ms"]), [2, 3.25])
        self.assertEqual(list(of["from"]), ["measured"] * 2)
        self.assertEqual(list(choice.technique_for(counts, "gl:*", 16000)["technique"]), ["tiles", "quad"] * 2)

    def test_by_a_line_where_nothing_was_measured_and_it_says_so(self):
        of = choice.technique_for(choice.by_count(spheres()), "gl:y", 4000)
        self.assertEqual(set(of["from"]), {"1000 and 16000"})
        quad = of.set_index("technique").loc["quad", "mean_ms"]
        self.assertAlmostEqual(quad, np.sqrt(2 * 17))  # 4000 is halfway between 1000 and 16000 on a logarithmic axis

    def test_nothing_far_from_what_was_measured(self):
        counts = choice.by_count(spheres())
        self.assertEqual(len(choice.technique_for(counts, "gl:*", 160_000)), 4)
        self.assertEqual(len(choice.technique_for(counts, "gl:*", 161_000)), 0)
        self.assertEqual(len(choice.technique_for(counts[counts["count"] == 1000], "gl:*", 2000)), 0)
        self.assertEqual(len(choice.technique_for(None, "gl:*", 2000)), 0)

    def test_a_technique_without_a_count_is_not_compared(self):
        """A view counts only if it was measured with every technique and every number of spheres, because the means of the
        techniques would otherwise cover different configurations. On gl:x, tiles lacks one of the two views."""
        data = spheres(without=lambda at: at["technique"] == "tiles" and at["camera"] == "orbit_y:1/2"
                       and at["data"] == "generate:uniform:16000" and at["device"] == "gl:x")
        counts = choice.by_count(data)
        self.assertEqual(set(counts[counts["device"] == "gl:x"]["samples"]), {1})
        self.assertEqual(set(counts[counts["device"] == "gl:y"]["samples"]), {2})

    def test_means_come_from_comparable_configurations(self):
        data = synthetic.factorial({"device": ["a", "b"], "data": ["x", "y"], "step": ["1", "2"]},
                                   lambda at: float(at["step"]),
                                   without=lambda at: at == {"device": "b", "data": "y", "step": "2"})
        means = choice.mean_values(data, "data", "device")
        # Device b lacks a measurement with step 2, so only step 1 may be used. With step 2, the other three means would be
        # larger.
        self.assertEqual(list(means["mean_ms"]), [1] * 4)
        self.assertEqual(set(means["held"]), {"step=1"})
        self.assertTrue(choice.mean_values(data, "data", "technique").empty)


class Effects(unittest.TestCase):
    def test_shares_of_a_product(self):
        """For device i = 0, 1 and step j = 0, 1, 2, the logarithm of the value is i·ln 2 + j·ln 3. The variances of the two
        terms are (ln 2)²/4 and (ln 3)²·2/3."""
        data = synthetic.factorial({"device": ["0", "1"], "step": ["0", "1", "2"], "data": list("abcd")},
                                   lambda at: 2.0 ** int(at["device"]) * 3.0 ** int(at["step"]))
        effects = choice.effects(data, ["data", "device", "step"]).set_index("factor")
        first, second = np.log(2) ** 2 / 4, np.log(3) ** 2 * 2 / 3
        self.assertAlmostEqual(effects.loc["step", "share"], second / (first + second))
        self.assertAlmostEqual(effects.loc["device", "share"], first / (first + second))
        self.assertAlmostEqual(effects.loc["data", "share"], 0)
        self.assertEqual(effects.index[0], "step")
        self.assertAlmostEqual(effects.loc["step", "largest_ratio"], 9)
        self.assertEqual((effects.loc["step", "cheap"], effects.loc["step", "expensive"]), ("0", "2"))


class Whole(unittest.TestCase):
    def test_says_what_is_left_out_and_why(self):
        of = analysis.analyse(synthetic.factorial({"device": ["a"], "data": ["x"]}, lambda at: 1.0))
        self.assertTrue(of.empty())
        self.assertGreaterEqual(len(of.left_out), 5)
        self.assertTrue(all(why for _, why in of.left_out))

    def test_a_reference_that_no_data_set_has_is_refused(self):
        both = [synthetic.anscombe(), synthetic.factorial({"device": ["v", "w"], "step": ["1"]}, lambda at: 1.0)]
        for references, says in (({"device": "z"}, "reference device=z: the levels of that factor are v, w, x, y"),
                                 ({"stop": "1"}, "reference stop=1: no record has a factor stop")):
            with self.assertRaisesRegex(tables.InputError, says):
                correlation.require_references(both, references)
        correlation.require_references(both, {"device": "w", "step": "1"})

    def test_a_reference_that_another_suite_has_is_told(self):
        of = analysis.analyse(synthetic.anscombe(), {"device": "y"})
        self.assertIn("y", set(of.table("speed_ups")["reference"]))
        of = analysis.analyse(synthetic.anscombe(), {"device": "w"})
        self.assertEqual(set(of.table("speed_ups")["reference"]) & set("xyw"), {"x"})
        self.assertIn(("speed-up relative to device=w", "no record of this data set has that level; speed-ups are relative to x instead"),
                      of.left_out)


if __name__ == "__main__":
    unittest.main()
