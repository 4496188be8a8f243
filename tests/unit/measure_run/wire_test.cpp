#include "measure/worker/wire.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <array>
#include <cstring>

#include "core/error.hpp"
#include "measure/system/process.hpp"

namespace triptych::measure {
namespace {

struct TestPipe {
  TestPipe() {
    std::array<int, 2> ends{};
    if (::pipe(ends.data()) != 0) throw core::IoError("pipe");
    read = FileDescriptor(ends[0]);
    write = FileDescriptor(ends[1]);
  }
  FileDescriptor read;
  FileDescriptor write;
};

Answer sample_answer() {
  Answer answer;
  answer.record.outcome = record::Outcome::measured;
  answer.record.wall_ns = {1.0 / 3, 2e9};
  answer.record.factors = {{"data", "cube"}};
  answer.record.counters = {{"samples", 0xFFFFFFFFFFFFULL}};
  answer.record.benchmark_json = R"([{"name":"x"}])";
  answer.worker_ns = 12.5;
  answer.exr.assign(1000, std::byte{0x76});
  return answer;
}

TEST(Wire, AnswersRoundTrip) {
  TestPipe pipe;
  send(pipe.write.get(), to_message(sample_answer()));
  auto message = receive(pipe.read.get());
  ASSERT_TRUE(message);
  EXPECT_FALSE(as_hello(*message));
  const auto answer = as_answer(std::move(*message));
  ASSERT_TRUE(answer);
  const Answer expected = sample_answer();
  EXPECT_EQ(answer->record.wall_ns, expected.record.wall_ns);
  EXPECT_EQ(answer->record.counters, expected.record.counters);
  EXPECT_EQ(answer->record.benchmark_json, expected.record.benchmark_json);
  EXPECT_EQ(answer->worker_ns, 12.5);
  EXPECT_EQ(answer->exr, expected.exr);
}

TEST(Wire, JobsContainProtocolAndInjectedFaults) {
  const Job job{
      .name = "n",
      .configuration = {{"step", "0.5"}},
      .protocol = {.warm_up_frames = 2, .timed_frames = 3, .counters = false, .timed = false},
      .faults = {"slowdown:20"}};
  const auto back = as_job(to_message(job));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->configuration, job.configuration);
  EXPECT_EQ(back->protocol.timed_frames, 3);
  EXPECT_FALSE(back->protocol.counters);
  EXPECT_FALSE(back->protocol.timed);
  EXPECT_EQ(back->faults, job.faults);
}

TEST(Wire, BatchesRoundTrip) {
  const auto hold =
      as_hold(to_message(Hold{.configuration = {{"step", "0.5"}}, .faults = {"slowdown:5"}}));
  ASSERT_TRUE(hold);
  EXPECT_EQ(hold->configuration.at("step"), "0.5");
  EXPECT_THAT(hold->faults, testing::ElementsAre("slowdown:5"));
  EXPECT_EQ(as_frames(to_message(Frames{.count = 7}))->count, 7);
  EXPECT_TRUE(as_release(to_message(Release{})));
  EXPECT_FALSE(as_release(to_message(Frames{})));
  const Batch sent{.outcome = record::Outcome::lost,
                   .reason = {.cause = record::Cause::device_lost, .detail = "gone"},
                   .wall_ns = {1.0 / 3, 2e9},
                   .device_ns = {0.25}};
  const auto batch = as_batch(to_message(sent));
  ASSERT_TRUE(batch);
  EXPECT_EQ(batch->outcome, sent.outcome);
  EXPECT_EQ(batch->reason, sent.reason);
  EXPECT_EQ(batch->wall_ns, sent.wall_ns);
  EXPECT_EQ(batch->device_ns, sent.device_ns);
  EXPECT_THROW(static_cast<void>(as_batch({{{"type", "turn"}}, {}})), core::InputError);
}

TEST(Wire, LoadingIsNotAnAnswer) {
  const Message message = to_message(Loading{.what = "a.xyz", .share = 0.25});
  EXPECT_FALSE(as_answer(message));
  const auto loading = as_loading(message);
  ASSERT_TRUE(loading);
  EXPECT_EQ(loading->what, "a.xyz");
  EXPECT_EQ(loading->share, 0.25);
}

TEST(Wire, TheEndOfAPipeIsNotAMessageAndAPartialMessageIsAnError) {
  TestPipe pipe;
  ASSERT_EQ(::write(pipe.write.get(), "tripty", 6), 6);
  pipe.write.reset();
  EXPECT_THROW(static_cast<void>(receive(pipe.read.get())), core::IoError);
  TestPipe empty;
  empty.write.reset();
  EXPECT_EQ(receive(empty.read.get()), std::nullopt);
}

TEST(Wire, ABufferPutsPiecesTogetherAndKeepsTheNextMessage) {
  TestPipe pipe;
  send(pipe.write.get(), to_message(Refused{{.detail = "first"}}));
  send(pipe.write.get(), to_message(Refused{{.detail = "second"}}));
  pipe.write.reset();
  MessageBuffer buffer;
  std::vector<std::string> reasons;
  for (std::byte byte{}; ::read(pipe.read.get(), &byte, 1) == 1;) {
    buffer.append({&byte, 1});
    if (const auto message = buffer.next()) reasons.push_back(as_refused(*message)->reason.detail);
  }
  EXPECT_THAT(reasons, testing::ElementsAre("first", "second"));
  EXPECT_TRUE(buffer.empty());
}

TEST(Wire, DriverOutputInAPipeIsRejected) {
  MessageBuffer buffer;
  const std::string noise = "WARNING: lavapipe is not a conformant implementation";
  buffer.append(std::as_bytes(std::span(noise)));
  EXPECT_THROW(static_cast<void>(buffer.next()), core::InputError);
}

TEST(Wire, AnIncompleteMessageIsATypedError) {
  EXPECT_THROW(static_cast<void>(as_job({{{"type", "job"}}, {}})), core::InputError);
  EXPECT_THROW(static_cast<void>(as_hello({{{"type", "hello"}}, {}})), core::InputError);
}

TEST(Wire, BrokenUtf8FromADriverDoesNotStopAnAnswer) {
  TestPipe pipe;
  send(pipe.write.get(), to_message(Refused{{.detail = "caf\xe9"}}));
  const auto message = receive(pipe.read.get());
  ASSERT_TRUE(message);
  EXPECT_THAT(as_refused(*message)->reason.detail, testing::StartsWith("caf"));
}

}  // namespace
}  // namespace triptych::measure
