"""Tests that ci/ratios reports the ratio between the best configurations of both sides on a scripted device, or the
reason why there is none."""

import importlib.machinery
import importlib.util
import json
import os
import pathlib
import subprocess
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "ci/ratios"


def run(*arguments, factors, **environment):
    environment = {**os.environ, "TRIPTYCH_DATA": "",
                   "TRIPTYCH_NULL_SCRIPT": json.dumps({"base_ns": 1e5, "ns_per_sample": 0, "factors": factors})} | environment
    return subprocess.run([SCRIPT, "--no-cost", "--device", "null:*", *arguments],
                          env=environment, capture_output=True, text=True)


def loaded():
    loader = importlib.machinery.SourceFileLoader("ratios", str(SCRIPT))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("ratios", loader))
    loader.exec_module(module)
    return module


class Ratios(unittest.TestCase):
    def test_the_new_side_over_the_best_old_one(self):
        done = run("tiles*, 10 spheres", "--rounds", "2", factors={"*tiles*": 3, "*point*": 6, "*quad*": 12})
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("| new / old: time · instructions · samples or fragments | `null:scripted` |\n|---|---|\n"
                      "| tiles over sprites, 10 spheres | 0.50 (0.50–0.50) · – · ", done.stdout)

    def test_missing_data_are_reported(self):
        done = run("skip distance over bricks*", factors={})
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr.count("skipped, because ct_bonsai_256x256x256_u8.nrrd is missing"), 2)

    def test_an_unknown_name_is_rejected(self):
        done = run("tiels", factors={})
        self.assertEqual(done.returncode, 2)
        self.assertIn("no comparison matches this name; expected one of: cells", done.stderr)

    def test_only_techniques_that_meet_the_error_count(self):
        module = loaded()
        ratio = module.Ratio("r", {"suite": "volume", "data": "a:b"}, {"step": [1, 0.5]}, {"step": 2}, ("rmse", 0.1))
        records = [{"device": "d", "factor_step": step, "time": time, "error": {"rmse": error}}
                   for step, time, error in (("1", 1, 0.2), ("0.5", 4, 0.1), ("2", 3, 0.1))]
        self.assertEqual(module.chosen_sides(ratio, records, ["d"]), [[{"step": "0.5"}], [{"step": "2"}]])
        records[1]["error"] = {"rmse": 0.11}
        self.assertEqual(module.chosen_sides(ratio, records, ["d"])[0], [])

    def test_only_techniques_that_meet_the_error_on_a_device_count_there(self):
        module = loaded()
        ratio = module.Ratio("r", {"suite": "volume", "data": "a:b"}, {"step": [1, 0.5]}, {"step": 2}, ("rmse", 0.1))
        records = [{"device": "d", "configuration": step, "factor_step": step, "time": time}
                   for step, time in (("1", 1), ("0.5", 8), ("2", 2))]
        self.assertEqual(module.quotient(ratio, records, "d", "time"), 2)
        self.assertEqual(module.quotient(ratio, records, "d", "time", {("d", "1")}), 0.25)
        self.assertIsNone(module.quotient(ratio, records, "d", "time", {("d", "2")}))

    def test_a_device_against_another(self):
        module = loaded()
        ratio = module.Ratio("r", {"suite": "volume", "data": "a:b"}, "opencl:pocl", None)
        records = [{"device": device, "configuration": "", "time": time}
                   for device, time in (("opencl:pocl", 2.0), ("gl:x", 3.0))]
        self.assertEqual(module.quotient(ratio, records, "gl:x", "time"), 1.5)
        self.assertIsNone(module.quotient(ratio, records[1:], "gl:x", "time"))


if __name__ == "__main__":
    unittest.main()
