// No decision may depend on strings that are written for people. The same runs are judged twice:
// once with plain messages, and once with random words wherever a driver, a library or a person can
// supply a string. Verdicts, groups, retries, reductions and exit codes must be identical.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "comparison/comparison.hpp"
#include "comparison/store_diff.hpp"
#include "core/random.hpp"
#include "gate_fixture.hpp"
#include "judge/gate/flakes.hpp"
#include "reduction/failure.hpp"
#include "report/exports/comparison_json.hpp"
#include "report/overview.hpp"

namespace triptych::judge {
namespace {

// Generates random strings from phrases that the program once interpreted and from meaningless
// letters.
class Words {
 public:
  explicit Words(std::uint64_t seed) : random_(seed) {}
  std::string operator()() {
    static const std::vector<std::string> known{
        "bad input: ",  "no answer within 7 s", "; not tried, as others ended so",
        "known fail: ", "flake, right when",    "unsteady",
        "exact",        "; accept it",          "crashed:",
        "hung: ",       "16 of 64 pixels",      "differs:"};
    std::string text;
    for (int i = 0; i < 4; ++i) {
      text += known[below(known.size())];
      for (int letter = 0; letter < 6; ++letter) {
        text += static_cast<char>('a' + below(26));
      }
    }
    return text;
  }

 private:
  std::size_t below(std::size_t n) {
    return std::min(n - 1, static_cast<std::size_t>(random_.uniform() * static_cast<double>(n)));
  }
  core::Random random_;
};

class RandomWords : public GateTest {
 protected:
  // Makes all times equal, because findings are sorted by time and noise would change their order.
  static void steady(record::Record& record, core::Image&) { record.wall_ns.assign(5, 1e6); }

  // Adds a run in which each configuration fails in a different way on each device.
  void add_failing_run(const std::string& run, Words* words) {
    const auto say = [words](const std::string& plain) { return words ? (*words)() : plain; };
    add_run(run, [&](record::Record& record, core::Image& image) {
      steady(record, image);
      const bool plain = record.configuration == plain_;
      // The other scene fails in the same way, with other words.
      const bool other = record.configuration == other_plain_;
      const auto end = [&](record::Outcome outcome, record::Reason reason) {
        record.outcome = outcome;
        reason.detail = say("a detail");
        reason.last_output = say("last words");
        record.reason = std::move(reason);
      };
      using record::Cause;
      if (record.device == "vulkan:lavapipe" && (plain || other)) {
        end(record::Outcome::crashed, {.cause = Cause::signal, .numbers = {{"signal", 11}}});
      } else if (record.device == "vulkan:lavapipe" && record.configuration == bricks_) {
        end(record::Outcome::hung, {.cause = Cause::timeout, .numbers = {{"limit_s", 20}}});
      } else if (record.device == "gl:llvmpipe-egl" && plain) {
        end(record::Outcome::skipped, {.cause = Cause::bad_input});
      } else if (record.device == "gl:llvmpipe-egl" && record.configuration == bricks_) {
        end(record::Outcome::skipped, {.cause = Cause::not_supported});
      } else if (record.device == "opencl:pocl" && (plain || other)) {
        end(record::Outcome::failed,
            {.cause = Cause::api_error, .subject = "clFinish", .code = "CL_OUT_OF_RESOURCES"});
      } else if (record.device == "opencl:pocl" && record.configuration == bricks_) {
        image.rgba[4 * 11] += 0.01F;
        ++record.counters["samples"];
      }
    });
  }

  const std::string other_plain_ = "camera=side,data=ball,technique=raycast";

  // Returns all decisions of the judge and its report, without any messages.
  static std::string decided(const GateResult& result) {
    std::string text = fmt::format("exit {}\n", static_cast<int>(result.exit_code()));
    for (const Finding& each : result.findings) {
      text +=
          fmt::format("{} {} {} {}: {} {}\n", name_of(each.check), name_of(each.verdict),
                      each.device, each.configuration, kind_of(each), name_of(each.advice.advice));
    }
    // The overview contains pointers to these results, so they must outlive it.
    const std::vector<GateResult> results{result};
    const report::Overview all = report::overview(results);
    for (const auto* causes : {&all.open, &all.remarks}) {
      for (const report::Cause& cause : *causes) {
        text += fmt::format("group of {}: {} {} {}\n", cause.group.configurations,
                            cause.group.first->configuration, cause.group.signature,
                            static_cast<int>(cause.group.attribution().kind));
      }
    }
    return text;
  }

