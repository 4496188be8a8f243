#include "report/screen/repeats.hpp"

#include <fmt/format.h>

#include "core/json.hpp"
#include "core/json_text.hpp"
#include "report/words/finding.hpp"

namespace triptych::report {

std::string repeats_text(std::span<const judge::RepeatedCase> cases, std::size_t repetitions) {
  std::string text;
  std::size_t flaking = 0;
  std::size_t changing = 0;
  for (const judge::RepeatedCase& each : cases) {
    const std::string name =
        fmt::format("{} {} {}", each.key.plan, each.key.device, each.key.configuration);
    if (each.is_flaky()) {
      ++flaking;
      text += fmt::format("{}: fails in {} of {} repetitions: {}\n", name, each.failures(),
                          each.verdicts.size(),
                          words::text_of(static_cast<const judge::Observation&>(*each.worst)));
    }
    if (each.images > 1) {
      ++changing;
      text += fmt::format("{}: {} different images in {} repetitions\n", name, each.images,
                          each.verdicts.size());
    }
  }
  return text +
         fmt::format(
             "{} cases in {} repetitions: {} fail in only some repetitions, and the images of {} "
             "differ between repetitions\n",
             cases.size(), repetitions, flaking, changing);
}

std::string repeats_json_lines(std::span<const judge::RepeatedCase> cases) {
  std::string lines;
  for (const judge::RepeatedCase& each : cases) {
    core::Json json{{"plan", each.key.plan},
                    {"device", each.key.device},
                    {"configuration", each.key.configuration},
                    {"verdicts", core::Json::array()},
                    {"flakes", each.is_flaky()},
                    {"images", each.images}};
    for (const judge::Verdict verdict : each.verdicts) {
      json["verdicts"].push_back(judge::name_of(verdict));
    }
    if (each.failures() > 0) {
      json["cause"] = judge::name_of(each.worst->cause);
      json["text"] = words::text_of(static_cast<const judge::Observation&>(*each.worst));
    }
    lines += core::json_text(json, -1) + "\n";
  }
  return lines;
}

}  // namespace triptych::report
