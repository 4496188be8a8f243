#pragma once
// Provides the data with which a record's image is compared: the reference image, its error bound,
// the limit (the image to which the scene converges as its sampling is refined), and the
// expectations (conditions that only stress cases have). The record's suite computes all of them.

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "accuracy/cases.hpp"
#include "accuracy/truth_pair.hpp"
#include "measure/contract/suite.hpp"
#include "record/store.hpp"

namespace triptych::measure {

using FindSuiteWithTruth = std::function<SuiteWithTruth&(std::string_view)>;  // throws InputError

// Each image is rendered only once. It is kept in memory as long as this object exists and, if the
// store is writable, stored for later processes. If data is missing, every function throws the
// suite's exception.
class Truths {
 public:
  Truths(FindSuiteWithTruth suite, record::Store& store)
      : suite_(std::move(suite)), store_(store) {}

  [[nodiscard]] const accuracy::TruthPair& of(const record::Record& record);
  // Returns the conditions that the record must satisfy in addition to its error bound.
  [[nodiscard]] std::vector<record::Expectation> expectations_of(
      const record::Record& record) const {
    return suite_(record.suite).expectations(record.factors);
  }
  // See SuiteWithTruth::open_counts.
  [[nodiscard]] const std::map<std::string, double>& open_counts_of(const record::Record& record);
  // See SuiteWithTruth::data_hash. Returns an empty string if the data is unavailable.
  [[nodiscard]] std::string data_hash_of(const record::Record& record);
  // Returns the limit image of the record's scene, or nullptr if the scene has none.
  [[nodiscard]] const accuracy::LimitImage* limit_of(const record::Record& record);
  // Returns the image to which a record of the store refers.
  [[nodiscard]] core::Image image_of(const record::Record& record) const {
    return store_.decoded_image(record.image);
  }

 private:
  [[nodiscard]] accuracy::TruthPair find_or_render(const record::Record& record);
  [[nodiscard]] accuracy::LimitImage find_or_render_limit(const record::Record& record,
                                                          const std::string& key);
  // Returns an image and its error bound, which are stored for this scene and version. If there are
  // none, or if this user did not render them (own_seal.hpp), calls `render` and stores the result.
  [[nodiscard]] accuracy::TruthPair load_or_render(
      const std::string& scene, const std::string& version,
      const std::function<accuracy::TruthPair()>& render);

  FindSuiteWithTruth suite_;
  record::Store& store_;
  std::map<std::string, accuracy::TruthPair> known_;
  std::map<std::string, accuracy::LimitImage> limits_;  // by limit key
  std::map<std::string, std::map<std::string, double>> open_counts_;
  std::map<std::string, std::string> data_hashes_;
};

}  // namespace triptych::measure
