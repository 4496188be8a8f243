#pragma once
// What supervisor and worker say to each other over two pipes. Both are the same program on the
// same machine, so numbers travel in native byte order. A message is
//   8 bytes magic, 4 bytes size of the JSON text, 4 bytes size of what follows it, JSON, binary.
//
//   supervisor → worker   start   suite, kinds of work the plan needs, clocks already known
//   worker → supervisor   hello   device, clocks      | refused   reason
//   supervisor → worker   job     one configuration with the protocol and its injected faults
//   worker → supervisor   loading how far a large data set is loaded; any number before the answer
//   worker → supervisor   answer  record, time taken; the image as EXR follows as binary
// and, for measuring two workers by interleaved A/B:
//   supervisor → worker   hold    one configuration to be prepared and kept
//   supervisor → worker   frames  how many timed frames of what is kept to draw now
//   supervisor → worker   release what is kept is freed
//   worker → supervisor   turn    to each of the three: times of the frames drawn, or why there are
//                                 none; loading may come before it

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

// Writes the whole message; throws IoError when the other side is gone.
void send(int fd, const Message& message);
// Blocks for one message; nullopt when the other side has closed. Throws IoError when it closes
// within a message, InputError for bytes that are no message.
[[nodiscard]] std::optional<Message> receive(int fd);

// Puts messages together from the pieces a pipe gives.
class MessageBuffer {
 public:
  void append(std::span<const std::byte> bytes);
  // The next whole message, if it is there. Throws InputError for bytes that are no message.
  [[nodiscard]] std::optional<Message> next();
  [[nodiscard]] bool empty() const noexcept { return bytes_.empty(); }

 private:
  std::vector<std::byte> bytes_;
};

struct Start {
  std::string suite;
  std::vector<std::string> kinds;  // technique::name_of
  std::vector<record::ClockTrust>
      clocks;              // a worker that replaces another need not calibrate again
  bool statistics = true;  // else the driver crashed when they were read: nobody asks for them
};

struct Hello {
  record::Device device;
  std::vector<record::ClockTrust> clocks;
};

struct Refused {
  record::Reason reason;
  // For something that the device lacks.
  [[nodiscard]] bool unsupported() const { return reason.cause == record::Cause::not_supported; }
  // Else the worker has greeted.
  [[nodiscard]] bool is_one() const { return reason.cause != record::Cause::none; }
};

struct Job {
  std::string name;  // of the benchmark
  Configuration configuration;
  Protocol protocol;
  std::vector<std::string> faults;
};

struct Answer {
  record::Record record;  // what is known below the plan; `factors` with every "auto" resolved
  double worker_ns = 0;   // from job read to answer ready
  std::map<std::string, std::string> listings = {};  // disassembly by its content hash
  std::vector<std::byte> exr;
};

// Replaces what is held already.
struct Hold {
  Configuration configuration;
  std::vector<std::string> faults;
};

struct Frames {
  int count = 1;
};

struct Release {};

// What came of one of them. Of a configuration that cannot be held, or failed in a frame, nothing
// is held any longer.
struct Batch {
  record::Outcome outcome = record::Outcome::measured;
  record::Reason reason;          // for every outcome but measured
  std::vector<double> wall_ns;    // one per frame drawn
  std::vector<double> device_ns;  // empty where the device did not tell it of each
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

// Empty when the message is of another type. Throw InputError when it lacks something.
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
