"""Code shared by the comparisons in this folder: measuring Triptych, VTK's window, and the ratio of times at equal error."""
import argparse
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

PROGRAM = pathlib.Path(__file__).resolve().parents[2] / "build/release/src/app/triptych"
WARM_UP, FRAMES, LONGEST = 4, 20, 3.0  # VTK measurements: warm-up frames, timed frames, and the time limit in s


def arguments_of(description):
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--triptych", default=str(PROGRAM))
    parser.add_argument("--device", default="gl:llvmpipe-egl")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--error", type=float, default=1 / 255, help="error limit: root mean square over RGBA in linear colours")
    return parser


def start(parser, compare):
    """Runs compare(arguments, folder) on a virtual X display with Mesa's software OpenGL, and exits with the code that it
    returns."""
    arguments = parser.parse_args()
    if "DISPLAY" not in os.environ:  # Debian's VTK needs GLX to open a window
        os.environ["LIBGL_ALWAYS_SOFTWARE"] = "1"
        os.execvp("xvfb-run", ["xvfb-run", "-a", "-s", "-screen 0 640x480x24", sys.executable, *sys.argv])
    with tempfile.TemporaryDirectory() as folder:
        sys.exit(compare(arguments, pathlib.Path(folder)))


def ask(command):
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))} exited with code {done.returncode}:\n{done.stderr}")
    return done.stdout


class Ours:
    """Triptych's side of the comparison: a plan with one scene, measured on one device."""

    def __init__(self, arguments, folder, plan):
        self.triptych, self.device, self.folder, self.plan = arguments.triptych, arguments.device, folder, plan
        self.file, self.store = folder / "ours.yaml", folder / "ours.sqlite"
        self.file.write_text(json.dumps({"summary": "Compared with VTK"} | plan))  # JSON is YAML

    def frame(self):
        """Returns the description of the frame, which `triptych render` writes for other programs."""
        levels = [f"--set={factor}={value[0] if isinstance(value, list) else value}"
                  for factor, value in self.plan.items() if factor != "suite"]
        ask([self.triptych, "render", self.plan["suite"], "--device", self.device, "--out", self.folder, *levels])
        return json.loads((self.folder / "frame.json").read_text())

    def measure(self):
        ask([self.triptych, "run", self.file, "--device", self.device, "--store", self.store])
        judged = subprocess.run([self.triptych, "gate", self.file, "--check", "accuracy", "--json", "--store",
                                 self.store], stdout=subprocess.PIPE, text=True).stdout
        return {case["configuration"]: (case["time_ns"], case["rmse"])
                for scene in json.loads(judged)["accuracies"] for case in scene["configurations"]}


class Window:
    """VTK's off-screen window that shows one prop, with the camera of Triptych's frame."""

    def __init__(self, frame, add, edge):
        from vtkmodules import vtkRenderingCore
        import vtkmodules.vtkRenderingOpenGL2  # noqa: F401, the window's implementation
        self.edge, view = edge, frame["camera"]
        renderer = vtkRenderingCore.vtkRenderer()
        renderer.SetBackground(0, 0, 0)
        renderer.SetBackgroundAlpha(0)
        add(renderer)
        camera = renderer.GetActiveCamera()
        camera.SetPosition(view["eye"])
        camera.SetFocalPoint([e + f for e, f in zip(view["eye"], view["forward"])])
        camera.SetViewUp(view["up"])
        camera.SetViewAngle(view["fov_y_deg"])
        camera.SetClippingRange(max(view["near"], 1e-3 * view["far"]), view["far"])
        self.window = vtkRenderingCore.vtkRenderWindow()
        self.window.SetOffScreenRendering(1)
        self.window.SetAlphaBitPlanes(1)
        self.window.SetMultiSamples(0)
        self.window.SetSize(edge, edge)
        self.window.AddRenderer(renderer)

    def driver(self):
        self.window.Render()
        lines = self.window.ReportCapabilities().splitlines()
        return next((line.strip() for line in lines if "renderer string" in line), "unknown renderer")

    def time(self):
        """Returns the median frame time in nanoseconds."""
        times, begin = [], time.perf_counter()
        for frame in range(WARM_UP + FRAMES):
            before = time.perf_counter_ns()
            self.window.Render()
            self.window.WaitForCompletion()
            if frame >= WARM_UP:
                times.append(time.perf_counter_ns() - before)
            if len(times) >= 3 and time.perf_counter() - begin > LONGEST:
                break
        return statistics.median(times)

    def rmse(self, limit):
        """Returns the error of VTK's image against `limit`, an image in premultiplied RGBA, top row first."""
        from vtkmodules import vtkCommonCore
        from vtkmodules.util import numpy_support
        self.window.Render()
        pixels = vtkCommonCore.vtkUnsignedCharArray()
        self.window.GetRGBACharPixelData(0, 0, self.edge - 1, self.edge - 1, 0, pixels)
        image = numpy_support.vtk_to_numpy(pixels).reshape(self.edge, self.edge, 4)[::-1] / 255.0
        return float(((image - limit) ** 2).mean() ** 0.5)


def pixel_rays(frame, edge):
    """Returns the ray directions through the pixel centres as an array [y, x, 3], top row first. Their component along the view
    axis is 1."""
    import numpy
    view = frame["camera"]
    forward, up = numpy.array(view["forward"]), numpy.array(view["up"])
    right = numpy.cross(forward, up)
    half = numpy.tan(numpy.radians(view["fov_y_deg"]) / 2)
    across = (2 * (numpy.arange(edge) + 0.5) / edge - 1) * half
    return forward + across[None, :, None] * right - across[:, None, None] * up


def by_turns(rounds, ours, theirs):
    """Calls two functions alternately, both of which return {name: (ns, error)}. Returns for each function the fastest result
    per name."""
    best = {}, {}
    for _ in range(rounds):
        for side, measure in zip(best, (ours, theirs)):
            for name, case in measure().items():
                side[name] = min(case, side.get(name, case))
    return best


def short_names(cases):
    """Removes the levels that all names have in common, for example to get {"step=1": …} from {"data=x,step=1": …}."""
    shared = set.intersection(*(set(name.split(",")) for name in cases))
    return {",".join(level for level in name.split(",") if level not in shared): case
            for name, case in cases.items()}


def print_ratio(scene, ours, vtk, error):
    """Prints the Pareto front of each side, and the ratio of the smallest times within the error limit. Returns whether there
    is a ratio."""
    print(f"{scene}")
    ours = short_names(ours)
    for program, cases in (("Triptych", ours), ("VTK", vtk)):
        least = float("inf")
        for name, (ns, rmse) in sorted(cases.items(), key=lambda case: case[1]):
            if rmse < least:
                print(f"  {program:8} {ns / 1e6:9.3f} ms  RMSE {rmse * 255:8.4f}/255  {name}")
            least = min(least, rmse)
    fastest = [min(((ns, name) for name, (ns, rmse) in cases.items() if rmse <= error), default=None)
               for cases in (ours, vtk)]
    if None in fastest:
        print(f"  no ratio, because RMSE {error:.5f} was not reached by "
              f"{' and '.join(p for p, f in zip(('Triptych', 'VTK'), fastest) if f is None)}")
        return False
    (our_ns, our_name), (vtk_ns, vtk_name) = fastest
    print(f"  time to RMSE {error:.5f}: Triptych {our_ns / 1e6:.3f} ms ({our_name}), VTK {vtk_ns / 1e6:.3f} ms "
          f"({vtk_name}); ratio {our_ns / vtk_ns:.3f}")
    return True
