"""Tests the window of `triptych view` under Xvfb: it shows the images that `triptych render` writes, its commands reproduce
them, the mouse turns the camera, and every mistake of the user causes one clear line. The program is $TRIPTYCH_PROGRAM."""

import json
import os
import pathlib
import shutil
import signal
import struct
import subprocess
import tempfile
import time
import unittest
import zlib

PROGRAM = os.environ["TRIPTYCH_PROGRAM"]
WINDOW = pathlib.Path(PROGRAM).with_name("triptych-view")
MISSING = (
    "the window is not built: libglfw3-dev or libimgui-dev is missing" if not WINDOW.exists()
    else "xvfb or xauth is missing" if not (shutil.which("xvfb-run") and shutil.which("xauth"))
    else ""
)
SMALL = ["--set", "data=generate:gaussian_blob:16", "--set", "transfer_function=surfaces", "--set", "viewport=96", "--size", "760x520"]
SCRIPTED = {"TRIPTYCH_NULL_SCRIPT": '{"base_ns": 1e3}'}


def program(arguments, display=True, environment=None, **more):
    command = [PROGRAM, "view", *arguments]
    if display:
        command = ["xvfb-run", "-a", "-s", "-screen 0 1400x900x24", *command]
    return subprocess.run(command, capture_output=True, text=True, timeout=120, env={**os.environ, **(environment or {})}, **more)


