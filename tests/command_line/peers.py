"""Tests the parts that the comparisons of ci/peers share, without VTK: Triptych's measurements on a scripted device,
and the ratio of the times of both programs. The program is $TRIPTYCH_PROGRAM."""

import argparse
import contextlib
import io
import os
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "ci/peers"))
sys.dont_write_bytecode = True
import peer  # noqa: E402


def ratio(triptych, vtk, error):
    with contextlib.redirect_stdout(io.StringIO()) as printed:
        reached = peer.print_ratio("a scene", triptych, vtk, error)
    return reached, printed.getvalue().splitlines()


class Peers(unittest.TestCase):
    def test_triptych_reports_times_and_errors(self):
        os.environ.update(TRIPTYCH_NULL_SCRIPT='{"base_ns": 1e5, "factors": {"*step=2*": 0.5}}', TRIPTYCH_DATA="")
        arguments = argparse.Namespace(triptych=os.environ["TRIPTYCH_PROGRAM"], device="null:scripted")
        with tempfile.TemporaryDirectory() as folder:
            ours = peer.Ours(arguments, pathlib.Path(folder), {"suite": "volume", "data": "generate:gaussian_blob:8",
                                                               "technique": "raycast", "viewport": 8, "step": [1, 2]})
            self.assertEqual(set(ours.frame()["camera"]) & {"eye", "forward", "up", "fov_y_deg", "near", "far"},
                             {"eye", "forward", "up", "fov_y_deg", "near", "far"})
            cases = peer.short_names(ours.measure())
        self.assertEqual(set(cases), {"", "step=2"})
        self.assertLess(cases["step=2"][0], cases[""][0])
        self.assertTrue(all(error > 0 for _, error in cases.values()))  # the device draws a pattern instead of the scene

    def test_each_side_reports_its_shortest_time(self):
        times = iter([5, 7, 3, 9])
        ours, vtk = peer.by_turns(2, lambda: {"a": (next(times), 0.1)}, lambda: {"b": (next(times), 0.2)})
        self.assertEqual((ours, vtk), ({"a": (3, 0.1)}, {"b": (7, 0.2)}))

    def test_the_ratio_is_of_the_fastest_within_the_error(self):
        ours = {"step=1": (4e6, 0.01), "step=2": (2e6, 0.02), "step=4": (1e6, 0.5)}
        reached, printed = ratio(ours, {"VTK": (8e6, 0.015)}, 0.02)
        self.assertTrue(reached)
        self.assertEqual(printed[-1], "  time to RMSE 0.02000: Triptych 2.000 ms (step=2), VTK 8.000 ms (VTK); ratio 0.250")

    def test_a_side_that_misses_the_error_is_reported(self):
        reached, printed = ratio({"a": (1e6, 0.01)}, {"VTK": (1e6, 0.5)}, 0.02)
        self.assertFalse(reached)
        self.assertEqual(printed[-1], "  no ratio, because RMSE 0.02000 was not reached by VTK")


if __name__ == "__main__":
    unittest.main()
