#include "measure/worker/listing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iterator>

#include "core/error.hpp"
#include "core/glob.hpp"
#include "core/json.hpp"
#include "measure/system/compile_only.hpp"
#include "measure/system/environment.hpp"
#include "measure/worker/own_program.hpp"
#include "measure/worker/wire.hpp"
#include "measure/worker/worker_link.hpp"

namespace triptych::measure {
namespace {

constexpr std::chrono::seconds listing_limit{30};
// The limit is long, because loading the driver of a compile-only device takes half a minute on a
// busy machine.
constexpr std::chrono::seconds compiler_limit{120};
// The limit is long, because opening a device may compile code, and calibrating its clocks draws
// frames.
constexpr std::chrono::seconds greeting_limit{120};

core::Json as_json(const Listing& listing) {
  core::Json broken = core::Json::array();
  for (const Broken& each : listing.broken) {
    broken.push_back(record::Unusable{each.what, each.reason, each.ended});
  }
  return {{"devices", listing.devices}, {"broken", broken}};
}

Listing from_json(const core::Json& json) {
  Listing listing{.devices = json.at("devices"), .broken = {}};
  for (const core::Json& each : json.at("broken")) {
    const auto unusable = each.get<record::Unusable>();
    listing.broken.push_back({unusable.what, unusable.reason, unusable.ended});
  }
  return listing;
}

// Starts this program with `command`, sends the request and returns the only answer.
WorkerLink::Reply request_once(const std::vector<std::string>& command,
                               const std::string& device_id, const Message& request,
                               std::chrono::seconds limit) {
  InterruptGuard interrupts;
  const CacheFolder cache(device_id);
  const std::vector<std::string> variables = compile_only_environment(device_id);
  WorkerLink link(command, worker_environment(device_id, cache, variables), interrupts);
  WorkerLink::Reply reply = link.send_request(request, limit);
  if (std::holds_alternative<Message>(reply)) link.finish();
  return reply;
}

record::Reason reason_of(const WorkerLink::Reply& reply) {
  if (const auto* died = std::get_if<WorkerLink::Died>(&reply)) return died->reason;
  if (const auto* timed_out = std::get_if<WorkerLink::TimedOut>(&reply)) return timed_out->reason;
  return {.cause = record::Cause::bad_answer};
}

Listing list_one(const std::string& api) {
  const WorkerLink::Reply reply =
      request_once({own_program(), "list-api", api}, api + ":listing",
                   {.json = core::Json::object(), .binary = {}}, listing_limit);
  record::Reason reason = reason_of(reply);
  if (const auto* answer = std::get_if<Message>(&reply)) {
    try {
      return from_json(answer->json);
    } catch (const core::Json::exception& error) {
      reason.detail = error.what();
    }
  }
  return {.devices = {}, .broken = {{.what = api, .reason = {}, .ended = std::move(reason)}}};
}

// Asks the driver whether it can compile for the GPU family of this device, and adds the result to
// `listing`.
void list_compiler(const std::string& id, Listing& listing) {
  constexpr const char* newer_driver_hint =
      "but a newer driver may; for example, Mesa 25.0 in Debian 13 supports AMD GPU families up "
      "to gfx1201";
  const std::string api = id.substr(0, id.find(':'));
  const auto add_broken = [&](std::string reason) {
    listing.broken.push_back({.what = id, .reason = std::move(reason)});
  };
  try {
    const WorkerLink::Reply reply =
        request_once({own_program(), "list-api", api}, id,
                     {.json = core::Json::object(), .binary = {}}, compiler_limit);
    const auto* answer = std::get_if<Message>(&reply);
    if (std::holds_alternative<WorkerLink::TimedOut>(reply)) {
      return add_broken(
          fmt::format("the installed driver did not respond within {} s", compiler_limit.count()));
    }
    if (answer == nullptr) {
      // The driver exited without an answer. One possible cause is that RADV aborts if it does not
      // support the requested GPU family.
      listing.broken.push_back({.what = id,
                                .reason = std::string("the installed driver exited without "
                                                      "responding; it may not support this GPU "
                                                      "family, ") +
                                          newer_driver_hint,
                                .ended = reason_of(reply)});
      return;
    }
    for (record::Device& device : from_json(answer->json).devices) {
      if (device.id == id) return listing.devices.push_back(std::move(device));
    }
    add_broken(std::string("the installed driver does not support this GPU family, ") +
               newer_driver_hint);
  } catch (const core::NotSupported& error) {
    add_broken(error.what());
  }
}

// Returns the ids of the usual compile-only devices that can be used and have the same driver as
// `id`. Returns no ids if `id` is not a compile-only device.
std::vector<std::string> usable_with_same_driver(const std::string& id) {
  const auto device = compile_only(id);
  if (!device) return {};
  const std::string driver = id.substr(0, id.size() - device->family.size());
  std::vector<std::string> ids = installed_compilers();
  std::erase_if(ids, [&](const std::string& each) { return !each.starts_with(driver); });
  std::vector<std::string> usable;
  if (ids.empty()) return usable;  // otherwise, an empty list would select all devices
  for (const record::Device& each : list_compilers(ids).devices) usable.push_back(each.id);
  return usable;
}

// Throws an error that states why no device in the listing matches `glob`.
[[noreturn]] void throw_no_match(const Listing& listing, std::string_view glob) {
  if (listing.devices.empty() && listing.broken.empty()) {
    throw core::NotSupported(fmt::format(
        "no device matches {}, because no installed driver provides a device; run ci/setup to "
        "install software drivers, or `triptych devices` to print what each loader found",
        glob));
  }
  throw core::NotSupported(
      fmt::format("no device matches {}; available devices:{}", glob,
                  available_devices(listing, usable_with_same_driver(std::string(glob)))));
}

}  // namespace

std::vector<std::string> apis_of(const std::vector<std::string>& globs,
                                 const std::vector<std::string>& apis) {
  std::vector<std::string> matching;
  for (const std::string& api : apis) {
    const std::string prefix = api + ":";
    const bool may_match = std::ranges::any_of(globs, [&](const std::string& glob) {
      const std::string literal = glob.substr(0, glob.find_first_of("*?"));
      return literal.starts_with(prefix) || prefix.starts_with(literal);
    });
    if (may_match) matching.push_back(api);
  }
  return matching.empty() ? apis : matching;
}

void append(Listing& all, Listing more) {
  std::ranges::move(more.devices, std::back_inserter(all.devices));
  std::ranges::move(more.broken, std::back_inserter(all.broken));
}

Listing list_devices(const std::vector<std::string>& apis) {
  Listing all;
  for (const std::string& api : apis) append(all, list_one(api));
  return all;
}

bool names_compile_only_device(const std::vector<std::string>& globs) {
  return std::ranges::any_of(
      globs, [](const std::string& glob) { return compile_only(glob).has_value(); });
}

std::vector<std::string> installed_compilers() {
  std::vector<std::string> ids = default_compile_only_devices();
  std::erase_if(ids, [](const std::string& id) {
    try {
      static_cast<void>(compile_only_environment(id));
      return false;
    } catch (const core::NotSupported&) {
      return true;
    }
  });
  return ids;
}

Listing list_compilers(const std::vector<std::string>& globs) {
  std::vector<std::string> ids = default_compile_only_devices();
  if (!globs.empty()) {
    std::erase_if(ids, [&](const std::string& id) { return !core::any_glob_matches(globs, id); });
  }
  for (const std::string& glob : globs) {
    if (compile_only(glob) && std::ranges::find(ids, glob) == ids.end()) ids.push_back(glob);
  }
  Listing listing;
  for (const std::string& id : ids) list_compiler(id, listing);
  return listing;
}

std::vector<std::string> unmatched(const Listing& listing, const std::vector<std::string>& globs) {
  std::vector<std::string> result;
  std::ranges::copy_if(globs, std::back_inserter(result), [&](const std::string& glob) {
    return !compile_only(glob) && std::ranges::none_of(listing.devices, [&](const auto& device) {
      return core::glob_matches(glob, device.id);
    });
  });
  return result;
}

std::string available_devices(const Listing& listing, const std::vector<std::string>& more) {
  std::string known;
  for (const record::Device& device : listing.devices) known += " " + device.id;
  for (const std::string& id : more) known += " " + id;
  if (known.empty()) known = " none";
  for (const Broken& each : listing.broken) {
    known += fmt::format("; {}{}{}", each.what, each.reason.empty() ? " cannot be used" : ": ",
                         each.reason);
    // The last output of a process that failed while it enumerated devices may state the cause. For
    // example, RADV prints a message and aborts if it does not support a GPU family.
    if (each.ended && !each.ended->last_output.empty()) {
      known += fmt::format(" (its last output: {})", each.ended->last_output);
    }
  }
  if (listing.devices.empty()) {
    known += "; if no driver is installed, run ci/setup to install software drivers";
  }
  return known;
}

std::vector<std::string> choose_devices(const Listing& listing,
                                        const std::vector<std::string>& globs) {
  const std::vector<std::string> patterns = globs.empty() ? std::vector<std::string>{"*"} : globs;
  const auto matches = [](const std::string& glob, const record::Device& device) {
    return core::glob_matches(glob, device.id);
  };
  for (const std::string& glob : patterns) {
    const auto matches_glob = [&](const record::Device& device) { return matches(glob, device); };
    if (std::ranges::none_of(listing.devices, matches_glob)) throw_no_match(listing, glob);
  }
  std::vector<std::string> chosen;
  for (const record::Device& device : listing.devices) {
    const auto is_chosen = [&](const std::string& glob) { return matches(glob, device); };
    if (std::ranges::any_of(patterns, is_chosen)) chosen.push_back(device.id);
  }
  return chosen;
}

std::string choose_device(const Listing& listing, std::string_view option,
                          const std::string& glob) {
  const std::vector<std::string> devices = choose_devices(listing, {glob});
  if (devices.size() == 1) return devices.front();
  throw core::InputError(
      fmt::format("{} {} matches {} devices; name only one of them", option, glob, devices.size()));
}

Greeting greet(const record::Device& device, const std::string& suite) {
  std::vector<std::string> command = worker_command();
  command.push_back(device.id);
  const Message start =
      to_message(Start{.suite = suite, .kinds = {"compute", "draw"}, .clocks = {}});
  const WorkerLink::Reply reply = request_once(command, device.id, start, greeting_limit);
  if (const auto* answer = std::get_if<Message>(&reply)) {
    if (const auto hello = as_hello(*answer)) return {hello->device, hello->clocks, {}};
    if (const auto refused = as_refused(*answer)) return {device, {}, refused->reason};
  }
  return {device, {}, reason_of(reply)};
}

void answer_listing(const Backend& backend) {
  // Waits for the request first. Otherwise, this process could answer and exit before the other
  // process has written its request to the pipe, and writing the request would fail.
  static_cast<void>(receive(Process::child_request_fd));
  send(Process::child_answer_fd, {.json = as_json(backend.list()), .binary = {}});
}

}  // namespace triptych::measure
