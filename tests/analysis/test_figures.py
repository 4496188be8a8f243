"""Tests which figures are drawn and which are omitted."""

import io
import unittest
import xml.etree.ElementTree

import numpy as np
import pandas as pd

import synthetic
from triptych_analysis import analysis, drawing, figures


def svg(made):
    text = io.StringIO()
    drawing.save(made, text)
    return text.getvalue()


def texts(made):
    return [each.get_text() for axes in made.axes for each in axes.texts]


class Drawing(unittest.TestCase):
    def test_a_missing_correlation_is_no_zero(self):
        cells = pd.DataFrame({"a": ["1", "1", "2"], "b": ["2", "4", "4"], "r": [0.5, np.nan, 0.25]})
        made, axes = drawing.figure(4, 4)
        drawing.heat_map(axes, figures.square(cells), "r", 0, 1, decimals=2)
        self.assertEqual(sorted(texts(made)), ["0.25"] * 2 + ["0.50"] * 2 + ["1.00"] * 3)

    def test_two_values_are_no_box(self):
        made, axes = drawing.figure(4, 4)
        drawing.boxes(axes, ["two", "three"], [np.array([0.1, 0.9]), np.array([0.1, 0.5, 0.9])])
        self.assertEqual(len(axes.patches), 1)
        strokes = [each for each in axes.lines if each.get_marker() == "|"]
        self.assertEqual([len(each.get_xdata()) for each in strokes], [2, 3])

    def test_the_same_bytes_each_time(self):
        def draw():
            made, axes = drawing.figure(4, 3)
            drawing.bars(axes, ["a", "b"], [1.0, 2.0], [0.9, 1.5], [1.1, 2.5])
            return svg(made)
        self.assertEqual(draw(), draw())
        self.assertNotIn("<dc:date>", draw())

    def test_numbers_for_people(self):
        self.assertEqual([drawing.short(each) for each in (0.1234, 4.567, 789.4, 1234, 12345, 1.5e6, 2e10)],
                         ["0.123", "4.57", "789", "1234", "12.3k", "1.5M", "20G"])


class Every(unittest.TestCase):
    def names(self, data):
        made = dict(figures.every(analysis.analyse(data)))
        for name, each in made.items():
            with self.subTest(name):
                xml.etree.ElementTree.fromstring(svg(each))
        return set(made)

    def plan(self, data, **more):
        return {"device": ["gl:a", "gl:b", "gl:c"], "data": data, **more,
                "camera": ["orbit_y:0/3", "orbit_y:1/3", "path_z:0/3", "path_z:1/3", "random:1", "random:2"]}

    def value(self, at):
        return (1 + len(at["device"] + at["data"]) + 3 * len(at["camera"])) * (1 + self.random.random())

    def setUp(self):
        self.random = np.random.default_rng(1)

    def test_of_volumes(self):
        plan = self.plan(["generate:a:32", "generate:a:64", "b"], step=["1", "2"], viewport=["8", "16", "32"])
        data = synthetic.factorial(plan, self.value)
        self.assertLessEqual({"figure_03_distribution", "figure_04_correlation_boxes", "figure_05_correlation_device",
                              "figure_06_speed_up_device", "figure_07_speed_up_camera_path",
                              "figure_08_mean_data_camera_path", "prediction", "camera_paths", "stack_a", "effects"},
                             self.names(data))

    def test_of_particles_in_instructions(self):
        data = synthetic.factorial(self.plan(["generate:uniform:10", "generate:uniform:100", "drops"],
                                             technique=["quad", "tiles", "point"]), self.value, "cost", "particles")
        self.assertLessEqual({"figure_10_distribution", "figure_11_correlation_boxes", "figure_12_correlation_data",
                              "figure_14_mean_data_technique", "by_count", "effects"}, self.names(data))


if __name__ == "__main__":
    unittest.main()
