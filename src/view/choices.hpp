#pragma once
// The configuration that the window shows, and the values that its controls offer.

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "measure/contract/suite.hpp"

namespace triptych::view {

class Choices {
 public:
  // The suite must outlive this object. Only its factors, plans and checks are used, so no data are
  // loaded.
  Choices(const measure::Suite& suite, measure::Configuration first);

  [[nodiscard]] const measure::Suite& suite() const noexcept { return suite_; }
  [[nodiscard]] const measure::Configuration& configuration() const noexcept { return now_; }
  // See measure::configuration_key.
  [[nodiscard]] std::string key() const;
  [[nodiscard]] const std::string& value(const std::string& factor) const {
    return now_.at(factor);
  }
  [[nodiscard]] const std::string& standard(const std::string& factor) const {
    return standard_.at(factor);
  }

  // Sets a factor to a value, which is brought into its canonical spelling. Returns the reason if
  // the value is rejected, and then nothing changes; empty if it is accepted.
  [[nodiscard]] std::string set(const std::string& factor, std::string_view value);
  // Restores the configuration with which the window was opened.
  void reset() { now_ = first_; }

  // The values to choose from, in addition to any text that the user types: the levels of a factor,
  // or the values in the suite's plans together with the data that it generates.
  [[nodiscard]] const std::vector<std::string>& offers(const std::string& factor) const {
    return offers_.at(factor);
  }

 private:
  void collect_offers();

  const measure::Suite& suite_;
  measure::Configuration first_;
  measure::Configuration now_;
  measure::Configuration standard_;
  std::map<std::string, std::vector<std::string>> offers_;
};

}  // namespace triptych::view
