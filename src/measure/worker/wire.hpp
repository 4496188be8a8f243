#pragma once
// The messages between supervisor and worker, sent over two pipes. Both are the same program on the
// same machine, so numbers are sent in native byte order. A message is
//   8 bytes magic, 4 bytes size of the JSON text, 4 bytes size of the binary part, JSON, binary
//   part
//
//   supervisor → worker   start   suite, kinds of work the plan needs, clocks already known
//   worker → supervisor   hello   device, clocks      | refused   reason
//   supervisor → worker   job     one configuration with the protocol and its injected faults
//   worker → supervisor   loading progress of loading a large data set; zero or more of these come
//                                 before the answer
//   worker → supervisor   answer  record, time taken; the image is the binary part, as EXR
// and, for measuring two workers by interleaved A/B:
//   supervisor → worker   hold    one configuration that the worker prepares and keeps
//   supervisor → worker   frames  number of timed frames of the kept configuration to draw now
//   supervisor → worker   release the worker frees the kept configuration
//   worker → supervisor   turn    the answer to each of these three: times of the drawn frames, or
//                                 the reason why there are none; loading may come before it

#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "measure/contract/suite.hpp"
#include "measure/protocol/protocol.hpp"
#include "record/record.hpp"

namespace triptych::measure {

struct Message {
  nlohmann::json json;
  std::vector<std::byte> binary;
};

// Writes the whole message; throws IoError if the other side is gone.
void send(int fd, const Message& message);
// Waits for one message; nullopt if the other side has closed the pipe. Throws IoError if it closed
// the pipe within a message, InputError for bytes that are not a message.
[[nodiscard]] std::optional<Message> receive(int fd);

// Combines the pieces that a pipe returns into messages.
class MessageBuffer {
 public:
  void append(std::span<const std::byte> bytes);
  // The next complete message, if it has arrived. Throws InputError for bytes that are not a
  // message.
  [[nodiscard]] std::optional<Message> next();
  [[nodiscard]] bool empty() const noexcept { return bytes_.empty(); }

 private:
  std::vector<std::byte> bytes_;
};

struct Start {
  std::string suite;
  std::vector<std::string> kinds;  // see technique::name_of
  // The clocks that are known already, so that a replaced worker need not calibrate them again.
  std::vector<record::ClockTrust> clocks;
  // False: the driver crashed when statistics were read, so they are not requested.
  bool statistics = true;
};

struct Hello {
  record::Device device;
  std::vector<record::ClockTrust> clocks;
};

struct Refused {
  record::Reason reason;
  // Whether the device lacks something.
  [[nodiscard]] bool unsupported() const { return reason.cause == record::Cause::not_supported; }
  // False if the worker sent its Hello instead.
  [[nodiscard]] bool is_one() const { return reason.cause != record::Cause::none; }
};

struct Job {
  std::string name;  // the name of the benchmark
  Configuration configuration;
  Protocol protocol;
  std::vector<std::string> faults;
};

struct Answer {
  // Everything that does not depend on the plan; in `factors` every "auto" is resolved.
  record::Record record;
  double worker_ns = 0;  // from reading the job until the answer is ready
  std::map<std::string, std::string> listings = {};  // disassembly by the hash of its content
  std::vector<std::byte> exr;
};

// Requests that the worker prepares and keeps a configuration, in place of the one that it has kept
// so far.
struct Hold {
  Configuration configuration;
  std::vector<std::string> faults;
};

struct Frames {
  int count = 1;
};

struct Release {};

// The answer to Hold, Frames and Release. After a failure no configuration is kept any longer.
struct Batch {
  record::Outcome outcome = record::Outcome::measured;
  record::Reason reason;          // for every outcome except measured
  std::vector<double> wall_ns;    // one for each frame
  std::vector<double> device_ns;  // empty if the device did not report it for every frame
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

// nullopt if the message has another type. Throws InputError if a member is missing.
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
