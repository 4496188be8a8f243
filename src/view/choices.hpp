#pragma once
// The configuration that the window shows, and the levels that its controls offer.

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "measure/contract/suite.hpp"

namespace triptych::view {

class Choices {
 public:
  // `suite` must outlive this object. Only its factors, plans and checks are used, so no data are
  // loaded.
  Choices(const measure::Suite& suite, measure::Configuration first);

  [[nodiscard]] const measure::Suite& suite() const noexcept { return suite_; }
  [[nodiscard]] const measure::Configuration& configuration() const noexcept { return current_; }
  // Returns the configuration's key (see measure::configuration_key).
  [[nodiscard]] std::string key() const;
  [[nodiscard]] const std::string& value(const std::string& factor) const {
    return current_.at(factor);
  }
  [[nodiscard]] const std::string& default_level(const std::string& factor) const {
    return default_levels_.at(factor);
  }

  // Sets a factor to a level, which is converted to its canonical spelling. Returns an empty string
  // on success. If the level is rejected, returns the reason and does not change the configuration.
  [[nodiscard]] std::string set(const std::string& factor, std::string_view value);
  // Restores the configuration that the window showed first.
  void reset() { current_ = first_; }

  // Returns the levels in the drop-down list of a factor. For a factor that also accepts typed
  // levels, the list includes the levels that occur in the suite's plans and, for `data`, the
  // suite's data generators.
  [[nodiscard]] const std::vector<std::string>& offered_levels(const std::string& factor) const {
    return offered_levels_.at(factor);
  }

 private:
  void collect_offered_levels();

  const measure::Suite& suite_;
  measure::Configuration first_;
  measure::Configuration current_;
  measure::Configuration default_levels_;
  std::map<std::string, std::vector<std::string>> offered_levels_;
};

}  // namespace triptych::view
