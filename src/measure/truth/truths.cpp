#include "measure/truth/truths.hpp"

#include <fmt/format.h>

#include <utility>

#include "core/error.hpp"
#include "core/image_io.hpp"
#include "measure/truth/own_seal.hpp"
#include "record/data_factors.hpp"

namespace triptych::measure {
namespace {

// Returns the key under which a record's reference image and bound are kept in memory.
// SuiteWithTruth::truth_key() would be more expensive, because it loads the data to find out
// whether they have changed.
std::string memory_key(const record::Record& record) {
  std::string key = record.suite + " " + record.scene;
  for (const char* factor : {"ert", "adapt", "voxel", "precision", "ray"}) {
    const auto found = record.factors.find(factor);
    if (found != record.factors.end()) key += " " + found->second;
  }
  for (const auto& [name, value] : record.precision) key += fmt::format(" {}={}", name, value);
  return key;
}

// Returns the value for the key. If it does not exist, calls `make` to create it.
template <typename Value, typename Make>
const Value& find_or_insert(std::map<std::string, Value>& known, const std::string& key,
                            const Make& make) {
  const auto found = known.find(key);
  return found != known.end() ? found->second : known.emplace(key, make()).first->second;
}

}  // namespace

const accuracy::TruthPair& Truths::of(const record::Record& record) {
  return find_or_insert(known_, memory_key(record), [&] { return find_or_render(record); });
}

const std::map<std::string, double>& Truths::open_counts_of(const record::Record& record) {
  std::string key = memory_key(record);
  for (const char* factor : {"skip", "culling"}) {
    const auto found = record.factors.find(factor);
    if (found != record.factors.end()) key += " " + found->second;
  }
  return find_or_insert(open_counts_, key, [&] {
    return suite_(record.suite).open_counts(record.factors, record.precision);
  });
}

std::string Truths::data_hash_of(const record::Record& record) {
  std::string key = record.suite;
  for (const auto& [factor, level] : record.factors) {
    if (record::determines_data(factor)) key += " " + factor + "=" + level;
  }
  return find_or_insert(data_hashes_, key, [&]() -> std::string {
    try {
      return suite_(record.suite).data_hash(record.factors);
    } catch (const core::Error&) {
      return {};  // the caller also requests the reference image, which throws the reason
    }
  });
}

accuracy::TruthPair Truths::load_or_render(const std::string& scene, const std::string& version,
                                           const std::function<accuracy::TruthPair()>& render) {
  const auto stored = store_.truth(scene, version);
  if (stored && !stored->own_seal.empty() && own_seal(*stored) == stored->own_seal) {
    const std::string name =
        fmt::format("{}: reference image of {}", store_.file().string(), scene);
    return {.truth = core::decode_exr(stored->image, name),
            .bound = core::decode_exr(stored->bound, name)};
  }
  accuracy::TruthPair rendered = render();
  try {
    record::TruthImage drawn{.scene = scene,
                             .version = version,
                             .image = core::encode_exr(rendered.truth),
                             .bound = core::encode_exr(rendered.bound)};
    drawn.own_seal = own_seal(drawn).value_or("");
    store_.set_truth(drawn);
  } catch (const core::IoError&) {
    // The error is ignored, because the image is valid even if it could not be stored, for example
    // because the store is read-only or the disk is full.
  }
  return rendered;
}

accuracy::TruthPair Truths::find_or_render(const record::Record& record) {
  SuiteWithTruth& suite = suite_(record.suite);
  return load_or_render(record.scene, suite.truth_key(record.factors, record.precision),
                        [&] { return suite.truth(record.factors, record.precision); });
}

const accuracy::LimitImage* Truths::limit_of(const record::Record& record) {
  const std::string key = suite_(record.suite).limit_key(record.factors);
  if (key.empty()) return nullptr;
  return &find_or_insert(limits_, key, [&] { return find_or_render_limit(record, key); });
}

accuracy::LimitImage Truths::find_or_render_limit(const record::Record& record,
                                                  const std::string& key) {
  SuiteWithTruth& suite = suite_(record.suite);
  // A limit (the image to which a scene converges as its sampling is refined) is stored like a
  // reference image, with a special scene name and with its uncertainty as the bound.
  accuracy::TruthPair pair =
      load_or_render("limit of " + record.suite, key, [&]() -> accuracy::TruthPair {
        Limit limit = suite.limit(record.factors);
        return {std::move(limit.image), std::move(limit.uncertainty)};
      });
  return {.key = key,
          .image = std::move(pair.truth),
          .uncertainty = std::move(pair.bound),
          .closed_form = suite.closed_form(record.factors)};
}

}  // namespace triptych::measure
