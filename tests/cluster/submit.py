#!/usr/bin/env python3
"""What ci/cluster/submit asks of a Slurm, whose commands are stand-ins."""

import os
import pathlib
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Each appends its words to $CALLS.
STAND_INS = {
    "sbatch": 'echo "sbatch $*" >>"$CALLS"; n=$(grep -c ^sbatch "$CALLS"); echo "$n"',
    "squeue": "",
    "triptych": '[ "$1" = list ] && seq "${2#plan}"',  # plan340 has 340 configurations; no store is complete
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

    def shards_of(self, *words):
        with tempfile.TemporaryDirectory(dir=self.folder) as farm:
            done = self.submit("--folder", farm, *words)
        self.assertEqual(done.returncode, 0, done.stderr)
        return int(done.stdout.split(" of ")[1].split()[0])

    def test_a_job_gets_200_configurations_of_all_plans(self):
        self.assertEqual(self.shards_of("plan340"), 2)
        self.assertEqual(self.shards_of("plan340", "plan340"), 4)
        # Half of each is 51 + 150: an odd one of both may fall to one job.
        self.assertEqual(self.shards_of("plan101", "plan299"), 3)
        # Never more than the largest has: further jobs had nothing to do.
        self.assertEqual(self.shards_of(*["plan2"] * 500), 2)


if __name__ == "__main__":
    unittest.main()
