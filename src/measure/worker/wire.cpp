#include "measure/worker/wire.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <limits>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "core/json_text.hpp"

namespace triptych::measure {
namespace {

using Json = nlohmann::json;

constexpr std::array<char, 8> magic{'t', 'r', 'i', 'p', 't', 'y', 'c', '1'};

struct Header {
  std::array<char, 8> mark = magic;
  std::uint32_t json_bytes = 0;
  std::uint32_t binary_bytes = 0;
};
static_assert(sizeof(Header) == 16);

Header checked(std::span<const std::byte> bytes) {
  Header header;
  std::memcpy(&header, bytes.data(), sizeof header);
  if (header.mark != magic) {
    throw core::InputError("a worker's pipe contains data that is not a message");
  }
  return header;
}

Json parse(std::span<const std::byte> text) {
  try {
    const auto* first = reinterpret_cast<const char*>(text.data());
    return Json::parse(first, first + text.size());
  } catch (const Json::exception& error) {
    throw core::InputError(fmt::format("a worker's message is not valid JSON: {}", error.what()));
  }
}

std::uint32_t size_of(std::size_t bytes) {
  if (bytes > std::numeric_limits<std::uint32_t>::max()) {
    throw core::IoError(fmt::format("a message part of {} bytes is too large to send", bytes));
  }
  return static_cast<std::uint32_t>(bytes);
}

void write_all(int fd, const void* data, std::size_t size) {
  const auto* next = static_cast<const std::byte*>(data);
  while (size > 0) {
    const ssize_t written = ::write(fd, next, size);
    if (written < 0) {
      const int error = errno;
      if (error == EINTR) continue;
      const std::string reason =
          fmt::format("cannot write to a pipe: {}", std::generic_category().message(error));
      if (error == EPIPE) throw PipeClosed(reason);
      throw core::IoError(reason);
    }
    next += written;
    size -= static_cast<std::size_t>(written);
  }
}

// Reads `size` bytes, or fewer if the pipe is closed first. Returns the number of bytes that were
// read.
std::size_t read_all(int fd, void* data, std::size_t size) {
  auto* next = static_cast<std::byte*>(data);
  std::size_t done = 0;
  while (done < size) {
    const ssize_t got = ::read(fd, next + done, size - done);
    if (got < 0) {
      if (errno == EINTR) continue;
      throw core::IoError(
          fmt::format("cannot read from a pipe: {}", std::generic_category().message(errno)));
    }
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  return done;
}

bool is(const Message& message, std::string_view type) {
  return message.json.is_object() && message.json.value("type", "") == type;
}

// Converts JSON errors to InputError, because a message without an expected member is invalid input
// from the other process.
template <typename Read>
auto reading(std::string_view type, Read read) {
  try {
    return read();
  } catch (const Json::exception& error) {
    throw core::InputError(fmt::format("the message '{}' is invalid: {}", type, error.what()));
  }
}

Json to_json(const Protocol& protocol) {
  return {{"warm_up_frames", protocol.warm_up_frames},
          {"timed_frames", protocol.timed_frames},
          {"least_loop_ns", protocol.least_loop_ns},
          {"most_loop_frames", protocol.most_loop_frames},
          {"statistics", protocol.statistics},
          {"counters", protocol.counters},
          {"timed", protocol.timed},
          {"counted", protocol.counted},
          {"keep_image", protocol.keep_image},
          {"ahead", protocol.ahead},
          {"compiled", protocol.compiled},
          {"measure_every", protocol.measure_every}};
}

Protocol protocol_from(const Json& json) {
  return {.warm_up_frames = json.at("warm_up_frames"),
          .timed_frames = json.at("timed_frames"),
          .least_loop_ns = json.at("least_loop_ns"),
          .most_loop_frames = json.at("most_loop_frames"),
          .statistics = json.at("statistics"),
          .counters = json.at("counters"),
          .timed = json.at("timed"),
          .counted = json.at("counted"),
          .keep_image = json.at("keep_image"),
          .ahead = json.at("ahead"),
          .compiled = json.at("compiled"),
          .measure_every = json.at("measure_every")};
}

}  // namespace

void send(int fd, const Message& message) {
  const std::string text = core::json_text(message.json);
  Header header;
  header.json_bytes = size_of(text.size());
  header.binary_bytes = size_of(message.binary.size());
  write_all(fd, &header, sizeof header);
  write_all(fd, text.data(), text.size());
  write_all(fd, message.binary.data(), message.binary.size());
}

std::optional<Message> receive(int fd) {
  std::array<std::byte, sizeof(Header)> head{};
  const std::size_t got = read_all(fd, head.data(), head.size());
  if (got == 0) return std::nullopt;
  if (got < head.size()) throw core::IoError("a pipe was closed in the middle of a message");
  const Header header = checked(head);
  std::vector<std::byte> text(header.json_bytes);
  Message message;
  message.binary.resize(header.binary_bytes);
  if (read_all(fd, text.data(), text.size()) < text.size() ||
      read_all(fd, message.binary.data(), message.binary.size()) < message.binary.size()) {
    throw core::IoError("a pipe was closed in the middle of a message");
  }
  message.json = parse(text);
  return message;
}

void MessageBuffer::append(std::span<const std::byte> bytes) {
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
}

std::optional<Message> MessageBuffer::next() {
  if (bytes_.size() < sizeof(Header)) return std::nullopt;
  const Header header = checked(bytes_);
  const std::size_t json_end = sizeof(Header) + header.json_bytes;
  const std::size_t end = json_end + header.binary_bytes;
  if (bytes_.size() < end) return std::nullopt;
  const std::span<const std::byte> all(bytes_);
  Message message;
  message.json = parse(all.subspan(sizeof(Header), header.json_bytes));
  const auto binary = all.subspan(json_end, header.binary_bytes);
  message.binary.assign(binary.begin(), binary.end());
  bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(end));
  return message;
}

Message to_message(const Start& start) {
  return {{{"type", "start"},
           {"suite", start.suite},
           {"kinds", start.kinds},
           {"clocks", start.clocks},
           {"statistics", start.statistics}},
          {}};
}

Message to_message(const Hello& hello) {
  return {{{"type", "hello"}, {"device", hello.device}, {"clocks", hello.clocks}}, {}};
}

Message to_message(const Refused& refused) {
  return {{{"type", "refused"}, {"reason", refused.reason}}, {}};
}

Message to_message(const Job& job) {
  return {{{"type", "job"},
           {"name", job.name},
           {"configuration", job.configuration},
           {"protocol", to_json(job.protocol)},
           {"faults", job.faults},
           {"report_resident", job.report_resident}},
          {}};
}

Message to_message(const Loading& loading) {
  return {{{"type", "loading"},
           {"what", loading.what},
           {"share", loading.share},
           {"note", loading.note}},
          {}};
}

Message to_message(Answer answer) {
  return {{{"type", "answer"},
           {"record", answer.record},
           {"listings", answer.listings},
           {"worker_ns", answer.worker_ns},
           {"resident_bytes", answer.resident_bytes}},
          std::move(answer.exr)};
}

Message to_message(const Hold& hold) {
  return {{{"type", "hold"}, {"configuration", hold.configuration}, {"faults", hold.faults}}, {}};
}

Message to_message(const Frames& frames) {
  return {{{"type", "frames"}, {"count", frames.count}}, {}};
}

Message to_message(const Release&) {
  return {{{"type", "release"}}, {}};
}

Message to_message(const Batch& batch) {
  return {{{"type", "turn"},
           {"outcome", record::name_of(batch.outcome)},
           {"reason", batch.reason},
           {"wall_ns", batch.wall_ns},
           {"device_ns", batch.device_ns}},
          {}};
}

std::optional<Start> as_start(const Message& message) {
  if (!is(message, "start")) return std::nullopt;
  return reading("start", [&] {
    return Start{.suite = message.json.at("suite"),
                 .kinds = message.json.at("kinds"),
                 .clocks = message.json.at("clocks").get<std::vector<record::ClockTrust>>(),
                 .statistics = message.json.at("statistics").get<bool>()};
  });
}

std::optional<Hello> as_hello(const Message& message) {
  if (!is(message, "hello")) return std::nullopt;
  return reading("hello", [&] {
    return Hello{.device = message.json.at("device").get<record::Device>(),
                 .clocks = message.json.at("clocks").get<std::vector<record::ClockTrust>>()};
  });
}

std::optional<Refused> as_refused(const Message& message) {
  if (!is(message, "refused")) return std::nullopt;
  return reading("refused",
                 [&] { return Refused{message.json.at("reason").get<record::Reason>()}; });
}

std::optional<Job> as_job(const Message& message) {
  if (!is(message, "job")) return std::nullopt;
  return reading("job", [&] {
    return Job{.name = message.json.at("name"),
               .configuration = message.json.at("configuration").get<Configuration>(),
               .protocol = protocol_from(message.json.at("protocol")),
               .faults = message.json.at("faults"),
               .report_resident = message.json.at("report_resident")};
  });
}

std::optional<Loading> as_loading(const Message& message) {
  if (!is(message, "loading")) return std::nullopt;
  return reading("loading", [&] {
    return Loading{.what = message.json.at("what"),
                   .share = message.json.at("share"),
                   .note = message.json.at("note")};
  });
}

std::optional<Answer> as_answer(Message message) {
  if (!is(message, "answer")) return std::nullopt;
  return reading("answer", [&] {
    return Answer{.record = message.json.at("record").get<record::Record>(),
                  .worker_ns = message.json.at("worker_ns"),
                  .listings = message.json.at("listings"),
                  .exr = std::move(message.binary),
                  .resident_bytes = message.json.at("resident_bytes")};
  });
}

std::optional<Hold> as_hold(const Message& message) {
  if (!is(message, "hold")) return std::nullopt;
  return reading("hold", [&] {
    return Hold{.configuration = message.json.at("configuration").get<Configuration>(),
                .faults = message.json.at("faults")};
  });
}

std::optional<Frames> as_frames(const Message& message) {
  if (!is(message, "frames")) return std::nullopt;
  return reading("frames", [&] { return Frames{.count = message.json.at("count")}; });
}

std::optional<Release> as_release(const Message& message) {
  return is(message, "release") ? std::optional(Release{}) : std::nullopt;
}

std::optional<Batch> as_batch(const Message& message) {
  if (!is(message, "turn")) return std::nullopt;
  return reading("turn", [&] {
    return Batch{.outcome = record::outcome(message.json.at("outcome").get<std::string>()),
                 .reason = message.json.at("reason").get<record::Reason>(),
                 .wall_ns = message.json.at("wall_ns"),
                 .device_ns = message.json.at("device_ns")};
  });
}

}  // namespace triptych::measure
