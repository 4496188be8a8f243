#pragma once
// What is right of a record, from its suite.

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

// Truths by record, rendered once: kept in memory as long as this, and, where the store can be
// added to, there for the next time. What a suite throws for want of data is thrown by each.
class Truths {
 public:
  Truths(FindSuiteWithTruth suite, record::Store& store)
      : suite_(std::move(suite)), store_(store) {}

  [[nodiscard]] const accuracy::TruthPair& of(const record::Record& record);
  // What must hold of the record beside its truth.
  [[nodiscard]] std::vector<record::Expectation> expectations_of(
      const record::Record& record) const {
    return suite_(record.suite).expectations(record.factors);
  }
  // SuiteWithTruth::open_counts.
  [[nodiscard]] const std::map<std::string, double>& open_counts_of(const record::Record& record);
  // SuiteWithTruth::data_hash; empty where the data are not here.
  [[nodiscard]] std::string data_hash_of(const record::Record& record);
  // nullptr where the record's scene has none.
  [[nodiscard]] const accuracy::LimitPicture* limit_of(const record::Record& record);
  // The picture that a record of the store names.
  [[nodiscard]] core::Image picture_of(const record::Record& record) const {
    return store_.picture(record.image);
  }

 private:
  [[nodiscard]] accuracy::TruthPair find_or_render(const record::Record& record);
  [[nodiscard]] accuracy::LimitPicture find_or_render_limit(const record::Record& record,
                                                            const std::string& key);
  // The pair kept under the names, rendered where there is none.
  [[nodiscard]] accuracy::TruthPair kept(const std::string& scene, const std::string& version,
                                         const std::function<accuracy::TruthPair()>& render);

  FindSuiteWithTruth suite_;
  record::Store& store_;
  std::map<std::string, accuracy::TruthPair> known_;
  std::map<std::string, accuracy::LimitPicture> limits_;  // by key
  std::map<std::string, std::map<std::string, double>> open_counts_;
  std::map<std::string, std::string> data_hashes_;
};

}  // namespace triptych::measure
