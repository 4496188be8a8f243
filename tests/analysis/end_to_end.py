"""Measures plans on scripted devices, exports the results and analyses them. Every figure must exist and be well-formed.
One number of each figure is compared with an independent computation from the raw tables in plain Python.
$TRIPTYCH_PROGRAM is the path of the program."""

import csv
import glob
import json
import math
import os
import statistics
import subprocess
import sys
import tempfile
import unittest
import unittest.mock
import xml.etree.ElementTree

from triptych_analysis import __main__ as analyze
from triptych_analysis import dataset, notebook, output, tables

PROGRAM = os.environ.get("TRIPTYCH_PROGRAM")
SCRIPT = json.dumps({"devices": [1, 1.7, 0.8], "base_ns": 2e5, "ns_per_sample": 20, "noise": 0.05})
CAMERAS = [f"orbit_{axis}:{i}/4" for axis in "xy" for i in range(4)] + [f"path_z:{i}/4" for i in range(4)]
VOLUME = {"suite": "volume", "technique": ["raycast"],
          "data": ["generate:gaussian_blob:8", "generate:gaussian_blob:16", "generate:mandelbulb:16"],
          "camera": CAMERAS + ["random:1", "random:2", "random:3"], "viewport": [8, 12, 16], "step": [1, 2]}
PARTICLES = {"suite": "particles", "technique": ["quad_ray", "quad_screen", "tiles"], "culling": ["none"],
             "data": ["generate:uniform:10", "generate:uniform:20", "generate:droplets:20"],
             "camera": CAMERAS + ["random:1"], "viewport": [8]}
# Smaller plans for the test of the notebook (paper.ipynb), because the notebook draws every figure twice.
FEW = [{"suite": "volume", "technique": ["raycast"], "data": ["generate:gaussian_blob:8"], "camera": CAMERAS, "viewport": [8, 12]},
       {"suite": "particles", "technique": ["quad_ray", "tiles"], "culling": ["none"], "data": ["generate:uniform:10", "generate:uniform:20"],
        "camera": CAMERAS[:4], "viewport": [8]}]
REFERENCE = ["--reference", "data=generate:uniform:10"]  # only the particle suite has this level
FIGURES = {"volume": ["figure_03_distribution", "figure_04_correlation_boxes", "figure_05_correlation_device",
                      "figure_06_speed_up_device", "figure_07_speed_up_camera_path", "figure_08_mean_data_camera_path",
                      "camera_paths", "correlation_camera_distance", "correlation_camera_rotation", "prediction",
                      "stack_gaussian_blob", "effects"],
           "particles": ["figure_10_distribution", "figure_11_correlation_boxes", "figure_12_correlation_data",
                         "figure_13_correlation_camera_path", "figure_14_mean_data_technique", "by_count"]}


