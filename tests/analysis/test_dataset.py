"""Tests which records become observations, and how tables are read."""

import json
import os
import tempfile
import unittest

import numpy as np
import pandas as pd

import synthetic
from triptych_analysis import dataset, tables


def times(*changes, clock="auto"):
    return dataset.datasets(synthetic.records(*changes), clock)[0]


class Observations(unittest.TestCase):
    def test_the_trusted_device_clock_counts(self):
        data = times({}, {"device": "b"})
        self.assertEqual((data.clock, list(data.values)), ("device", [9, 9]))
        self.assertEqual(data.factors["device"].levels, ["a", "b"])

    def test_one_record_without_device_time_turns_all_to_the_wall_clock(self):
        changes = {}, {"device": "b", "device_clock_trusted": 0.0}
        data = times(*changes)
        self.assertEqual((data.clock, list(data.values)), ("wall", [11, 11]))
        self.assertIn("the wall clock is used for all records, because 1 records of b have no trusted device time", data.notes)
        self.assertTrue(np.isnan(data.device_ms[1]))
        self.assertEqual(len(times(*changes, clock="device")), 1)

    def test_the_latest_of_two_runs_whatever_the_order(self):
        data = times({"run": "r3", "started_at": "2026-01-03", "median_wall_ns": 33e6},
                     {"run": "r2", "started_at": "2026-01-02"}, clock="wall")
        self.assertEqual(list(data.values), [33])
        self.assertEqual(data.duplicates.iloc[0].to_dict(),
                         {"device": "a", "configuration": "camera=orbit_y:0/2,data=ball,technique=raycast",
                          "taken": "r3 in s.sqlite", "dropped": "r2 in s.sqlite"})

    def test_suites_are_kept_apart(self):
        found = dataset.datasets(synthetic.records({}, {"suite": "particles"}))
        self.assertEqual([each.suite for each in found], ["particles", "volume"])

    def test_another_driver_is_another_device(self):
        data = times({}, {"device_key": "a 2", "run": "r2"})
        self.assertEqual(len(data), 2)
        self.assertTrue(all(each.startswith("a@") for each in data.factors["device"].levels))
        self.assertEqual(len(data.duplicates), 0)

    def test_what_is_no_measurement_is_left_aside_and_said(self):
        data = times({"outcome": "skipped", "median_wall_ns": np.nan}, {"injected": "slowdown:20"}, {"same_as": "data=ball"},
                     {"median_wall_ns": np.nan}, {"technique": "speed_of_light"}, {"counted_by": "valgrind"}, {})
        self.assertEqual(len(data), 1)
        self.assertEqual(data.notes, [
            "1 records of a technique that makes no image are not used",
            "1 records with an injected fault are not used",
            "1 records with frames copied from an equivalent configuration are not used",
            "1 records with instructions counted by an emulator, which distorts times, are not used",
            "1 records with the outcome 'skipped' on a are not used",
            "1 records without a time on a are not used"])

    def test_what_the_device_chose_is_no_factor(self):
        rows = [{"factor_voxel": "u8"}, {"device": "b", "factor_voxel": "f32"}]
        self.assertNotIn("voxel", times(*rows).factors)
        named = [{**each, "configuration": f"data=ball,voxel={each['factor_voxel']}"} for each in rows]
        self.assertEqual(times(*named).factors["voxel"].levels, ["f32", "u8"])

    def test_cost_is_device_code_and_driver_and_missing_is_not_zero(self):
        found = dataset.datasets(synthetic.records(
            {"counted_by": "valgrind", "median_wall_ns": np.nan, "cost_device_code": 5e6, "cost_driver": 2e6,
             "cost_libc": 1e6},
            {"device": "b", "counted_by": "valgrind", "cost_device_code": 5e6}, {"device": "c"},
            {"device": "d", "counted_by": "valgrind", "cost_device_code": 5e6, "cost_driver": 2e6, "same_as": "data=ball"}))
        self.assertEqual([(each.signal, len(each)) for each in found], [("time", 1), ("cost", 1)])
        self.assertEqual(list(found[1].values), [7e6])
        self.assertEqual(found[1].unit, "instructions")


class Tables(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        column = lambda name, of="text": {"name": name, "type": of, "unit": "", "description": "."}
        numbers = {"record", "median_wall_ns", "median_device_ns", "device_clock_trusted"}
        self.columns = [*tables.RECORD_COLUMNS, "factor_data"]
        self.row = {**dict.fromkeys(self.columns, "x"), "record": 1, "median_wall_ns": 5.5, "median_device_ns": "",
                    "device_clock_trusted": 0, "injected": "", "factor_data": "NA"}
        self.dictionary = {"schema": 1, "tables": {
            "records": {"rows": 1, "columns": [column(each, "number" if each in numbers else "text")
                                               for each in self.columns]},
            "runs": {"rows": 1, "columns": [column(each) for each in ("run", "store", "started_at", "processor")]},
            "devices": {"rows": 1, "columns": [column(each) for each in ("run", "device", "device_key")]}}}
        self.write("records.csv", pd.DataFrame([self.row]).to_csv(index=False))
        self.write("runs.csv", "run,store,started_at,processor\nx,s,2026,\n")
        self.write("devices.csv", "run,device,device_key\nx,x,k\n")
        self.write("dictionary.json", json.dumps(self.dictionary))

    def write(self, name, text):
        with open(os.path.join(self.folder.name, name), "w", encoding="utf-8") as file:
            file.write(text)

    def refused(self, words):
        with self.assertRaisesRegex(tables.InputError, words):
            tables.read(self.folder.name)

    def test_missing_is_missing_and_text_is_text(self):
        record = tables.read(self.folder.name).iloc[0]
        self.assertTrue(np.isnan(record["median_device_ns"]))
        self.assertIsNone(record["injected"])
        self.assertIsNone(record["processor"])
        self.assertEqual(record["factor_data"], "NA")  # a level, although pandas would read "NA" as a missing value

    def test_an_export_that_was_cut_off_is_refused(self):
        self.write("records.csv", ",".join(self.columns) + "\n")
        self.refused("records.csv: found 0 rows, but dictionary.json states 1")
        os.remove(os.path.join(self.folder.name, "dictionary.json"))
        self.refused("no dictionary.json")

    def test_what_is_no_export_is_refused(self):
        self.write("dictionary.json", '{"schema": 2}')
        self.refused("schema 2, expected 1")
        self.write("dictionary.json", "{")
        self.refused("damaged")
        with self.assertRaisesRegex(tables.InputError, "no such file or folder"):
            tables.read(os.path.join(self.folder.name, "none"))
        with self.assertRaisesRegex(tables.InputError, "not a database"):
            tables.read(os.path.join(self.folder.name, "records.csv"))

    def test_a_plan_that_is_not_there_is_told_with_those_that_are(self):
        with self.assertRaisesRegex(tables.InputError, "no records of y .*; plans: x"):
            tables.read(self.folder.name, "y")


if __name__ == "__main__":
    unittest.main()
