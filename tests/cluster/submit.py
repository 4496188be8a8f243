#!/usr/bin/env python3
"""Tests how ci/cluster/submit calls Slurm: the number of jobs that it submits, and what remains if Slurm rejects a job.
Slurm's commands are replaced by scripts."""

import os
import pathlib
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
# sbatch and scancel append their arguments to $CALLS. sbatch rejects job number $REFUSED.
STAND_INS = {
    "sbatch": 'echo "sbatch $*" >>"$CALLS"; n=$(grep -c ^sbatch "$CALLS"); [ "$n" != "${REFUSED:-}" ] || exit 1; echo "$n"',
    "scancel": 'echo "scancel $*" >>"$CALLS"',
    "squeue": "",
    "triptych": '[ "$1" = list ] && seq "${2#plan}"',  # lists N configurations for planN; all other commands fail
}


class Submit(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        for name, text in STAND_INS.items():
            file = self.folder / name
            file.write_text(f"#!/bin/bash\n{text}\n", encoding="utf-8")
            file.chmod(0o755)
        self.farm = self.folder / "farm"

    def submit(self, *words, **environment):
        (self.folder / "calls").write_text("", encoding="utf-8")
        return subprocess.run(
            [ROOT / "ci/cluster/submit", *map(str, words)], cwd=self.folder, capture_output=True, text=True,
            env={**os.environ, "PATH": f"{self.folder}:{os.environ['PATH']}", "TRIPTYCH": str(self.folder / "triptych"),
                 "CALLS": str(self.folder / "calls"), **environment})

    def calls(self, program):
        return [line for line in (self.folder / "calls").read_text().splitlines() if line.startswith(program)]

    def shards_of(self, *words):
        with tempfile.TemporaryDirectory(dir=self.folder) as farm:
            done = self.submit("--folder", farm, *words)
        self.assertEqual(done.returncode, 0, done.stderr)
        return int(done.stdout.split(" of ")[1].split()[0])

    def test_a_job_gets_200_configurations_of_all_plans(self):
        self.assertEqual(self.shards_of("plan340"), 2)
        self.assertEqual(self.shards_of("plan340", "plan340"), 4)
        # Two jobs are not enough: one of them might get 51 of the 101 and 150 of the 299 configurations, which is one more than
        # the 200 that are allowed.
        self.assertEqual(self.shards_of("plan101", "plan299"), 3)
        # There are at most as many jobs as the largest plan has configurations, because any additional jobs would be empty.
        self.assertEqual(self.shards_of(*["plan2"] * 500), 2)

    def test_what_slurm_refuses_leaves_nothing(self):
        plans = "--folder", self.farm, "--device", "a:*", "--device", "b:*", "plan340"
        for refused, cancelled in (("1", []), ("2", ["scancel 1"]), ("3", ["scancel 1 2"])):
            done = self.submit(*plans, REFUSED=refused)
            self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
            self.assertIn("submit: sbatch rejected", done.stderr)
            self.assertEqual(self.calls("scancel"), cancelled)
        self.assertEqual(self.submit(*plans).returncode, 0)
        self.assertIn("--dependency=afterany:1:2 ", self.calls("sbatch")[-1])

    def test_what_slurm_refuses_again_can_be_sent_again(self):
        self.assertEqual(self.submit("--folder", self.farm, "plan340").returncode, 0)
        done = self.submit("--again", self.farm, REFUSED="2")
        self.assertEqual((done.returncode, self.calls("scancel")), (3, ["scancel 1"]))
        self.assertEqual(self.submit("--again", self.farm).returncode, 0)

    def test_a_folder_that_cannot_be_made_ends_with_3(self):
        self.assertEqual(self.submit("--folder", "/proc/none", "plan340").returncode, 3)


if __name__ == "__main__":
    unittest.main()
