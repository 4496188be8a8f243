#pragma once
// A backend without a graphics API, whose devices follow a script. It is used to test measurement,
// supervision and judging, because its correct results are known. Nothing is rendered: an image is
// either read from a file that the script names, or a pattern that depends only on the factors that
// determine an image (data, camera, step, …). Times and counts are computed from the work and a
// seed.
//
// The devices "null:scripted", "null:scripted#2", … are listed only if the environment variable
// TRIPTYCH_NULL_SCRIPT contains a script ("{}" is enough), or if a Script is given. Therefore an
// ordinary run does not list them, and a worker process inherits the script of its parent.
//
// TRIPTYCH_NULL_SCRIPT is a JSON object. Every key is optional, and an unknown key is an error:
//   {
//     "seed": 1,                  seed of noise and outliers
//     "devices": [1, 1.7],        one entry per device: a factor on the device's times
//     "driver_version": "1",      part of the device's key
//     "base_ns": 100000,          a frame takes base_ns + ns_per_sample · samples, where
//     "ns_per_sample": 1,           samples = width · height · longest edge in voxels / step
//     "factors": {"GLOB": 1.25},  factors on the times of matching work; the first match is used
//     "warm_up_factor": 1,        factor on the time of the first frame after each prepare
//     "prepare_factors": [],      factors on the times of the frames after the first, second, …
//                                 prepare of the same work; beyond the list, the factor is 1
//     "noise": 0,                 relative standard deviation of every time
//     "outlier_share": 0,         share of frames that take outlier_factor as long
//     "outlier_factor": 3,
//     "device_over_wall": 0.98,   ratio of device time to wall time; 0, 0.1 or 3 for a wrong clock;
//                                 null: the device has no clock
//     "counts": true,             false: neither counters nor statistics are reported
//     "extra_samples": 0,         added to the counter `samples` of volumes, to simulate more work
//     "sleep": false,             true: a frame really takes its reported time
//     "filter_weight_error": 0,   error of the hardware sampler
//     "images": {"GLOB": "FILE.exr"},           files that replace the pattern
//     "leaks": {"GLOB": BYTES},   memory that each prepare of matching work keeps forever
//     "caches": {"GLOB": BYTES},  memory that only the first prepare of the same work keeps forever
//     "failures": [{"kind": "crash", "at": "frame", "frame": 2, "only": "GLOB", "once": "FILE",
//                   "after": ["GLOB"]}]
//   }
// Kinds of failure:
//   crash           the process aborts
//   exit            the process exits with code 0
//   hang            the call never returns
//   device_lost, api_error, not_supported
//                   the call throws this error (at "supports", it returns the reason instead)
//   wrong_image     every channel of the image is off by 0.25
//   nan_image       the image consists of NaN
//   stale_image     only the first frame draws anything
//   garbage         invalid bytes are written to the pipe for the worker's answers
// Places ("at"): list, open, supports, prepare, frame, image. "frame" is the 0-based number of the
// frame since its work was prepared; at "prepare", it is the number of times that the work was
// prepared before. Without "frame", every frame fails. A failure with "once" creates that file, and
// does not happen if the file exists. A failure with "after" happens only if its process has
// already prepared work that matches each of these globs. GLOBs have the syntax of fnmatch(3). They
// are matched against describe(work), but at "open" against the device id, and at "list" against
// the API.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/image.hpp"
#include "measure/contract/backend.hpp"

namespace triptych::null_backend {

enum class FailureKind : std::uint8_t {
  crash,
  exit,
  hang,
  device_lost,
  api_error,
  not_supported,
  wrong_image,
  nan_image,
  stale_image,
  garbage
};
enum class Place : std::uint8_t { list, open, supports, prepare, frame, image };

struct Failure {
  FailureKind kind = FailureKind::crash;
  Place at = Place::frame;
  std::optional<int> frame;  // Place::frame only
  std::string only = "*";
  std::string once = {};  // the file that limits the failure to one occurrence; empty: no limit
  std::vector<std::string> after = {};  // globs of work that the process must have prepared
};

// The calls made to devices of a script, in order: "open null:scripted", "prepare raycast", "frame
// timing", "frame statistics", "frame counters", "image", "destroy". Not thread-safe.
using CallLog = std::vector<std::string>;

// The keys of TRIPTYCH_NULL_SCRIPT, and the members `log` and `draw`, which JSON cannot express.
struct Script {
  std::uint64_t seed = 1;
  std::vector<double> devices{1};
  std::string driver_version = "1";
  double base_ns = 1e5;
  double ns_per_sample = 1;
  std::vector<std::pair<std::string, double>> factors;  // glob → factor; the first match is used
  double warm_up_factor = 1;
  std::vector<double> prepare_factors;
  double noise = 0;
  double outlier_share = 0;
  double outlier_factor = 3;
  std::optional<double> device_over_wall = 0.98;
  bool counts = true;
  std::uint64_t extra_samples = 0;
  bool sleep = false;
  double filter_weight_error = 0;
  // Glob → EXR file; the first match is used.
  std::vector<std::pair<std::string, std::string>> images;
  // Glob → bytes of memory; the first match is used.
  std::vector<std::pair<std::string, double>> leaks;
  std::vector<std::pair<std::string, double>> caches;
  std::vector<Failure> failures;  // the first match is used

  std::shared_ptr<CallLog> log;                           // null: calls are not logged
  std::function<core::Image(const measure::Work&)> draw;  // draws instead of the pattern
};

// Throws InputError with the key and the expected value.
[[nodiscard]] Script parse_script(std::string_view json);

// Describes work in one line, against which the globs of a script are matched: "technique=raycast,
// data=…,step=0.5,ert=0,sampler=manual,skip=none,shading=0,width=64,height=64,eye=0/0/2,fault=0,
// extra_work_stride=0", without spaces.
[[nodiscard]] std::string describe(const measure::Work& work);

// Creates a backend that follows the script in TRIPTYCH_NULL_SCRIPT. Without a script, the backend
// has no devices. A script that cannot be parsed is listed in Listing::broken, and open() throws
// the InputError.
[[nodiscard]] std::unique_ptr<measure::Backend> make_backend();
[[nodiscard]] std::unique_ptr<measure::Backend> make_backend(Script script);

}  // namespace triptych::null_backend
