#include "report/ci/ctest_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string_view>

#include "core/image_io.hpp"
#include "core/private_folder.hpp"
#include "core/quoting.hpp"
#include "report/figures/share_of_bound.hpp"
#include "report/words/finding.hpp"

namespace triptych::report {
namespace {

namespace fs = std::filesystem;

std::string number(std::string_view name, double value) {
  return fmt::format(
      "<CTestMeasurement type=\"numeric/double\" name=\"{}\">{}</CTestMeasurement>\n", name, value);
}

// Writes an image of a test. `what` becomes a part of the file name. The file is not removed,
// because CTest reads it after this process has ended. It is in a private folder, so that no other
// user can create a link with the same name.
std::string image_element(std::string_view name, std::string test, std::string_view what,
                          const core::Image& image) {
  // The test id comes from a store, so characters with which it could name another folder are
  // replaced.
  std::ranges::replace_if(
      test, [](unsigned char c) { return std::isalnum(c) == 0 && c != '.' && c != '-'; }, '_');
  const core::PrivateFolder folder = core::private_temporary_folder("ctest");
  const fs::path file = folder.path() / fmt::format("{}.{}.png", test, what);
  core::write_png(image, file);
  return fmt::format(
      "<CTestMeasurementFile type=\"image/png\" name=\"{}\">{}</CTestMeasurementFile>\n", name,
      fs::absolute(file).string());
}

std::string image_elements(const record::Store& store, const std::string& run,
                           const judge::FindTruth& truth, const judge::Finding& worst) {
  for (const record::Record& record : store.records(run)) {
    if (record.configuration != worst.configuration || record.device != worst.device) continue;
    if (record.image.empty()) return {};
    const core::Image image = store.decoded_image(record.image);
    const judge::TruthPair right = truth(record);
    std::string both = image_element("TestImage", worst.test, "test", image) +
                       image_element("ValidImage", worst.test, "valid", right.truth);
    if (image.width != right.truth.width || image.height != right.truth.height) return both;
    return both + image_element("DifferenceImage", worst.test, "difference",
                                share_of_bound(image, right.truth, right.bound).image);
  }
  return {};
}

}  // namespace

std::string ctest_output(const judge::GateResult& result, const record::Store& store,
                         const judge::FindTruth& truth) {
  std::string text;
  for (const judge::Finding& finding : result.findings) {
    if (finding.verdict == judge::Verdict::pass) continue;
    text += fmt::format("{} {}: {}\n", judge::name_of(finding.verdict),
                        core::printable(finding.configuration),
                        core::printable(words::text_of(finding)));
  }
  if (!result.findings.empty()) {
    const judge::Finding& worst = result.findings.front();
    for (const auto& [name, value] : worst.numbers) text += number(name, value);
    if (truth && !worst.device.empty()) text += image_elements(store, result.run, truth, worst);
  }
  return text + words::headline(result) + "\n";
}

std::optional<std::string> skip_reason(const judge::GateResult& result) {
  std::string reason;
  for (const judge::Finding& finding : result.findings) {
    const bool decides_nothing =
        finding.verdict == judge::Verdict::advisory || finding.verdict == judge::Verdict::skipped;
    // A pass about a whole device only summarizes other findings, so it judges nothing itself. The
    // check `correlation` is an exception.
    const bool is_summary = finding.verdict == judge::Verdict::pass &&
                            finding.configuration.empty() &&
                            finding.check != judge::Check::correlation;
    if (!decides_nothing && !is_summary) return std::nullopt;
    if (decides_nothing && reason.empty()) reason = words::text_of(finding);
  }
  if (reason.empty()) return std::nullopt;
  return reason;
}

}  // namespace triptych::report
