#include "app/listing.hpp"

#include <fmt/format.h>
#include <fnmatch.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <optional>

#include "app/paths.hpp"
#include "core/json.hpp"
#include "measure/environment.hpp"
#include "measure/process.hpp"
#include "measure/wire.hpp"

namespace triptych::app {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds limit{30'000};

core::Json as_json(const measure::Listing& listing) {
  core::Json broken = core::Json::array();
  for (const measure::Broken& each : listing.broken) {
    broken.push_back({{"what", each.what}, {"reason", each.reason}});
  }
  return {{"devices", listing.devices}, {"broken", broken}};
}

measure::Listing from_json(const core::Json& json) {
  measure::Listing listing{.devices = json.at("devices"), .broken = {}};
  for (const core::Json& each : json.at("broken")) {
    listing.broken.push_back({.what = each.at("what"), .reason = each.at("reason")});
  }
  return listing;
}

// Reads the one message of a listing process, or tells by an empty result that it ended without
// one.
std::optional<measure::Message> read_answer(measure::Process& process) {
  measure::MessageBuffer buffer;
  std::array<std::byte, 65536> bytes{};
  const auto deadline = steady_clock::now() + limit;
  while (steady_clock::now() < deadline) {
    std::array<pollfd, 2> waits{pollfd{process.answer_fd(), POLLIN, 0},
                                pollfd{process.log_fd(), POLLIN, 0}};
    ::poll(waits.data(), waits.size(), 100);
    // What the driver prints is read and let go, so that a full pipe cannot stop it.
    while (::read(process.log_fd(), bytes.data(), bytes.size()) > 0) {
    }
    const ssize_t got = ::read(process.answer_fd(), bytes.data(), bytes.size());
    if (got > 0) buffer.append(std::span(bytes).first(static_cast<std::size_t>(got)));
    if (std::optional<measure::Message> message = buffer.next()) return message;
    if (got == 0) return std::nullopt;
  }
  return std::nullopt;
}

measure::Listing list_one(const std::string& api) {
  const std::string id = api + ":listing";
  const measure::CacheFolder cache(id);
  measure::Process process({own_program(), "list-api", api},
                           measure::worker_environment(id, cache));
  if (const std::optional<measure::Message> answer = read_answer(process)) {
    return from_json(answer->json);
  }
  process.close_requests();
  const std::optional<measure::Exit> exit = process.wait(milliseconds(100));
  return {.devices = {},
          .broken = {{.what = api,
                      .reason = exit ? "listing its devices ended: " + measure::describe(*exit)
                                     : fmt::format("listing its devices took more than {} s",
                                                   limit.count() / 1000)}}};
}

}  // namespace

measure::Listing list_devices(const Registry& registry) {
  measure::Listing all;
  for (const auto& backend : registry.backends) {
    measure::Listing one = list_one(std::string(backend->api()));
    std::ranges::move(one.devices, std::back_inserter(all.devices));
    std::ranges::move(one.broken, std::back_inserter(all.broken));
  }
  return all;
}

std::vector<std::string> choose_devices(const measure::Listing& listing,
                                        const std::vector<std::string>& globs) {
  std::vector<std::string> chosen;
  std::string known;
  for (const record::Device& device : listing.devices) {
    known += " " + device.id;
    const auto matches = [&](const std::string& glob) {
      return ::fnmatch(glob.c_str(), device.id.c_str(), 0) == 0;
    };
    if (globs.empty() || std::ranges::any_of(globs, matches)) chosen.push_back(device.id);
  }
  if (!chosen.empty()) return chosen;
  if (known.empty()) {
    throw core::NotSupported(
        "no device at all: no OpenCL, Vulkan or OpenGL driver answers; ci/setup installs software "
        "drivers, `triptych devices` says what each loader found");
  }
  throw core::NotSupported(fmt::format("no device matches {}; there are:{}", globs.front(), known));
}

core::ExitCode answer_listing(const Registry& registry, const std::string& api, int answer_fd) {
  measure::send(answer_fd, {.json = as_json(registry.backend(api).list()), .binary = {}});
  return core::ExitCode::pass;
}

}  // namespace triptych::app