def read(*path):
    with open(os.path.join(*path), newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


class EndToEnd(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.temporary.cleanup)
        cls.folder = cls.temporary.name
        for plan in (VOLUME, PARTICLES):
            with open(os.path.join(cls.folder, f"{plan['suite']}.yaml"), "w", encoding="utf-8") as file:
                json.dump(plan, file)  # JSON is YAML
        cls.triptych("run", "volume.yaml", "particles.yaml", "--device", "null:*", "--store", "s.sqlite")
        cls.triptych("export", "s.sqlite", "--out", "tables")
        cls.out = os.path.join(cls.folder, "out")
        cls.code = analyze.main([os.path.join(cls.folder, "tables"), "--out", cls.out, *REFERENCE])
        cls.times = cls.raw_times()

    @classmethod
    def triptych(cls, *words):
        subprocess.run([PROGRAM, *words], cwd=cls.folder, check=True, stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL, env={**os.environ, "TRIPTYCH_NULL_SCRIPT": SCRIPT, "TRIPTYCH_DATA": ""})

    @classmethod
    def raw_times(cls):
        """Returns {suite: [({factor: level}, ms)]}, where ms is the median of the raw samples of one record, measured by the
        clock that the analysis uses."""
        samples = {}
        for row in read(cls.folder, "tables", "samples.csv"):
            samples.setdefault((row["record"], row["clock"]), []).append(float(row["time_ns"]))
        times = {"volume": [], "particles": []}
        for row in read(cls.folder, "tables", "records.csv"):
            if row["outcome"] == "measured":
                factors = {name[7:]: level for name, level in row.items() if name.startswith("factor_") and level}
                ms = statistics.median(samples[row["record"], "device"]) / 1e6
                times[row["suite"]].append(({**factors, "device": row["device"]}, ms))
        return times

    def pairs(self, suite, factor, a, b, change=lambda factors: factors):
        """Returns the times of levels a and b, paired for configurations that agree in all other factors."""
        by_rest = {}
        for factors, ms in self.times[suite]:
            factors = change(dict(factors))
            if factors and factors.get(factor) in (a, b):
                level = factors.pop(factor)
                by_rest.setdefault(tuple(sorted(factors.items())), {})[level] = ms
        both = [each for each in by_rest.values() if len(each) == 2]
        return [each[a] for each in both], [each[b] for each in both]

    def row(self, suite, table, **where):
        rows = [each for each in read(self.out, suite, "time", f"{table}.csv")
                if all(each[name] == value for name, value in where.items())]
        self.assertEqual(len(rows), 1, f"{table} {where}")
        return rows[0]

    def expect_r(self, suite, factor, a, b, table="correlations", change=lambda factors: factors, column=None):
        r = statistics.correlation(*self.pairs(suite, column or factor, a, b, change))
        self.assertAlmostEqual(float(self.row(suite, table, factor=factor, a=a, b=b)["r"]), r, places=9)

    def test_every_figure_is_there_and_well_formed(self):
        self.assertEqual(self.code, 0)
        for suite, names in FIGURES.items():
            for name in names:
                self.assertTrue(os.path.exists(os.path.join(self.out, suite, "time", f"{name}.svg")), name)
        for file in glob.glob(os.path.join(self.out, "*", "time", "*.svg")):
            root = xml.etree.ElementTree.parse(file).getroot()
            self.assertEqual(root.tag, "{http://www.w3.org/2000/svg}svg", file)

    def test_figure_3_and_10_mean_and_distance(self):
        for suite in ("volume", "particles"):
            ms = sorted(each for _, each in self.times[suite])
            row = self.row(suite, "distributions", of="all", clock="device")
            self.assertAlmostEqual(float(row["mean_ms"]), statistics.fmean(ms), places=9)
            logs = [math.log(each) for each in ms]
            fit = statistics.NormalDist(statistics.fmean(logs), statistics.pstdev(logs))
            d = max(max((i + 1) / len(logs) - fit.cdf(x), fit.cdf(x) - i / len(logs)) for i, x in enumerate(logs))
            self.assertAlmostEqual(float(row["ks_d"]), d, places=9)

    def test_figures_4_and_5_devices(self):
        self.expect_r("volume", "device", "null:scripted", "null:scripted#2")
        self.expect_r("volume", "device", "null:scripted#2", "null:scripted#3")
        r = [statistics.correlation(*self.pairs("volume", "device", a, b)) for a, b in (
            ("null:scripted", "null:scripted#2"), ("null:scripted", "null:scripted#3"),
            ("null:scripted#2", "null:scripted#3"))]
        self.assertAlmostEqual(float(self.row("volume", "correlation_boxes", factor="device")["median"]),
                               statistics.median(r), places=9)

    def test_figure_6_speed_up(self):
        base, level = self.pairs("volume", "device", "null:scripted", "null:scripted#2")
        row = self.row("volume", "speed_ups", factor="device", level="null:scripted#2")
        self.assertAlmostEqual(float(row["speed_up"]), statistics.linear_regression(level, base).slope, places=9)
        self.assertAlmostEqual(float(row["speed_up"]), 1 / 1.7, delta=0.05)  # 1.7 is the factor in SCRIPT

    def test_a_reference_of_one_suite(self):
        self.row("particles", "speed_ups", factor="data", level="generate:uniform:20", reference="generate:uniform:10")
        told = self.row("volume", "left_out", analysis="speed-up relative to data=generate:uniform:10")
        self.assertIn("relative to generate:gaussian_blob:8 instead", told["reason"])

    @staticmethod
    def path_and_position(factors):
        factors["path"], _, factors["position"] = factors.pop("camera").partition(":")
        return factors if factors["path"] != "random" else None

    def test_figures_7_and_13_camera_paths(self):
        for suite in ("volume", "particles"):
            self.expect_r(suite, "camera_path", "orbit_y", "path_z", change=self.path_and_position, column="path")
        base, level = self.pairs("volume", "path", "orbit_x", "path_z", self.path_and_position)
        row = self.row("volume", "speed_ups", factor="camera_path", level="path_z")
        self.assertAlmostEqual(float(row["speed_up"]), statistics.linear_regression(level, base).slope, places=9)

    def test_rotation_and_distance(self):
        orbits = lambda factors: self.path_and_position(factors) if factors["camera"].startswith("orbit") else None
        self.expect_r("volume", "camera_rotation", "0/4", "2/4", change=orbits, column="position")
        straight = lambda factors: self.path_and_position(factors) if factors["camera"].startswith("path") else None
        self.expect_r("volume", "camera_distance", "1/4", "3/4", change=straight, column="position")

    def test_figures_8_and_14_means(self):
        def expect_mean(suite, data, factor, level, column):
            times = [ms for factors, ms in self.times[suite]
                     if factors["data"] == data and factors[factor].startswith(level)]
            cell = self.row(suite, "means", rows="data", columns=column, row=data, column=level)
            self.assertAlmostEqual(float(cell["mean_ms"]), statistics.fmean(times), places=9)
            self.assertEqual(int(cell["samples"]), len(times))
        expect_mean("volume", "generate:mandelbulb:16", "camera", "path_z", "camera_path")
        expect_mean("particles", "generate:droplets:20", "technique", "tiles", "technique")

    def test_figures_11_and_12_data(self):
        self.expect_r("particles", "data", "generate:droplets:20", "generate:uniform:20")

    def test_stack_of_sizes(self):
        self.expect_r("volume", "data", "generate:gaussian_blob:8", "generate:gaussian_blob:16", "stack_correlations")

    def test_orbits_against_all_views(self):
        of = lambda path: sorted(ms for factors, ms in self.times["volume"] if factors["camera"].startswith(path))
        orbit, everything = of("orbit_y"), of("")
        below = lambda sample, x: sum(each <= x for each in sample) / len(sample)
        d = max(abs(below(orbit, x) - below(everything, x)) for x in everything)
        row = self.row("volume", "camera_paths", path="orbit_y", subsets_of="views")
        self.assertAlmostEqual(float(row["d"]), d, places=9)

    def test_forest_against_lines(self):
        """A scripted time grows with the product of the numbers of pixels, voxels and samples per voxel, so the random forest
        must be able to predict it. Every observation must be used either for training or for testing, so the numbers of
        training and held-out observations must add up to the number of all observations."""
        rows = {each["data"]: each for each in read(self.out, "volume", "time", "predictions.csv")}
        whole = rows["every held-out observation"]
        self.assertEqual(int(whole["trained"]) + int(float(whole["held_out"])), len(self.times["volume"]))
        self.assertGreater(float(whole["forest_r2"]), 0.8)

    def test_effects(self):
        by_rest = {}
        for factors, ms in self.times["volume"]:
            rest = tuple(sorted((name, level) for name, level in factors.items() if name != "viewport"))
            by_rest.setdefault(rest, []).append(math.log(ms))
        total = statistics.pvariance([math.log(ms) for _, ms in self.times["volume"]])
        share = statistics.fmean(map(statistics.pvariance, by_rest.values())) / total
        self.assertAlmostEqual(float(self.row("volume", "effects", factor="viewport")["share"]), share, places=9)

    def test_the_store_itself_says_the_same(self):
        again = os.path.join(self.folder, "again")
        # The figures are not drawn again, because they depend only on the tables, and because the test publish.py already
        # compares figures byte by byte.
        with unittest.mock.patch.object(output.figures, "every", return_value=[]):
            self.assertEqual(analyze.main([os.path.join(self.folder, "s.sqlite"), "--out", again, *REFERENCE]), 0)
        files = sorted(glob.glob(os.path.join(self.out, "*", "time", "*.csv")))
        self.assertGreater(len(files), 10)
        for file in files:
            with open(file, "rb") as one, open(file.replace(self.out, again), "rb") as other:
                self.assertEqual(one.read(), other.read(), file)

    def test_frames_taken_over_are_no_observation(self):
        """A uniform box has no empty bricks, so skip=none and skip=distance do the same work. The run therefore draws only one
        of them and copies its frames to the record of the other, which must not count as a second observation."""
        with open(os.path.join(self.folder, "copies.yaml"), "w", encoding="utf-8") as file:
            json.dump({"suite": "volume", "technique": ["raycast"], "data": ["generate:uniform_box:8"], "viewport": [8],
                       "skip": ["none", "distance"]}, file)
        self.triptych("run", "copies.yaml", "--device", "null:*", "--store", "copies.sqlite")
        self.triptych("export", "copies.sqlite", "--out", "copies")
        for source in ("copies", "copies.sqlite"):
            data, = dataset.datasets(tables.read(os.path.join(self.folder, source)))
            self.assertEqual(len(data), 3, source)
            self.assertEqual(data.notes, ["3 records with frames copied from an equivalent configuration are not used"])

    def test_the_notebook_runs(self):
        out = os.path.join(self.folder, "notebook")
        file = os.path.join(os.path.dirname(notebook.__file__), "..", "paper.ipynb")
        for plan in FEW:
            with open(os.path.join(self.folder, f"few_{plan['suite']}.yaml"), "w", encoding="utf-8") as text:
                json.dump(plan, text)
        self.triptych("run", "few_volume.yaml", "few_particles.yaml", "--device", "null:scripted", "--store", "few.sqlite")
        self.assertEqual(notebook.main([file, os.path.join(self.folder, "few.sqlite"), "--out", out]), 0)
        self.assertGreater(len(glob.glob(os.path.join(out, "*.svg"))), 2)
        with open(file, encoding="utf-8") as text:
            for cell in json.load(text)["cells"]:
                self.assertFalse(cell.get("outputs"), "the notebook must not contain outputs")
                self.assertLessEqual(len(cell["source"]), 10)

    def test_wrong_words_end_with_3(self):
        tables = os.path.join(self.folder, "tables")
        for words in (["--nonsense"], [tables], ["none", "--out", "x"], [tables, "--out", "x", "--reference", "step"],
                      [tables, "--out", "x", "--reference", "data=none"], [tables, "--out", "x", "--plan", "none"]):
            self.assertEqual(analyze.main(words), 3, words)


if __name__ == "__main__":
    if not PROGRAM:
        sys.exit("TRIPTYCH_PROGRAM names no program")
    unittest.main()
