"""Compares statistics with values from textbooks and from manual computation."""

import itertools
import unittest

import numpy as np

import synthetic
from triptych_analysis import correlation, dataset, distribution, prediction, splits, views


class KolmogorovSmirnov(unittest.TestCase):
    def test_two_samples_by_hand(self):
        a, b = [1, 2, 3, 4], [2.5, 3.5, 5, 6]
        d, p = views.ks_two_samples(a, b)
        self.assertAlmostEqual(d, 0.5)  # at 2, the distribution functions are 2/4 and 0/4
        # d is the distance between the distribution functions of a and b. p is the probability that d is at least 0.5 if all ways
        # to split the eight values into two groups of four are equally likely.
        as_far = 0
        orders = list(itertools.combinations(range(8), 4))
        for first in orders:
            steps = np.cumsum([1 if i in first else -1 for i in range(8)]) / 4
            as_far += np.abs(steps).max() >= 0.5 - 1e-9
        self.assertAlmostEqual(p, as_far / len(orders))

    def test_large_samples_have_the_same_distance(self):
        random = np.random.default_rng(2)
        a, b = random.integers(0, 50, 3000) * 1.0, np.sort(random.integers(3, 55, 4000) * 1.0)  # with ties
        d, p = views.ks_two_samples(a, b)
        values = np.arange(0, 60)
        by_hand = max(abs((a <= x).mean() - (b <= x).mean()) for x in values)
        self.assertAlmostEqual(d, by_hand)
        self.assertLess(p, 1e-6)
        d, p = views.ks_two_samples(random.random(3000), np.sort(random.random(4000)))
        self.assertGreater(p, 0.01)

    def test_one_sample_by_hand(self):
        # The mean of ln x = −1, 0, 1 is 0, and its standard deviation is √(2/3). With the normal distribution function Φ, the
        # fitted log-normal distribution has the value Φ(−1/√(2/3)) = Φ(−1.2247) = 0.11034 at the smallest x, where the empirical
        # distribution function reaches 1/3.
        d, _ = distribution.ks_log_normal(np.exp([-1.0, 0.0, 1.0]))
        self.assertAlmostEqual(d, 1 / 3 - 0.11034, places=5)

    def test_lilliefors_has_its_textbook_value(self):
        # Lilliefors (1967) tabulates a critical value of 0.190 for n = 20 at 5 %. The tolerance is needed because this
        # implementation divides the variance by n instead of n − 1.
        self.assertAlmostEqual(distribution.lilliefors_p(0.190, 20, 4000, 1), 0.05, delta=0.015)

    def test_log_normal_samples_are_rejected_as_often_as_the_level_says(self):
        random = np.random.default_rng(7)
        rejected = 0
        for seed in range(60):
            values = random.lognormal(1, 0.7, 60)
            d, naive = distribution.ks_log_normal(values)
            p = distribution.lilliefors_p(d, 60, 199, seed)
            rejected += p < 0.05
            self.assertGreater(naive, p - 0.01)  # the naive test ignores that the parameters were fitted
        self.assertLessEqual(rejected, 9)  # 3 are expected; the probability of more than 9 is 1/500

    def test_gamma_samples_are_rejected(self):
        values = np.random.default_rng(3).gamma(2.0, 1.0, 1500)
        d, _ = distribution.ks_log_normal(values)
        self.assertLess(distribution.lilliefors_p(d, 1500, 199, 1), 0.01)


class Distributions(unittest.TestCase):
    def test_fit_is_by_maximum_likelihood(self):
        mu, sigma = distribution.fit_log_normal(np.exp([1.0, 2.0, 3.0]))
        self.assertAlmostEqual(mu, 2)
        self.assertAlmostEqual(sigma, np.sqrt(2 / 3))

    def test_percentiles_interpolate_and_bins_hold_everything(self):
        data = synthetic.factorial({"device": ["a"], "data": [str(i) for i in range(400)]},
                                   lambda at: 1 + int(at["data"]))
        fits, percentiles, bins = distribution.distributions(data, 1)
        of_all = percentiles[percentiles["of"] == "all"].set_index("percentile")["ms"]
        self.assertAlmostEqual(of_all[50], 200.5)
        self.assertAlmostEqual(of_all[5], 1 + 0.05 * 399)
        self.assertEqual(list(fits["of"]), ["all", "device=a"])
        for _, of in bins.groupby(["of", "scale"]):
            self.assertEqual(of["count"].sum(), 400)

    def test_fewer_than_eight_or_constant_values_have_none(self):
        few = synthetic.factorial({"device": ["a"], "data": list("1234567")}, lambda at: float(at["data"]))
        self.assertTrue(distribution.distributions(few, 1)[0].empty)
        constant = synthetic.factorial({"device": ["a"], "data": list("123456789")}, lambda at: 1.0)
        self.assertTrue(distribution.distributions(constant, 1)[0].empty)


