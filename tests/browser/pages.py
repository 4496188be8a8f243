"""Makes pages with this machine's devices as a gate does: one that passes, and one with an injected fault of each kind.
Scenes are small, and the baselines are separate. The program under test measures every run.
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
PLANS = {
    "volume/quick": ["technique=raycast,raycast_fragment", "data=generate:marschner_lobb:32", "viewport=64",
                     "transfer_function=surfaces"],
    "particles/quick": ["technique=quad_screen,tiles", "data=generate:uniform:1000", "viewport=64",
                        "camera=orbit_y:1/8"],
    "cost.yaml": [],
}
FAULTS = {
    "volume/quick": ["half_voxel_shift@vulkan:*", "lost_counter@opencl:*"],
    "particles/quick": ["crash@gl:*", "hang@opencl:*"],
    "cost.yaml": ["slowdown:20@vulkan:*"],
}


class Triptych:
    """Runs the program in a separate folder."""

    def __init__(self, program, folder):
        self.program = program
        self.folder = folder

    def __call__(self, *arguments, code=0):
        done = subprocess.run([self.program, *arguments], cwd=self.folder, capture_output=True, text=True,
                              env=dict(os.environ, TRIPTYCH_DATA=""), timeout=600)
        if done.returncode != code:
            raise AssertionError(f"{' '.join(arguments)}: {done.returncode}, not {code}\n{done.stdout}{done.stderr}")
        return done.stdout

    def devices(self):
        return [device for device in DEVICES if device in self("devices")]


def factors(plan):
    return [word for factor in PLANS[plan] for word in ("--set", factor)]


def measure(triptych, store, faults):
    """`faults`: the faults to inject, by plan."""
    chosen = [word for device in DEVICES for word in ("--device", device)]
    for plan in PLANS:
        injected = [word for fault in faults.get(plan, []) for word in ("--inject", fault)]
        triptych("run", plan, *factors(plan), *chosen, *injected, "--limit", "4", "--store", store)


def make(triptych):
    """Returns {name of the page: its file}. The files are in the program's folder."""
    for name, text in {"cost.yaml": COST, "accuracy.yaml": ACCURACY}.items():
        with open(os.path.join(triptych.folder, name), "w", encoding="utf-8") as file:
            file.write(text)
    measure(triptych, "pass.sqlite", {})
    for plan in PLANS:
        triptych("accept", plan, "--store", "pass.sqlite", "--baselines", "accepted", "--reason", "the page's test")
    measure(triptych, "fail.sqlite", FAULTS)
    pages = {}
    for name in ("pass", "fail"):
        triptych("report", "--store", f"{name}.sqlite", "--baselines", "accepted", "--out", f"{name}.html")
        pages[name] = os.path.join(triptych.folder, f"{name}.html")
    triptych("history", "pass.sqlite", "fail.sqlite", "--out", "history.html")
    pages["history"] = os.path.join(triptych.folder, "history.html")
    # Makes the pages of a driver with a few scenes of a validation, and of errors against cost and time.
    triptych("validate", "--device", "vulkan:lavapipe", "--shard", "1/60", "--out", "validation", code=2)  # some data files are missing
    pages["validation"] = os.path.join(triptych.folder, "validation", "report.html")
    chosen = [word for device in DEVICES for word in ("--device", device)]
    triptych("run", "accuracy.yaml", *chosen, "--store", "accuracy.sqlite")
    triptych("report", "--store", "accuracy.sqlite", "--out", "accuracy.html")
    pages["accuracy"] = os.path.join(triptych.folder, "accuracy.html")
    return pages