  // Judges a run with failures as `gate` and `validate` do: first as it is, then after the failing
  // configurations were run again, and then with these failures declared as expected. Finally,
  // reduces and compares the run as `reduce`, `compare` and `diff` do.
  std::string everything(const std::string& name, Words* words) {
    add_failing_run(name, words);
    add_run(name + "-again", steady);
    const auto say = [words](const Finding&) { return words ? (*words)() : "words"; };
    const GateResult first = gate(name);
    std::string text = decided(first);
    const SecondAttempt again = mark_flakes(first, gate(name + "-again"), failing_cases(first));
    text += decided(again.result);
    for (const auto& [device, configuration] : again.flakes) {
      text += fmt::format("flake {} {}\n", device, configuration);
    }
    GateRequest request = request_;
    request.expected_outcomes = expected_outcomes_of(std::vector{first}, say);
    for (const Waiver& each : *request.expected_outcomes) {
      text += fmt::format("expected {} {}\n", each.device, name_of(each.outcome));
    }
    text += decided(gate(name, request));
    text += failures(name);
    text += differences(name, words);
    return text;
  }

  // Returns for every pair of failures of the run whether they are of the same kind ('=') or not
  // ('-').
  std::string failures(const std::string& run) {
    const reduction::Evidence evidence{
        .truth = request_.truth,
        .image = [&](const record::Record& record) { return store_.decoded_image(record.image); }};
    std::vector<reduction::Failure> all;
    for (const record::Record& record : store_.records(run)) {
      if (auto failure = reduction::failure_of(record, evidence)) all.push_back(*failure);
    }
    std::string text;
    for (const auto& a : all) {
      for (const auto& b : all) text += reduction::is_same_kind(a, b) ? '=' : '-';
    }
    return text + "\n";
  }

  // Returns the machine-readable members of a comparison, without its messages.
  static core::Json without_texts(core::Json json) {
    if (json.is_object()) {
      for (const char* text : {"text", "headline", "detail", "last_words"}) json.erase(text);
    }
    if (json.is_structured()) {
      for (core::Json& each : json) each = without_texts(each);
    }
    return json;
  }

  // Returns the verdicts of `compare` and `diff` on this run and a correct run. Because there is no
  // suite, the reference images are missing, and the reason is one of the random strings.
  std::string differences(const std::string& run, Words* words) {
    const std::string unknown = words ? (*words)() : "no such suite";
    measure::Truths truths(
        [&](std::string_view) -> measure::SuiteWithTruth& { throw core::InputError(unknown); },
        store_);
    comparison::StoreDiff diff;
    std::string text;
    for (const record::Store::DeviceEntry& each : store_.devices(run)) {
      const comparison::RunSide a{store_, run + "-again", each.device};
      const comparison::RunSide b{store_, run, each.device};
      comparison::RunDiff found = comparison::diff_runs(a, b, truths, true);
      comparison::ComparisonResult compared{.a = each.device, .b = each.device};
      for (const comparison::ConfigurationDiff& one : found.configurations) {
        compared.configurations.push_back({.key = one.key,
                                           .ended = one.ended,
                                           .reason = one.no_time,
                                           .differences = one.differences});
      }
      text += without_texts(report::to_json(compared, {})).dump(1) + "\n";
      for (const auto& group : compared.groups()) {
        text +=
            fmt::format("{} in {}, first {}\n", group.difference.about(), group.count, group.where);
      }
      diff.devices.push_back({each.device, each.device, found.device, found.configurations});
    }
    return text + without_texts(report::to_json(diff)).dump(1) + "\n";
  }
};

TEST_F(RandomWords, DoNotAffectDecisions) {
  accept_first(steady);
  const std::string plain = everything("plain", nullptr);
  EXPECT_THAT(plain, testing::HasSubstr("exit 1"));
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Words words(seed);
    EXPECT_EQ(everything(fmt::format("random{}", seed), &words), plain);
  }
}

// If a reference image cannot be computed, the findings do not depend on the message of the
// exception.
TEST_F(RandomWords, InExceptionsDoNotAffectDecisions) {
  accept_first();
  add_run("b");
  Words words(1);
  request_.truth = [](const record::Record&) -> TruthPair { throw core::IoError("plain"); };
  const std::string plain = decided(gate("b"));
  request_.truth = [&](const record::Record&) -> TruthPair { throw core::IoError(words()); };
  EXPECT_EQ(decided(gate("b")), plain);
}

}  // namespace
}  // namespace triptych::judge