class Correlation(unittest.TestCase):
    def test_anscombe(self):
        data = synthetic.anscombe()
        devices = splits.split(data, "device")
        cell = correlation.correlations(data, devices).iloc[0]
        self.assertEqual((cell.a, cell.b, cell.pairs), ("x", "y", 11))
        self.assertAlmostEqual(cell.r, 0.81642, places=5)
        line = correlation.speed_ups(data, devices, "y").iloc[0]
        self.assertAlmostEqual(line.speed_up, 0.50009, places=5)
        self.assertAlmostEqual(line.intercept_ms, 3.00009, places=5)
        self.assertAlmostEqual(line.error, (1 - 0.81642) * 0.50009, places=5)

    def test_known_pairs(self):
        random = np.random.default_rng(5)
        def value(at):
            base = float(at["data"]) * (1 if at["viewport"] == "96" else 4)
            return {"a": base, "b": 3 + 2 * base, "c": random.uniform(1, 10)}[at["device"]]
        data = synthetic.factorial({"device": ["a", "b", "c"], "data": [str(i) for i in range(1, 11)],
                                    "viewport": ["96", "192"], "step": ["1"]}, value)
        devices = splits.split(data, "device")
        cells = correlation.correlations(data, devices).set_index(["a", "b"])
        self.assertAlmostEqual(cells.loc[("a", "b"), "r"], 1)
        self.assertLess(abs(cells.loc[("a", "c"), "r"]), 0.6)
        self.assertEqual(cells.iloc[0]["samples"], 60)
        self.assertEqual(cells.iloc[0]["held"], "step=1")
        line = correlation.speed_ups(data, devices, "b").iloc[0]
        self.assertAlmostEqual(line.speed_up, 2)  # b takes twice as long, plus 3 ms
        self.assertAlmostEqual(line.intercept_ms, 3)

    def test_only_what_both_levels_have_is_paired(self):
        data = synthetic.anscombe(without=lambda at: at["device"] == "y" and int(at["data"]) in (1, 4, 9))
        cell = correlation.correlations(data, splits.split(data, "device")).iloc[0]
        left = [i for i in range(11) if i not in (1, 4, 9)]
        self.assertEqual(cell.pairs, 8)
        self.assertAlmostEqual(cell.r, np.corrcoef(np.take(synthetic.ANSCOMBE_X, left),
                                                   np.take(synthetic.ANSCOMBE_Y, left))[0, 1])

    def test_three_pairs_have_no_r(self):
        data = synthetic.anscombe(without=lambda at: at["device"] == "y" and int(at["data"]) > 2)
        cells = correlation.correlations(data, splits.split(data, "device"))
        self.assertEqual(cells.iloc[0].pairs, 3)
        self.assertTrue(np.isnan(cells.iloc[0].r))
        self.assertIsNone(correlation.box(cells))

    def test_a_constant_level_has_no_r(self):
        data = synthetic.factorial({"device": ["a", "b"], "data": list("12345")},
                                   lambda at: 1.0 if at["device"] == "a" else float(at["data"]))
        self.assertTrue(np.isnan(correlation.correlations(data, splits.split(data, "device")).iloc[0].r))

    def test_stacks_are_sizes_of_one_name(self):
        data = synthetic.factorial(
            {"data": ["generate:a:32", "generate:a:64", "generate:b:32", "file.nrrd"],
             "camera": [f"random:{i}" for i in range(1, 5)]},
            lambda at: float(at["camera"][7:]) * (8 if at["data"].endswith("64") else 1))
        stacks = correlation.stacks(data)
        self.assertEqual(list(stacks), ["generate:a"])
        self.assertAlmostEqual(correlation.box(stacks["generate:a"])["mean"], 1)


