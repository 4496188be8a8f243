"""Runs scripts of ci/ in a separate checkout, with replacements for all programs that they call. Checks the files that
they leave, their places, and the output. The test needs no root, no network and no build."""

import os
import pathlib
import subprocess
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Replaces unshare: runs the command in the folder itself, whereas ci/root would run it in a Debian system inside that folder.
UNSHARE = """while [ "$1" != root ]; do shift; done
root=$2 count=$3
shift 3
printf '%s\\n' "${@:1:count}" >"$CALLS"
shift "$count"
words=("${@//"/triptych"/"$root/triptych"}")
if [ "$1" = env ]; then words=("$@"); fi
exec "${words[@]}"
"""
# Replaces mmdebstrap: creates an empty system.
STAND_INS = {"unshare": UNSHARE, "mmdebstrap": 'mkdir "${@: -1}/etc" 2>/dev/null || mkdir "${@: -2:1}/etc"',
             "id": "echo 0", "chroot": "", "arch-test": "", "apt-get": ""}


class Scripts(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory())).resolve()
        self.checkout = self.folder / "checkout"
        for script in ("gate", "build", "fresh", "root", "arm64", "setup", "package", "fuzz"):
            self.put(f"checkout/ci/{script}", (ROOT / "ci" / script).read_text(encoding="utf-8"))
        for name, text in STAND_INS.items():
            self.put(f"bin/{name}", f"#!/bin/bash\n{text}\n")

    def put(self, name, text):
        file = self.folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")
        file.chmod(0o755)

    def run_script(self, script, *words, folder=None, **environment):
        return subprocess.run([script, *map(str, words)], cwd=folder or self.checkout, capture_output=True, text=True,
                              env={**os.environ, "PATH": f"{self.folder}/bin:{os.environ['PATH']}", "TMPDIR": str(self.folder),
                                   "CALLS": str(self.folder / "calls"), **environment})

    def test_help_and_usage_from_anywhere(self):
        for script in ("setup", "package", "fuzz"):
            for word, code in (("--help", 0), ("--nonsense", 3)):
                done = self.run_script(f"checkout/ci/{script}", word, folder=self.folder)
                self.assertEqual(done.returncode, code, script + done.stderr)
                self.assertIn(f"ci/{script} [", done.stdout + done.stderr)

    def test_a_build_reports_its_progress_and_its_time(self):
        self.put("bin/cmake", "#!/bin/sh\n[ \"$1\" != --build ] || { echo \"${NINJA_STATUS%%%*}3/12] Building\"; sleep 2; }\n")
        done = self.run_script("ci/build", "release", "triptych", PROGRESS_S="0.5")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertRegex(done.stdout, r"\nbuild: 3 of 12 steps done after \d+ s\n(.*\n)*build: done in \d+ s\n$")
        self.put("bin/cmake", "#!/bin/sh\necho FAILED; exit 1\n")
        started = time.monotonic()
        done = self.run_script("ci/build", "release", PROGRESS_S="60")
        self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
        self.assertLess(time.monotonic() - started, 30, "the caller must not wait for the next progress line")

    def test_a_gate_states_the_time_of_each_phase(self):
        for name in ("ci/setup", "ci/build", "ci/environment", "build/release/src/app/triptych"):
            self.put(f"checkout/{name}", "#!/bin/sh\n")
        done = self.run_script("ci/gate")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertRegex(done.stdout, r"gate: installing took \d+ s, and building \d+ s")

    def test_a_gate_that_ends_early_leaves_no_earlier_verdict(self):
        self.put("checkout/ci/setup", "#!/bin/sh\nexit 3\n")
        told = ["summary.md", "report.html", "gate.log", "benchmark.json", "gate.sqlite", "gate.sqlite-wal", "volume-quick.xml"]
        for name in [*told, "mine.xml"]:
            self.put(f"checkout/out/{name}", "PASS")
        self.assertEqual(self.run_script("ci/gate").returncode, 3)
        self.assertEqual([each.name for each in (self.checkout / "out").iterdir()], ["mine.xml"])

    def test_a_package_made_in_a_fresh_debian_stays(self):
        self.put("checkout/ci/package", "#!/bin/sh\nmkdir -p out && echo made >out/triptych_1.deb\n")
        for words in ("init -q", "add ci", "-c user.name=x -c user.email=x commit -qm x"):
            subprocess.run(["git", *words.split()], cwd=self.checkout, check=True)
        done = self.run_script("ci/fresh", "trixie", "ci/package")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual((self.checkout / "out/triptych_1.deb").read_text(), "made\n")
        self.assertIn("fresh: created out/triptych_1.deb\n", done.stdout)
        self.assertEqual(list(self.folder.glob("triptych-trixie.*")), [])

    def test_a_package_for_arm64_goes_where_it_is_asked_for(self):
        (self.checkout / "build/arm64-root").mkdir(parents=True)
        for name, text in (("setup", ""), ("build", ""), ("package", 'echo "$*"')):
            self.put(f"checkout/ci/{name}", f"#!/bin/sh\n{text}\n")
        elsewhere = self.folder / "elsewhere"
        for word, folder in ((elsewhere, elsewhere), (None, self.checkout / "out")):
            done = self.run_script("ci/arm64", "--package", *([word] if word else []))
            self.assertEqual(done.stdout, f"--built arm64 {folder}\n", done.stderr)
            self.assertTrue(folder.is_dir())
            self.assertEqual((self.folder / "calls").read_text().splitlines(), [str(self.checkout), str(folder)])


if __name__ == "__main__":
    unittest.main()
