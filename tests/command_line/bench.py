"""Checks that the program injects slowdowns into the configurations that ci/bench reports. The program is $TRIPTYCH_PROGRAM."""

import contextlib
import importlib.machinery
import importlib.util
import os
import pathlib
import random
import sqlite3
import subprocess
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "ci/bench"
PROGRAM = os.environ["TRIPTYCH_PROGRAM"]
# The name of one technique is a prefix of the other's, and the levels of one configuration are a subset of another's. A pattern
# for one of them could therefore match the other one by mistake.
PLAN = "suite: volume\ntechnique: [raycast, raycast_fragment]\ndata: ['generate:gaussian_blob:8']\nstep: [1, 2]\nviewport: [8]\n"


def where(*arguments):
    loader = importlib.machinery.SourceFileLoader("bench", str(SCRIPT))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("bench", loader))
    loader.exec_module(module)
    return module.where(*arguments)


class Bench(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        (self.folder / "plan.yaml").write_text(PLAN, encoding="utf-8")

    def triptych(self, *words):
        done = subprocess.run([PROGRAM, *words], cwd=self.folder, capture_output=True, text=True,
                              env={**os.environ, "TRIPTYCH_DATA": "", "TRIPTYCH_NULL_SCRIPT": "{}"})
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def slowed(self, injected):
        faults = [word for each in injected for word in ("--inject", f"slowdown:50@{each}")]
        store = self.folder / "s.sqlite"
        store.unlink(missing_ok=True)
        self.triptych("run", "plan.yaml", "--device", "null:scripted", "--store", str(store), *faults)
        with contextlib.closing(sqlite3.connect(store)) as database:
            return {key for key, in database.execute("SELECT configuration FROM record WHERE injected <> ''")}

    def test_every_kind_affects_the_listed_configurations(self):
        configurations = [line.split()[-1] for line in self.triptych("list", "plan.yaml").splitlines()]
        self.assertEqual(len(configurations), 4)
        for kind in ("one", "level", "everything"):
            for seed in range(4):
                injected, met = where(kind, configurations, random.Random(seed))
                self.assertEqual(self.slowed(injected), met, f"{kind} {injected}")


if __name__ == "__main__":
    unittest.main()
