#pragma once
#include <map>
#include <string>

#include "app/registry.hpp"
#include "judge/gate.hpp"
#include "record/store.hpp"

namespace triptych::app {

// Truths by record, rendered once: kept in memory for this command and in the store for the next.
class Truths {
 public:
  Truths(const Registry& registry, record::Store& store) : registry_(registry), store_(store) {}

  [[nodiscard]] const judge::TruthPair& of(const record::Record& record);

 private:
  [[nodiscard]] judge::TruthPair find_or_render(const record::Record& record);

  const Registry& registry_;
  record::Store& store_;
  std::map<std::string, judge::TruthPair> known_;
};

}  // namespace triptych::app