def png(file):
    """Returns the width, the height and the rows of an 8-bit RGB image. Needs no packages."""
    data = pathlib.Path(file).read_bytes()
    position, packed = 8, b""
    while position < len(data):
        size, kind = struct.unpack(">I4s", data[position:position + 8])
        content = data[position + 8:position + 8 + size]
        if kind == b"IHDR":
            width, height, depth, colours = struct.unpack(">IIBB", content[:10])
            assert (depth, colours) == (8, 2), "not 8-bit RGB"
        elif kind == b"IDAT":
            packed += content
        position += size + 12
    raw, rows, above = zlib.decompress(packed), [], bytes(3 * width)
    for y in range(height):
        start = y * (3 * width + 1)
        rule, row = raw[start], bytearray(raw[start + 1:start + 1 + 3 * width])
        for i in range(len(row) if rule else 0):
            left, up, corner = (row[i - 3], above[i], above[i - 3]) if i >= 3 else (0, above[i], 0)
            if rule == 4:
                guess = left + up - corner
                nearest = min((abs(guess - left), 0, left), (abs(guess - up), 1, up), (abs(guess - corner), 2, corner))[2]
            row[i] = (row[i] + (left, up, (left + up) // 2, nearest if rule == 4 else 0)[rule - 1]) & 255
        rows.append(bytes(row))
        above = rows[-1]
    return width, height, rows


@unittest.skipIf(MISSING, MISSING)
class Window(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def view(self, *arguments, environment=None):
        """Returns the JSON output of the window, and the rows of its image."""
        done = program([*arguments, "--json", "--screenshot", "window.png"], environment=environment, cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr, "")
        return json.loads(done.stdout), png(self.folder / "window.png")

    def render(self, command):
        """Runs a pasted command. Returns the image and the description of its frame."""
        self.assertTrue(command.startswith("triptych render "), command)
        done = subprocess.run(command.replace("triptych", f"'{PROGRAM}'", 1), shell=True, cwd=self.folder, capture_output=True, text=True)
        self.assertIn(done.returncode, (0, 1), done.stderr)
        frame = json.loads((self.folder / "frame/frame.json").read_text(encoding="utf-8"))
        return done.returncode, png(self.folder / "frame/image.png"), frame

    def shown_image(self, column, window):
        x, y, width, height = column["place"]
        return [row[3 * x:3 * (x + width)] for row in window[2][y:y + height]]

    def test_each_column_shows_what_its_command_draws(self):
        shown, window = self.view("volume", *SMALL, "--set", "camera=view:30/20/0.8", "--inject", "half_voxel_shift@gl:*")
        self.assertEqual(window[:2], (760, 520))
        drawn = [column for column in shown["columns"] if column["outcome"] == "measured"]
        if not drawn:
            self.skipTest("no device draws: " + ", ".join(column["reason"] for column in shown["columns"]))
        for column in drawn:
            with self.subTest(device=column["device"]):
                code, image, frame = self.render(column["command"])
                self.assertEqual(column["place"][2:], [96, 96])
                self.assertEqual(self.shown_image(column, window), image[2])
                self.assertEqual(frame["device"], column["device"])
                self.assertEqual(frame["factors"]["camera"], "view:30/20/0.8")
                self.assertEqual(frame["counters"], column["counters"])
                self.assertTrue(column["time_ns"]["samples"])
                # The verdict about the difference must be the same as that of `render --truth`, even with an injected fault.
                self.assertEqual(column["difference"]["with"], "reference")
                self.assertEqual(column["difference"]["right"], code == 0)
                self.assertEqual(column["difference"]["beyond"] > 0, code == 1)
                self.assertEqual("--inject half_voxel_shift" in column["command"], column["device"].startswith("gl:"))
                self.assertEqual(code, 1 if column["device"].startswith("gl:") else 0)

    def test_a_driver_that_crashes_costs_its_own_column(self):
        shown, _ = self.view("volume", *SMALL, "--device", "null:scripted", "--device", "null:scripted,LP_NUM_THREADS=1",
                             "--inject", "crash", environment=SCRIPTED)
        self.assertEqual([column["outcome"] for column in shown["columns"]], ["crashed", "crashed"])
        self.assertIn("SIGSEGV", shown["columns"][0]["reason"])
        self.assertTrue(shown["columns"][1]["command"].startswith("LP_NUM_THREADS=1 triptych render"))

    def test_the_mouse_turns_the_camera(self):
        if not shutil.which("xdotool"):
            self.skipTest("xdotool is missing")
        # A busy machine may merge the steps of a drag, so a drag that the program did not notice is repeated.
        for attempt in range(3):
            camera = self.drag()
            if camera != "orbit_y:1/8":
                break
            time.sleep(attempt)
        self.assertRegex(camera, r"^view:\d")
        azimuth, elevation, distance = map(float, camera.removeprefix("view:").split("/"))
        self.assertLess(azimuth, 45)  # after a drag to the right, the camera is left of the view at 45 degrees
        self.assertGreater(elevation, 0)  # the drag also went down
        self.assertEqual(distance, 1)

    def drag(self):
        script = """
            "$0" view volume "$@" --json > shown.json & window=$!
            xdotool search --sync --onlyvisible --name '^triptych view' > found
            sleep 1.5
            xdotool mousemove 500 100 sleep 0.3 mousedown 1 sleep 0.3 mousemove 505 103 sleep 0.3 mousemove 512 106 sleep 0.3 mouseup 1 sleep 0.3
            kill -TERM $window; wait $window"""
        done = subprocess.run(["xvfb-run", "-a", "-s", "-screen 0 1400x900x24", "sh", "-c", script, PROGRAM, *SMALL, "--device", "null:scripted"],
                              cwd=self.folder, env={**os.environ, **SCRIPTED}, capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        shown = json.loads((self.folder / "shown.json").read_text(encoding="utf-8"))
        levels = dict(part.split("=", 1) for part in shown["configuration"].split(","))
        return levels["camera"]


class Mistakes(unittest.TestCase):
    def refused(self, arguments, code, *expected, **more):
        done = program(arguments, display=False, environment={**SCRIPTED, "DISPLAY": "", "WAYLAND_DISPLAY": ""}, **more)
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        for text in expected:
            self.assertIn(text, done.stderr)

    def test_unknown_names_are_reported(self):
        self.refused(["clouds"], 3, "unknown suite 'clouds'", "volume")
        self.refused(["volume", "--set", "stepp=1"], 3, "did you mean 'step'?")
        self.refused(["volume", "--set", "step=1,2"], 3, "one level")
        self.refused(["volume", "--set", "technique=auto"], 3, "auto")
        self.refused(["volume", "--set", "camera=view:0/91/1"], 3, "elevation")
        self.refused(["volume", "--inject", "rust"], 3, "rust")

    @unittest.skipIf(WINDOW.exists(), "the window is built")
    def test_a_window_that_was_not_built_names_its_packages(self):
        self.refused(["volume"], 3, "libglfw3-dev", "libimgui-dev")

    @unittest.skipUnless(WINDOW.exists(), "the window is not built")
    def test_a_missing_display_and_device_are_named(self):
        self.refused(["volume", "--device", "null:scripted"], 3, "there is no display")
        self.refused(["volume", "--device", "vulkan:nobody"], 2, "no device matches vulkan:nobody")
        self.refused(["volume", *5 * ["--device", "null:scripted"]], 3, "matches 5 devices")
        self.refused(["volume", "--device", "null:scripted,oops"], 3, "NAME=VALUE")

    @unittest.skipUnless(WINDOW.exists(), "the window is not built")
    def test_a_window_without_its_program_is_refused(self):
        """Copies triptych without triptych-view, the program that shows the window."""
        with tempfile.TemporaryDirectory() as folder:
            alone = shutil.copy(PROGRAM, folder)
            done = subprocess.run([alone, "view", "volume"], capture_output=True, text=True)
            self.assertEqual(done.returncode, 3)
            self.assertIn("libglfw3-dev", done.stderr)


if __name__ == "__main__":
    unittest.main()
