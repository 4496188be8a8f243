"""Creates the pages of two gates on this machine's devices: one that passes, and one with an injected fault of each kind.
The scenes are small, and these gates have baselines of their own. The program under test measures every run.
"""
import os
import subprocess

DEVICES = ["gl:llvmpipe-egl", "opencl:pocl", "vulkan:lavapipe"]
COST = """suite: volume
checks: [cost, memory, correlation]
technique: [raycast]
data: [generate:sparse_field:32]
transfer_function: [haze, surfaces]
step: [2, 3, 4, 6, 8]
viewport: [16]
"""
ACCURACY = """suite: volume
checks: [image, counters, accuracy]
technique: [raycast]
data: ['analytic:v1_constant:8', 'analytic:v4_gaussian:8']
transfer_function: [own]
step: [1, 0.5, 0.25]
voxel: [f32]
skip: [none]
ert: [0]
camera: ['orbit_y:1/9']
viewport: [24]
"""
# Plans for a page with unusual scenes: the stress plans of both suites, and the accuracy plan for volumes. Only 1/120 of their
# configurations are drawn. One data file is missing on purpose, because TRIPTYCH_DATA is empty.
HOSTILE = ["volume/stress", "particles/stress", "volume/accuracy"]
PLANS = {
    "volume/quick": ["technique=raycast,raycast_fragment", "data=generate:marschner_lobb:32", "viewport=64",
                     "transfer_function=surfaces"],
    "particles/quick": ["technique=quad_screen,tiles", "data=generate:uniform:1000", "viewport=64",
                        "camera=orbit_y:1/8"],
    "cost.yaml": [],
}
# Counting instructions takes seconds per device. Therefore the passing gate counts them on only two devices, and the failing gate
# on only one.
COUNTING = {"pass": ["gl:llvmpipe-egl", "vulkan:lavapipe"], "fail": ["vulkan:lavapipe"]}
FAULTS = {
    "volume/quick": ["half_voxel_shift@vulkan:*", "lost_counter@opencl:*"],
    "particles/quick": ["crash@gl:*", "hang@opencl:*"],
    "cost.yaml": ["slowdown:20@vulkan:*"],
}


class Triptych:
    """Runs Triptych in a folder of its own."""

    def __init__(self, program, folder):
        self.program = program
        self.folder = folder

    def run(self, *arguments):
        return subprocess.run([self.program, *arguments], cwd=self.folder, capture_output=True, text=True,
                              env=dict(os.environ, TRIPTYCH_DATA=""), timeout=600)

    def __call__(self, *arguments, code=0):
        done = self.run(*arguments)
        if done.returncode != code:
            raise AssertionError(f"{' '.join(arguments)}: {done.returncode}, not {code}\n{done.stdout}{done.stderr}")
        return done.stdout

    def devices(self):
        """Returns which of DEVICES are available. Requests a device that does not exist, because the error message lists
        all devices at once. The command `devices` would also calibrate their clocks, which takes seconds."""
        listed = self.run("run", "volume/quick", "--device", "no:device").stderr.split()
        return [device for device in DEVICES if device in [word.rstrip(";") for word in listed]]


def factors(plan):
    return [word for factor in PLANS[plan] for word in ("--set", factor)]


def chosen(devices):
    return [word for device in devices for word in ("--device", device)]


def measure(triptych, name, faults):
    """Runs the plans with the faults that `faults` lists for each plan. Only one run is timed, because calibrating the
    clocks takes seconds."""
    for plan in PLANS:
        devices = COUNTING[name] if plan == "cost.yaml" else DEVICES
        injected = [word for fault in faults.get(plan, []) for word in ("--inject", fault)]
        untimed = [] if plan == "cost.yaml" or (plan, name) == ("volume/quick", "pass") else ["--untimed"]
        limit = ["--limit", "5"] if "hang@opencl:*" in injected else []
        triptych("run", plan, *factors(plan), *chosen(devices), *injected, *untimed, *limit, "--store", f"{name}.sqlite")


def make(triptych):
    """Returns {name of a page: its file}. The files are in the program's folder."""
    for name, text in {"cost.yaml": COST, "accuracy.yaml": ACCURACY}.items():
        with open(os.path.join(triptych.folder, name), "w", encoding="utf-8") as file:
            file.write(text)
    measure(triptych, "pass", {})
    for plan in PLANS:
        triptych("accept", plan, "--store", "pass.sqlite", "--baselines", "accepted", "--reason", "the page's test")
    measure(triptych, "fail", FAULTS)
    triptych("run", *HOSTILE, "--device", "vulkan:lavapipe", "--untimed", "--fraction", "1/120", "--store", "hostile.sqlite")
    triptych("run", "accuracy.yaml", *chosen(DEVICES), "--store", "accuracy.sqlite")
    pages = {}
    for name in ("pass", "fail", "hostile", "accuracy"):
        baselines = ["--baselines", "accepted"] if name in COUNTING else []
        triptych("report", "--store", f"{name}.sqlite", *baselines, "--out", f"{name}.html")
        pages[name] = os.path.join(triptych.folder, f"{name}.html")
    triptych("history", "pass.sqlite", "fail.sqlite", "--out", "history.html")
    pages["history"] = os.path.join(triptych.folder, "history.html")
    return pages
