#pragma once
// The messages that the supervisor and a worker exchange over two pipes. Both processes run the
// same program on the same machine, so numbers are sent in native byte order. A message consists of
//   8 bytes magic number, 4 bytes size of the JSON text, 4 bytes size of the binary part, the JSON
//   text, the binary part
//
//   supervisor → worker   start    the suite, the kinds of work in the plan, the clocks whose
//                                  calibration is already known
//   worker → supervisor   hello    the device and its clocks, or
//                         refused  the reason why the device cannot be used
//   supervisor → worker   job      one configuration with the protocol and its injected faults
//   worker → supervisor   loading  the progress of loading a large data set; any number of these
//                                  messages may precede the answer
//   worker → supervisor   answer   the record and the time spent; the binary part is the EXR image
// The following messages are used for interleaved A/B measurements with two workers:
//   supervisor → worker   hold     one configuration that the worker prepares and keeps
//   supervisor → worker   frames   the number of timed frames to draw with the kept configuration
//   supervisor → worker   release  makes the worker free the kept configuration
//   worker → supervisor   turn     the answer to each of these three requests: the times of the
//                                  drawn frames, or the reason why there are none; `loading`
//                                  messages may precede it

#include <cstddef>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "measure/contract/suite.hpp"
#include "measure/protocol/protocol.hpp"
#include "record/record.hpp"

namespace triptych::measure {

struct Message {
  nlohmann::json json;
  std::vector<std::byte> binary;
};

// The other process has closed the pipe.
struct PipeClosed : core::IoError {
  using IoError::IoError;
};

// Writes the whole message. Throws PipeClosed, or IoError if writing fails for another reason.
void send(int fd, const Message& message);
// Waits for one message. Returns nullopt if the other process has closed the pipe. Throws IoError
// if the pipe was closed within a message, and InputError for bytes that are not a message.
[[nodiscard]] std::optional<Message> receive(int fd);

// Assembles messages from the pieces that are read from a pipe.
class MessageBuffer {
 public:
  void append(std::span<const std::byte> bytes);
  // Returns the next message, or nullopt if it has not arrived completely. Throws InputError for
  // bytes that are not a message.
  [[nodiscard]] std::optional<Message> next();
  [[nodiscard]] bool empty() const noexcept { return bytes_.empty(); }

 private:
  std::vector<std::byte> bytes_;
};

struct Start {
  std::string suite;
  std::vector<std::string> kinds;  // see technique::name_of
  // The clocks whose calibration is already known, so that a replacement worker need not calibrate
  // them again.
  std::vector<record::ClockTrust> clocks;
  // Whether pipeline statistics may be requested. False if the driver crashed when they were read.
  bool statistics = true;
};

struct Hello {
  record::Device device;
  std::vector<record::ClockTrust> clocks;
};

struct Refused {
  record::Reason reason;
  // Returns whether the device does not support the request.
  [[nodiscard]] bool unsupported() const { return reason.cause == record::Cause::not_supported; }
  // Returns whether the worker refused. If it sent its Hello instead, the reason has no cause.
  [[nodiscard]] bool is_refusal() const { return reason.cause != record::Cause::none; }
};

struct Job {
  std::string name;  // the name of the benchmark
  Configuration configuration;
  Protocol protocol;
  std::vector<std::string> faults;
  // Makes the worker return its unused heap memory to the operating system after the job, and set
  // Answer::resident_bytes.
  bool report_resident = false;
};

struct Answer {
  // All fields of the record that do not depend on the plan. In `factors`, every "auto" is
  // resolved.
  record::Record record;
  double worker_ns = 0;  // time between reading the job and completing the answer
  std::map<std::string, std::string> listings = {};  // disassemblies by content hash
  std::vector<std::byte> exr;
  std::uint64_t resident_bytes = 0;  // memory in use after the job, if it was requested
};

// Requests that the worker prepare a configuration, and keep it in place of the previous
// configuration.
struct Hold {
  Configuration configuration;
  std::vector<std::string> faults;
};

struct Frames {
  int count = 1;
};

struct Release {};

// The answer to Hold, Frames and Release. After a failure, the worker no longer keeps a
// configuration.
struct Batch {
  record::Outcome outcome = record::Outcome::measured;
  record::Reason reason;          // set for every outcome except `measured`
  std::vector<double> wall_ns;    // one time for each frame
  std::vector<double> device_ns;  // empty unless the device reported a time for every frame
};

[[nodiscard]] Message to_message(const Start& start);
[[nodiscard]] Message to_message(const Hello& hello);
[[nodiscard]] Message to_message(const Refused& refused);
[[nodiscard]] Message to_message(const Job& job);
[[nodiscard]] Message to_message(const Loading& loading);
[[nodiscard]] Message to_message(Answer answer);
[[nodiscard]] Message to_message(const Hold& hold);
[[nodiscard]] Message to_message(const Frames& frames);
[[nodiscard]] Message to_message(const Release& release);
[[nodiscard]] Message to_message(const Batch& batch);

// Each of these functions returns nullopt if the message has another type, and throws InputError if
// a member is missing.
[[nodiscard]] std::optional<Start> as_start(const Message& message);
[[nodiscard]] std::optional<Hello> as_hello(const Message& message);
[[nodiscard]] std::optional<Refused> as_refused(const Message& message);
[[nodiscard]] std::optional<Job> as_job(const Message& message);
[[nodiscard]] std::optional<Loading> as_loading(const Message& message);
[[nodiscard]] std::optional<Answer> as_answer(Message message);
[[nodiscard]] std::optional<Hold> as_hold(const Message& message);
[[nodiscard]] std::optional<Frames> as_frames(const Message& message);
[[nodiscard]] std::optional<Release> as_release(const Message& message);
[[nodiscard]] std::optional<Batch> as_batch(const Message& message);

}  // namespace triptych::measure
