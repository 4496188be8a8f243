"""Publishes the results of two small plans on scripted devices. The result set must be complete, agree with its checksums,
and be identical when it is created again. $TRIPTYCH_PROGRAM is the path of the program."""

import csv
import hashlib
import os
import pathlib
import subprocess
import tarfile
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PLAN = """suite: volume
technique: [raycast]
data: ['generate:gaussian_blob:8', 'generate:mandelbulb:16']
camera: ['orbit_y:*/8']
viewport: [8]
"""
DEVICES = '{"devices": [1, 1.7], "base_ns": 1e4, "ns_per_sample": 20, "noise": 0.05}'


class Publish(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.plan = self.folder / "small.yaml"
        self.plan.write_text(PLAN, encoding="utf-8")

    def publish(self, *words, program=os.environ["TRIPTYCH_PROGRAM"]):
        return subprocess.run(
            [ROOT / "ci/publish", self.folder / "out", "--counted", "--timed", self.plan, "--device", "null:*", "--shares", "4", *words],
            capture_output=True, text=True, env={**os.environ, "TRIPTYCH": str(program), "TRIPTYCH_DATA": "",
                                                 "TRIPTYCH_NULL_SCRIPT": DEVICES})

    def archive(self):
        return (self.folder / "out/triptych-results.tar.xz").read_bytes()

    def test_a_result_set_is_begun_kept_completed_and_repeated(self):
        """Tests everything in one scenario, because each call analyses all data and draws all figures, which takes long."""
        with self.subTest("begun within the time"):
            done = self.publish("--hours", "0.00001")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("after 1 of 4 shares", done.stderr)
            self.assertIn("8 of 32 configurations", self.readme())
        with self.subTest("kept if a later one cannot be created"):
            self.expect_kept(self.archive())
        with self.subTest("completed"):
            done = self.publish()
            self.assertEqual(done.returncode, 0, done.stderr)
            self.expect_complete()
        with self.subTest("repeated"):
            first = self.archive()
            self.assertEqual(self.publish().returncode, 0)
            self.assertEqual(self.archive(), first)

    def readme(self):
        return (self.folder / "out/triptych-results/README.md").read_text()

    def expect_kept(self, first):
        # This replacement of triptych deletes a file after it has exported the tables. The script therefore fails halfway,
        # because it cannot analyse the tables.
        stand_in = self.folder / "triptych"
        stand_in.write_text('#!/bin/sh\n"$TRIPTYCH_PROGRAM" "$@" || exit\n'
                            '[ "$1" != export ] || rm "$4/dictionary.json"\n', encoding="utf-8")
        stand_in.chmod(0o755)
        self.assertEqual(self.publish(program=stand_in).returncode, 3)
        self.assertEqual(self.archive(), first)
        self.assertIn("8 of 32", self.readme())
        self.assertEqual({each.name for each in (self.folder / "out").iterdir()}, {"work", "triptych-results", "triptych-results.tar.xz"})

    def expect_complete(self):
        # Unpacks with Python, because the program tar needs xz, which a minimal Debian system lacks.
        with tarfile.open(self.folder / "out/triptych-results.tar.xz") as tar:
            tar.extractall(self.folder / "user")
        found = self.folder / "user/triptych-results"
        sums = dict(reversed(line.split("  ")) for line in (found / "SHA256SUMS").read_text().splitlines())
        self.assertEqual(set(sums) | {"SHA256SUMS"}, {str(each.relative_to(found)) for each in found.rglob("*") if each.is_file()})
        for name, digest in sums.items():
            self.assertEqual(hashlib.sha256((found / name).read_bytes()).hexdigest(), digest, name)
        with open(found / "tables/records.csv", newline="", encoding="utf-8") as file:
            self.assertEqual(len(list(csv.DictReader(file))), 16 * 2)
        self.assertEqual((found / "plans/small.yaml").read_text(), PLAN)
        self.assertTrue((found / "analysis/volume/time/figure_03_distribution.svg").exists())
        readme = (found / "README.md").read_text()
        for told in ("32 of 32 configurations", "CC BY 4.0", "null:scripted#2", "| small | 32 | 32 |"):
            self.assertIn(told, readme)

    def test_wrong_words_end_with_3(self):
        for words in ([], ["--nonsense"], ["/proc/none"]):
            done = subprocess.run([ROOT / "ci/publish", *words], capture_output=True, text=True)
            self.assertEqual(done.returncode, 3, done.stderr)
            self.assertNotIn("Traceback", done.stderr)
        self.assertEqual(subprocess.run([ROOT / "ci/publish", "--help"], stdout=subprocess.DEVNULL).returncode, 0)

    def test_nothing_measured_is_no_result(self):
        done = self.publish("--device", "nobody:*")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("no device matches nobody:*", done.stderr)


if __name__ == "__main__":
    unittest.main()
