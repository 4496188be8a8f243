#include "suites/anchors/suite.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"
#include "core/json.hpp"
#include "measure/factor.hpp"
#include "technique/anchors/anchor_work.hpp"
#include "triptych_suite_anchors_embedded.hpp"

namespace triptych::anchors_suite {
namespace {

using measure::Configuration;
using measure::Decides;

constexpr double largest_size = 256;  // techniques may end earlier and say so

[[noreturn]] void refuse() {
  throw core::NotSupported("anchors draw no picture: they are judged by their checksum");
}

class AnchorSuite final : public measure::SuiteWithTruth {
 public:
  std::string_view name() const override { return "anchors"; }

  const std::vector<measure::Factor>& factors() const override {
    static const std::vector<measure::Factor> factors{
        measure::choice("technique", measure::technique_ids("anchors"), "anchor_arithmetic",
                        Decides::how_it_is_made, "which resource of the device is measured"),
        measure::number("size", 1, largest_size, "1", Decides::the_picture,
                        "amount of work, a whole number: time grows in proportion"),
    };
    return factors;
  }

  void check(const measure::Factor& factor, std::string_view value) const override {
    if (factor.name != "size") return;
    const double size = measure::as_number({{"size", std::string(value)}}, "size");
    if (size != std::floor(size)) {
      throw core::InputError(fmt::format("size {}: expected a whole number", value));
    }
  }

  std::vector<std::string_view> plan_names() const override { return {"frozen"}; }
  std::string_view plan_text(std::string_view plan) const override {
    return embedded(std::string(plan) + ".yaml");
  }

  std::string missing_data(const Configuration&) const override { return {}; }

  measure::Work work(Configuration& configuration, const measure::Device&) override {
    return {.technique = configuration.at("technique"),
            .scene = measure::AnchorWork{
                .size = static_cast<int>(measure::as_number(configuration, "size"))}};
  }

  measure::Work calibration(technique::Work kind) override {
    return {.technique = kind == technique::Work::draw ? "anchor_raster" : "anchor_arithmetic",
            .scene = measure::AnchorWork{}};
  }

  measure::Truth truth(const Configuration&, const std::map<std::string, double>&) override {
    refuse();
  }
  nlohmann::json describe(const Configuration&) override { refuse(); }
  std::string truth_key(const Configuration&, const std::map<std::string, double>&) override {
    refuse();
  }
};

}  // namespace

std::unique_ptr<measure::SuiteWithTruth> make_suite(const std::vector<std::filesystem::path>&) {
  return std::make_unique<AnchorSuite>();
}

}  // namespace triptych::anchors_suite
