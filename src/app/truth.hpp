#pragma once
#include <map>
#include <string>

#include "app/registry.hpp"
#include "comparison/run_diff.hpp"
#include "core/image_io.hpp"
#include "judge/gate/gate.hpp"
#include "measure/request/error_request.hpp"
#include "record/store.hpp"

namespace triptych::app {

// Truths by record, rendered once: kept in memory for this command and, where the store can be
// added to, there for the next.
class Truths {
 public:
  Truths(const Registry& registry, record::Store& store) : registry_(registry), store_(store) {}

  [[nodiscard]] const judge::TruthPair& of(const record::Record& record);
  // What must hold of the record beside its truth.
  [[nodiscard]] std::vector<record::Expectation> expectations_of(const record::Record& record) {
    return registry_.suite(record.suite).expectations(record.factors);
  }
  // GateRequest::open_counts.
  [[nodiscard]] const std::map<std::string, double>& open_counts_of(const record::Record& record);
  // GateRequest::data_hash.
  [[nodiscard]] std::string data_hash_of(const record::Record& record);
  // The picture that a record names.
  [[nodiscard]] core::Image picture_of(const record::Record& record) const {
    return store_.picture(record.image);
  }
  // nullptr where the record's scene has none.
  [[nodiscard]] const accuracy::LimitPicture* limit_of(const record::Record& record);

 private:
  [[nodiscard]] judge::TruthPair find_or_render(const record::Record& record);
  void keep(const record::TruthImage& truth);
  // What errors call it.
  [[nodiscard]] std::string name_of(const record::TruthImage& truth) const;

  const Registry& registry_;
  record::Store& store_;
  [[nodiscard]] accuracy::LimitPicture find_or_render_limit(const record::Record& record,
                                                            const std::string& key);
  std::map<std::string, judge::TruthPair> known_;
  std::map<std::string, accuracy::LimitPicture> limits_;  // by key
  std::map<std::string, std::map<std::string, double>> open_counts_;
  std::map<std::string, std::string> data_hashes_;
};

// A request to judge a plan on all devices by every check that is made for it, with these truths,
// today.
[[nodiscard]] judge::GateRequest request_of(Truths& truths, const std::string& plan);

// What two runs are compared by.
[[nodiscard]] comparison::KnownTruth known_truth(Truths& truths);

// What a requested error is told from.
[[nodiscard]] measure::RequestPictures pictures_of(Truths& truths);

}  // namespace triptych::app