class Splits(unittest.TestCase):
    def test_parts_of_the_camera(self):
        data = synthetic.factorial(
            {"camera": ["orbit_y:0/2", "orbit_y:1/2", "path_z:0/2", "path_z:1/2", "random:1"], "data": list("12345")},
            lambda at: float(at["data"]))
        paths = correlation.correlations(data, splits.split(data, "camera_path"))
        self.assertEqual(len(paths), 1)  # random views have no counterparts on another path
        self.assertEqual(paths.iloc[0].pairs, 10)  # paired by position and data
        self.assertEqual(correlation.correlations(data, splits.split(data, "camera_rotation")).iloc[0].pairs, 5)
        self.assertEqual(splits.split(data, "camera_distance").levels, ["0/2", "1/2"])
        self.assertEqual(splits.factors_of(data), ["camera_distance", "camera_path", "camera_rotation", "data"])

    def test_the_fullest_block_holds_one_set_of_combinations(self):
        """The two techniques were measured with different data, so no two observations differ only in the technique."""
        plan = {"device": ["x", "y"], "data": list("abcd"), "step": ["1", "2"],
                "technique": ["raycast", "raycast_fragment"]}
        data = synthetic.factorial(plan, lambda at: 1.0, without=lambda at: (at["technique"] == "raycast") != (
            at["data"] in "ab") or (at["technique"] == "raycast" and at["step"] == "2"))
        block = splits.fullest_block(data, ["data", "device"])
        technique = data.factor("technique")
        self.assertEqual(len(block), 8)
        self.assertEqual({technique.levels[each] for each in technique.codes[block]}, {"raycast_fragment"})

    def test_natural_order(self):
        self.assertEqual(dataset.natural_order(["generate:x:128", "generate:x:32"]), ["generate:x:32", "generate:x:128"])
        self.assertEqual(dataset.natural_order(["192", "96", "1e3"]), ["96", "192", "1e3"])
        self.assertEqual(dataset.natural_order(["path_z", "orbit_y"]), ["orbit_y", "path_z"])


class Views(unittest.TestCase):
    def test_a_path_apart_is_rejected_and_random_samples_are_not(self):
        random = np.random.default_rng(3)
        data = synthetic.factorial(
            {"camera": ["orbit_y:0/2", "orbit_y:1/2"] + [f"random:{i}" for i in range(1, 5)],
             "data": [str(i) for i in range(30)]},
            lambda at: random.uniform(1, 2) * (4 if at["camera"].startswith("orbit") else 1))
        tests = views.path_tests(data, 1).set_index(["path", "subsets_of"])
        orbit = tests.loc[("orbit_y", "samples")]
        self.assertEqual((orbit.samples, orbit.all_samples), (60, 180))
        self.assertAlmostEqual(orbit.d, 2 / 3)
        self.assertLess(orbit.p, 1e-6)
        self.assertEqual(orbit.subsets, 100)
        self.assertLess(orbit.rejected, 10)
        # A random set of two whole views differs more from all values than a random set of 60 single values does. In the extreme
        # case, it consists of the two views on the orbit, whose values are four times as large.
        self.assertGreater(tests.loc[("orbit_y", "views"), "d_mean"], orbit.d_mean)

    def test_one_path_is_compared_with_nothing(self):
        data = synthetic.factorial({"camera": ["orbit_y:0/2", "orbit_y:1/2"], "data": list("12345")}, lambda at: 1.0)
        self.assertTrue(views.path_tests(data, 1).empty)


class Prediction(unittest.TestCase):
    def plan(self):
        return {"data": ["x", "y"], "camera": ["random:1", "random:2", "random:3"], "device": ["a", "b", "c"],
                "viewport": ["32", "64", "96", "128"], "step": ["0.5", "1", "2"]}

    def test_lines_find_what_is_linear_in_each_structure(self):
        def value(at):
            scale, device = (1 if at["data"] == "x" else 20), (1 if at["device"] == "a" else 4)
            return scale * (device + int(at["viewport"]) ** 2 / 1e3 + 1 / float(at["step"]))
        scores, _ = prediction.predict(synthetic.factorial(self.plan(), value), 1)
        of = scores.set_index("data")
        self.assertAlmostEqual(of.loc["least of data sets", "line_r2"], 1)
        self.assertGreater(of.loc["every held-out observation", "forest_r2"], 0.8)
        self.assertEqual(of.iloc[0]["structure"], "camera, data")
        self.assertEqual(of.iloc[0]["line_features"], "device (category), step (samples per voxel), viewport (pixels)")
        self.assertEqual((of.iloc[0]["structures"], of.iloc[0]["structures_left_out"]), (6, 0))

    def test_the_forest_beats_lines_on_a_product_law(self):
        def value(at):
            return int(at["viewport"]) ** 2 / float(at["step"]) ** 2 * {"a": 1, "b": 9, "c": 30}[at["device"]]
        plan = {**self.plan(), "viewport": ["32", "48", "64", "96", "128"]}
        scores, _ = prediction.predict(synthetic.factorial(plan, value), 1)
        of = scores.set_index("data").loc["all"]
        self.assertGreater(of.forest_r2, of.line_r2 + 0.1)
        self.assertGreater(of.forest_r2, 0.8)

    def test_too_little_is_said(self):
        scores, reason = prediction.predict(synthetic.anscombe(), 1)
        self.assertTrue(scores.empty)
        self.assertEqual(reason, "there are 22 observations; 40 are needed")


if __name__ == "__main__":
    unittest.main()
