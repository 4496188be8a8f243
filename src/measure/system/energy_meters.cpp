#include "measure/system/energy_meters.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>
#include <set>
#include <system_error>

#include "measure/system/stopwatch.hpp"

namespace triptych::measure {
namespace {

namespace fs = std::filesystem;

template <typename Value>
std::optional<Value> value_of(const fs::path& file) {
  std::ifstream stream(file);
  Value value{};
  if (stream >> value) return value;
  return std::nullopt;
}

// Returns whether a counter works. In a virtual machine, a counter may exist but stay at 0.
bool counts(const fs::path& file) {
  return value_of<std::uint64_t>(file).value_or(0) > 0;
}

// Returns the entries of a folder whose names begin with `prefix`, sorted by name. Returns an empty
// list if the folder does not exist.
std::vector<fs::path> entries(const fs::path& folder, std::string_view prefix) {
  std::set<fs::path> found;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (it->path().filename().string().starts_with(prefix)) found.insert(it->path());
  }
  return {found.begin(), found.end()};
}

}  // namespace

// The energy counted by one meter over several frames, from the first update of the meter to the
// last.
class EnergyMeters::Span {
 public:
  // Must be called between frames. `microjoules` is the value of the meter after `frames` frames
  // and `ns` nanoseconds, and `range` is Meter::range.
  void update(std::uint64_t microjoules, int frames, double ns, std::uint64_t range) {
    if (seen_ && microjoules != last_) {
      const bool known = microjoules > last_ || range > last_;
      if (updated_ && known) {
        sum_ += microjoules > last_ ? microjoules - last_ : range - last_ + microjoules;
        frames_ = frames - first_frame_;
        ns_ = ns - first_ns_;
      } else {
        start(frames, ns);
      }
    }
    seen_ = true;
    last_ = microjoules;
  }
  [[nodiscard]] bool is_long_enough() const {
    constexpr double least_ns = 100e6;
    return frames_ > 0 && ns_ >= least_ns;
  }
  [[nodiscard]] std::uint64_t energy_per_frame() const {
    return static_cast<std::uint64_t>(
        std::llround(static_cast<double>(sum_) / static_cast<double>(frames_)));
  }

 private:
  // Begins the span at the first update of the meter. Also restarts it after the meter was reset,
  // because the energy since the previous update is then unknown.
  void start(int frames, double ns) {
    first_frame_ = frames;
    first_ns_ = ns;
    updated_ = true;
    sum_ = 0;
    frames_ = 0;
    ns_ = 0;
  }

  bool seen_ = false, updated_ = false;
  std::uint64_t last_ = 0, sum_ = 0;
  int first_frame_ = 0, frames_ = 0;
  double first_ns_ = 0, ns_ = 0;
};

EnergyMeters::EnergyMeters(const fs::path& system, const fs::path& nvml) {
  find_processors(system);
  find_intel_cards(system);
  find_nvidia_cards(nvml);
}

std::vector<std::string> EnergyMeters::names() const {
  std::vector<std::string> names;
  for (const Meter& meter : meters_) names.push_back(meter.name);
  return names;
}

// Adds the meters of the CPU packages and of their memory. The memory has its own meter because the
// package's meter does not include it. The zone `psys` is not used, because it measures the whole
// machine including the packages, which would then be counted twice.
void EnergyMeters::find_processors(const fs::path& system) {
  for (const fs::path& zone : entries(system / "class/powercap", "intel-rapl:")) {
    const std::string name = value_of<std::string>(zone / "name").value_or("");
    if (!name.starts_with("package")) continue;
    add_zone(zone, name);
    for (const fs::path& part : entries(zone, zone.filename().string() + ":")) {
      if (value_of<std::string>(part / "name") == "dram") add_zone(part, name + "/dram");
    }
  }
}

void EnergyMeters::add_zone(const fs::path& zone, const std::string& name) {
  const fs::path file = zone / "energy_uj";
  if (!counts(file)) return;
  const auto range = value_of<std::uint64_t>(zone / "max_energy_range_uj");
  meters_.push_back({name, [file] { return value_of<std::uint64_t>(file); }, range.value_or(0)});
}

void EnergyMeters::find_intel_cards(const fs::path& system) {
  std::map<std::string, int> cards;
  for (const fs::path& card : entries(system / "class/hwmon", "hwmon")) {
    const std::string driver = value_of<std::string>(card / "name").value_or("");
    const fs::path file = card / "energy1_input";
    if ((driver != "i915" && driver != "xe") || !counts(file)) continue;
    meters_.push_back({fmt::format("{}-{}", driver, cards[driver]++),
                       [file] { return value_of<std::uint64_t>(file); }, 0});
  }
}

// Loads the functions of NVML by name. Their types are those in nvml.h, version 12. They return 0
// on success.
void EnergyMeters::find_nvidia_cards(const fs::path& nvml) {
  using Card = struct nvmlDevice_st*;
  void* library = ::dlopen(nvml.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  if (library == nullptr) return;
  const auto find = [library]<typename F>(const char* name, F*& function) {
    function = reinterpret_cast<F*>(::dlsym(library, name));
    return function != nullptr;
  };
  int (*init)() = nullptr;
  int (*count)(unsigned*) = nullptr;
  int (*card_at)(unsigned, Card*) = nullptr;
  int (*energy)(Card, unsigned long long*) = nullptr;
  unsigned cards = 0;
  const bool works = find("nvmlInit_v2", init) && find("nvmlDeviceGetCount_v2", count) &&
                     find("nvmlDeviceGetHandleByIndex_v2", card_at) &&
                     find("nvmlDeviceGetTotalEnergyConsumption", energy) && init() == 0 &&
                     count(&cards) == 0;
  for (unsigned i = 0; works && i < cards; ++i) {
    Card card = nullptr;
    unsigned long long millijoules = 0;
    if (card_at(i, &card) != 0 || energy(card, &millijoules) != 0 || millijoules == 0) continue;
    meters_.push_back({fmt::format("nvidia-{}", i),
                       [energy, card]() -> std::optional<std::uint64_t> {
                         unsigned long long now = 0;
                         if (energy(card, &now) != 0) return std::nullopt;
                         return now * 1000;
                       },
                       0});
  }
}

record::Counts EnergyMeters::energy_per_frame(const std::function<void()>& draw) const {
  constexpr double most_ns = 1e9;
  constexpr int least_frames = 3;
  std::vector<Span> spans(meters_.size());
  const Stopwatch whole;
  const auto update = [&](int frames) {
    for (std::size_t i = 0; i < spans.size(); ++i) {
      const auto value = meters_[i].microjoules();
      if (value) spans[i].update(*value, frames, whole.ns(), meters_[i].range);
    }
    return std::ranges::all_of(spans, &Span::is_long_enough);
  };
  int frames = 0;
  while (!update(frames) && (frames < least_frames || whole.ns() < most_ns)) {
    draw();
    ++frames;
  }
  record::Counts result;
  for (std::size_t i = 0; i < spans.size(); ++i) {
    if (spans[i].is_long_enough()) result[meters_[i].name] = spans[i].energy_per_frame();
  }
  return result;
}

}  // namespace triptych::measure
