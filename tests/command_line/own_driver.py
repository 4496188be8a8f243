"""Compares a driver that somebody built with the driver of the distribution, as docs/ci.md describes. The driver from
bookworm-backports stands in for the built one, so the test is skipped except on Debian 12."""

import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PLAN = """suite: volume
checks: [image, counters]
technique: [raycast, raycast_fragment]
data: [generate:gaussian_blob:16]
transfer_function: [haze]
viewport: [16]
"""


def with_newer_driver(command, folder):
    environment = {**os.environ, "TRIPTYCH_DATA": "", "PATH": f"{folder / 'bin'}:{os.environ['PATH']}"}
    return subprocess.run([ROOT / "ci/drivers/spheres", "--run", "sh", "-c", f"cd '{folder}'\n{command}"],
                          env=environment, capture_output=True, text=True)


class OwnDriver(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        (self.folder / "own.yaml").write_text(PLAN, encoding="utf-8")
        (self.folder / "bin").mkdir()
        (self.folder / "bin/triptych").symlink_to(os.environ["TRIPTYCH_PROGRAM"])
        installed = self.folder / "mesa/share/vulkan/icd.d"
        installed.mkdir(parents=True)
        newer = with_newer_driver("readlink -f \"$VK_DRIVER_FILES\"; readlink -f \"${LD_LIBRARY_PATH%%:*}\"", self.folder)
        manifest, libraries = newer.stdout.split()
        (installed / "lvp_icd.x86_64.json").symlink_to(manifest)
        (self.folder / "mesa/lib").mkdir()
        (self.folder / "mesa/lib/x86_64-linux-gnu").symlink_to(libraries)

    def gate(self, *options):
        """Runs the command from docs/ci.md with a small plan and the options."""
        text = (ROOT / "docs/ci.md").read_text(encoding="utf-8")
        block = next(each for each in re.findall(r"```sh\n(.*?)```", text, re.S) if "--base VK_DRIVER_FILES" in each)
        command = block.replace("triptych gate", f"triptych gate own.yaml --json {' '.join(options)}")
        done = with_newer_driver(command, self.folder)
        result = json.loads(done.stdout)
        regressions = [each["cause"] for configuration in result["configurations"]
                       for each in configuration["differences"] if each["kind"] == "regression"]
        return done.returncode, result, regressions

    def test_two_drivers_that_draw_the_same_pass(self):
        code, result, regressions = self.gate()
        self.assertEqual((code, regressions), (0, []))
        self.assertNotEqual(result["a"]["driver_version"], result["b"]["driver_version"])

    def test_a_driver_that_draws_something_else_fails(self):
        code, _, regressions = self.gate("--inject half_voxel_shift")
        self.assertEqual(code, 1)
        self.assertIn("wrong_image", regressions)


def main():
    tried = with_newer_driver("true", ROOT)
    if tried.returncode == 77:
        print(tried.stdout.strip())
        return 77
    return 0 if unittest.main(exit=False).result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main())
