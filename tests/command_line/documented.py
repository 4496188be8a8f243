"""Runs every command of triptych that README.md, CONTRIBUTING.md and docs/ show in a block of code or of program output.
The commands of a page run in the order of the page, on a scripted device, in an empty folder. Devices and plans are
replaced by small ones; the names of commands, options and files stay. Commands of other programs must be in ELSEWHERE,
which says what runs them. The program is $TRIPTYCH_PROGRAM.
"""

import glob
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ["TRIPTYCH_PROGRAM"]
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").glob("*.md"))]
PLANS = {
    "volume": "suite: volume\ntechnique: [raycast]\ndata: ['generate:gaussian_blob:8']\ntransfer_function: [surfaces]\nviewport: [8]\n",
    "particles": "suite: particles\ntechnique: [quad_ray]\nculling: [none]\ndata: ['generate:uniform:10']\nviewport: [8]\n",
}
# Commands that are run by another test or by CI.
ELSEWHERE = {
    "ci/gate": "ci_test and CI", "ci/test": "CI", "ci/build": "ci_test", "ci/setup": "CI", "ci/lint": "CI",
    "ci/fresh": "needs root and a network", "ci/fuzz": "CI", "ci/package": "ci/fresh", "ci/arm64": "needs root and a network",
    "ci/drivers/fetch": "needs a network", "ci/drivers/spheres": "the test drivers.spheres", "analysis/rays": "analysis.unit",
    "ci/peers/embree_spheres": "no test: its packages are not installed",
    "ci/drivers/history": "needs a network", "ci/gpu": "needs a GPU", "ci/bench": "takes hours", "ci/cluster/submit": "cluster tests",
    "ci/dashboard": "command_line.dashboard", "ci/ratios": "command_line.ratios", "ci/publish": "analysis.publish", "analysis/analyze": "analysis.end_to_end", "analysis/notebook": "analysis.end_to_end",
    "apt-get": "examples_test",
    "ctest": "CI", "cmake": "CI", "git": "the triptych command in it is run", "cc": "layer.FramePrograms", "gdb": "interactive", "renderdoccmd": "the triptych command in it is run",
    "apitrace": "the triptych command in it is run", "cat": "", "exit": "", "export": "",
}
BLOCK = re.compile(r"^```(\w*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
LANGUAGES = ("", "sh", "text")  # text: program output, which may contain a command to paste
# Does not match the last line of `run`, which states the time that "triptych itself" took.
COMMAND = re.compile(r"(?:^|[\s;(/])triptych (?!itself)(?P<words>[a-z][^)\n]*)")
FORM = re.compile(r"…| {2,}[a-z]")  # "STORE…" or an explanation after spaces marks a synopsis, which is not run


def commands(page):
    """Returns the lines of a page's code blocks. A line that ends in a backslash continues on the next line."""
    blocks = BLOCK.findall(page.read_text(encoding="utf-8"))
    for block in (text for language, text in blocks if language in LANGUAGES):
        for line in re.sub(r"\\\n\s*", "", block).splitlines():
            yield re.split(r"\s+#", line)[0].strip()


def small(words):
    """Returns the same command with the scripted device, with plans of one scene, and with files in the test's own
    folder."""
    words = re.sub(r"'?(?:vulkan|gl|opencl):[\w*-]+(?:,[A-Z_]+=\w+)?'?", "null:scripted", words.removesuffix("'").partition(" || ")[0])
    words = re.sub(r"\b(volume|particles)/(\w+)", r"\1-\2.yaml", words).replace("/tmp/", "")
    words = re.sub(r"\S*build/\S*/triptych\b", PROGRAM, words).replace('"…"', "documented").replace("7/4000", "1/1")
    name = words.split()[0]
    if name in ("gate", "compare") and ".yaml" not in words and "--apis" not in words:
        words += " volume-quick.yaml particles-quick.yaml"
    # Data files are not available, so they are replaced by generated data of the same kind.
    generated = "generate:uniform:10" if " particles" in words else "generate:gaussian_blob:8"
    words = re.sub(r"\bdata=[\w-]+\.\w[\w.]*", f"data={generated}", words)
    if "--after" in words:  # the plan must contain the frame
        words = re.sub(r" --set \S+", "", words)
        words += " --set technique=raycast --set data=generate:gaussian_blob:8 --set transfer_function=surfaces --set viewport=8"
    if name in ("gate", "accept"):
        words += " --baselines baselines" if "--base" not in words else ""  # neither --base nor --baselines
    if name in ("gate", "run") and "--device" not in words:
        words += " --device null:scripted"
    if name == "devices":
        words += " --device 'null:*'"
    if name == "validate":
        words += " --shard 1/3000" + (" --baselines baselines" if "--baselines" not in words else "")
    words = words.replace("mandelbulb:96", "mandelbulb:32")
    return re.sub(r"--budget \d+", "--budget 1", words)


def run(words, folder, environment):
    """Runs the command to its end. `view` gets a display and closes by itself; it cannot run if its window or Xvfb is
    missing."""
    command = f"'{PROGRAM}' {words}"
    if words.startswith("view "):
        if not pathlib.Path(PROGRAM).with_name("triptych-view").exists() or not (shutil.which("xvfb-run") and shutil.which("xauth")):
            return None
        command = f"xvfb-run -a {command}" + ("" if "--screenshot" in words else " --screenshot shown.png")
        command += "" if "viewport=" in words else " --set viewport=32"
    return subprocess.run(command, shell=True, cwd=folder, env=environment, capture_output=True, text=True)


class Documented(unittest.TestCase):
    def run_page(self, page):
        environment = {**os.environ, "TRIPTYCH_NULL_SCRIPT": '{"base_ns": 1e3}', "TRIPTYCH_DATA": ""}
        with tempfile.TemporaryDirectory() as folder:
            shown = [(line, COMMAND.search(line)) for line in commands(page)]
            ran = set()
            for line, command in ((line, small(match["words"])) for line, match in shown if match and not FORM.search(match[0])):
                for suite, plan in re.findall(r"\b(volume|particles)(-\w+\.yaml)", command):
                    pathlib.Path(folder, suite + plan).write_text(PLANS[suite], encoding="utf-8")
                if command in ran:
                    continue
                ran.add(command)
                with self.subTest(page=page.name, command=line):
                    done = run(command, folder, environment)
                    if done is None:
                        continue
                    self.assertIn(done.returncode, (0, 1, 2), f"{command}\n{done.stdout[-500:]}{done.stderr[-500:]}")
                    self.ran += 1

    def test_each_command_of_the_program_runs(self):
        self.ran = 0
        for page in PAGES:
            self.run_page(page)
        self.assertGreater(self.ran, 20)

    def test_every_example_in_help_runs(self):
        """Runs the example of every command that help lists, after the examples of run and accept."""
        listed = subprocess.run([PROGRAM, "--help"], capture_output=True, text=True).stdout
        names = re.findall(r"^  ([a-z]+) ", listed[listed.index("ubcommands:"):], re.MULTILINE)
        self.assertGreater(len(names), 10)
        environment = {**os.environ, "TRIPTYCH_NULL_SCRIPT": '{"base_ns": 1e3}', "TRIPTYCH_DATA": ""}
        with tempfile.TemporaryDirectory() as folder:
            for suite, text in PLANS.items():
                pathlib.Path(folder, f"{suite}-quick.yaml").write_text(text, encoding="utf-8")
            for name in sorted(names, key=lambda each: (each != "run", each != "accept")):
                with self.subTest(command=name):
                    text = subprocess.run([PROGRAM, name, "--help"], capture_output=True, text=True).stdout
                    example = re.search(r"^Example:\s+triptych (.*)$", text, re.MULTILINE)
                    self.assertIsNotNone(example, text)
                    command = small(example[1])
                    done = run(command, folder, environment)
                    if done is not None:
                        self.assertIn(done.returncode, (0, 1, 2), f"{command}\n{done.stdout[-500:]}{done.stderr[-500:]}")
                if name == "run":  # creates the stores that other examples use
                    for store in ("shard-1", "old", "new", "monday", "tuesday"):
                        shutil.copy(pathlib.Path(folder, "results.sqlite"), pathlib.Path(folder, f"{store}.sqlite"))

    def test_every_mentioned_option_exists(self):
        """The program's help must contain every command and option that appears in a synopsis or between backquotes."""
        helps = {}
        for page in PAGES:
            text = page.read_text(encoding="utf-8")
            listed = [re.split(r" {2,}|(?<=…) (?=[a-z])", line)[0] for line in commands(page) if FORM.search(line)]
            for form in listed + re.findall(r"`([^`\n]+)`", text):
                for words in (part.removeprefix("triptych ").split() for part in form.split(", ") if form.startswith("triptych ")):
                    if not words or not words[0].isalpha() or words[0] == "worker":
                        continue
                    with self.subTest(page=page.name, form=form):
                        if words[0] not in helps:
                            helps[words[0]] = subprocess.run([PROGRAM, words[0], "--help"], capture_output=True, text=True)
                        self.assertEqual(helps[words[0]].returncode, 0, helps[words[0]].stderr)
                        for option in (word for word in words if re.match(r"--\w", word)):
                            self.assertRegex(helps[words[0]].stdout, rf"{option}\b")

    def test_other_commands_are_known(self):
        for page in PAGES:
            for line in commands(page):
                for word in re.findall(r"^(?:\(\. \S+; )?((?:ci|analysis)/[\w/]+|apt-get|ctest|cmake|git)\b", line):
                    with self.subTest(page=page.name, command=line):
                        self.assertIn(word, ELSEWHERE)
                        if "/" in word:
                            self.assertTrue((ROOT / word).exists())


if __name__ == "__main__":
    unittest.main()
