#include "app/truth.hpp"

#include <fmt/format.h>

#include <utility>

#include "app/paths.hpp"
#include "core/image_io.hpp"
#include "record/data_factors.hpp"

namespace triptych::app {
namespace {

// Every record with this text has the same truth and bound; cheaper than Suite::truth_key, which
// loads the data to know that it has not changed.
std::string memory_key(const record::Record& record) {
  std::string key = record.suite + " " + record.scene;
  for (const char* factor : {"ert", "adapt", "voxel", "precision", "ray"}) {
    const auto found = record.factors.find(factor);
    if (found != record.factors.end()) key += " " + found->second;
  }
  for (const auto& [name, value] : record.precision) key += fmt::format(" {}={}", name, value);
  return key;
}

}  // namespace

const judge::TruthPair& Truths::of(const record::Record& record) {
  const std::string key = memory_key(record);
  const auto found = known_.find(key);
  if (found != known_.end()) return found->second;
  return known_.emplace(key, find_or_render(record)).first->second;
}

const std::map<std::string, double>& Truths::open_counts_of(const record::Record& record) {
  std::string key = memory_key(record);
  for (const char* factor : {"skip", "culling"}) {
    const auto found = record.factors.find(factor);
    if (found != record.factors.end()) key += " " + found->second;
  }
  if (const auto found = open_counts_.find(key); found != open_counts_.end()) return found->second;
  return open_counts_
      .emplace(key, registry_.suite(record.suite).open_counts(record.factors, record.precision))
      .first->second;
}

std::string Truths::data_hash_of(const record::Record& record) {
  std::string key = record.suite;
  for (const auto& [factor, level] : record.factors) {
    if (record::decides_data(factor)) key += " " + factor + "=" + level;
  }
  if (const auto found = data_hashes_.find(key); found != data_hashes_.end()) return found->second;
  std::string hash;
  try {
    hash = registry_.suite(record.suite).data_hash(record.factors);
  } catch (const core::Error&) {
    // Whoever wants the truth is told why there are none.
  }
  return data_hashes_.emplace(key, std::move(hash)).first->second;
}

std::string Truths::name_of(const record::TruthImage& truth) const {
  return fmt::format("{}: truth of {}", store_.file().string(), truth.scene);
}

judge::TruthPair Truths::find_or_render(const record::Record& record) {
  measure::SuiteWithTruth& suite = registry_.suite(record.suite);
  const std::string version = suite.truth_key(record.factors, record.precision);
  if (const auto stored = store_.truth(record.scene, version)) {
    const std::string name = name_of(*stored);
    return {.truth = core::decode_exr(stored->image, name),
            .bound = core::decode_exr(stored->bound, name)};
  }
  measure::Truth truth = suite.truth(record.factors, record.precision);
  keep({.scene = record.scene,
        .version = version,
        .image = core::encode_exr(truth.image),
        .bound = core::encode_exr(truth.bound)});
  return {.truth = std::move(truth.image), .bound = std::move(truth.bound)};
}

// One that cannot be kept – the store is read-only, the disk full – is as true.
void Truths::keep(const record::TruthImage& truth) {
  try {
    store_.set_truth(truth);
  } catch (const core::IoError&) {
    return;
  }
}

const accuracy::LimitPicture* Truths::limit_of(const record::Record& record) {
  const std::string key = registry_.suite(record.suite).limit_key(record.factors);
  if (key.empty()) return nullptr;
  const auto found = limits_.find(key);
  if (found != limits_.end()) return &found->second;
  return &limits_.emplace(key, find_or_render_limit(record, key)).first->second;
}

accuracy::LimitPicture Truths::find_or_render_limit(const record::Record& record,
                                                    const std::string& key) {
  measure::SuiteWithTruth& suite = registry_.suite(record.suite);
  accuracy::LimitPicture picture{
      .key = key, .image = {}, .uncertainty = {}, .closed_form = suite.closed_form(record.factors)};
  // Among the truths: a scene's name of its own, and its uncertainty for a bound.
  const std::string scene = "limit of " + record.suite;
  if (const auto stored = store_.truth(scene, key)) {
    picture.image = core::decode_exr(stored->image, name_of(*stored));
    picture.uncertainty = core::decode_exr(stored->bound, name_of(*stored));
    return picture;
  }
  measure::Limit limit = suite.limit(record.factors);
  keep({.scene = scene,
        .version = key,
        .image = core::encode_exr(limit.image),
        .bound = core::encode_exr(limit.uncertainty)});
  picture.image = std::move(limit.image);
  picture.uncertainty = std::move(limit.uncertainty);
  return picture;
}

judge::GateRequest request_of(Truths& truths, const std::string& plan) {
  return {
      .plan = plan,
      .checks = {},
      .devices = {},
      .required_devices = {},
      .truth = [&truths](const record::Record& record) { return truths.of(record); },
      .limit = [&truths](const record::Record& record) { return truths.limit_of(record); },
      .expectations =
          [&truths](const record::Record& record) { return truths.expectations_of(record); },
      .open_counts =
          [&truths](const record::Record& record) { return truths.open_counts_of(record); },
      .today = today(),
      .data_hash = [&truths](const record::Record& record) { return truths.data_hash_of(record); }};
}

comparison::KnownTruth known_truth(Truths& truths) {
  return {.picture = [&truths](const record::Record& record) -> const judge::TruthPair& {
            return truths.of(record);
          },
          .open_counts =
              [&truths](const record::Record& record) { return truths.open_counts_of(record); }};
}

measure::RequestPictures pictures_of(Truths& truths) {
  return {.limit = [&truths](const record::Record& record) { return truths.limit_of(record); },
          .truth = [&truths](const record::Record& record) { return truths.of(record).truth; },
          .drawn = [&truths](const record::Record& record) { return truths.picture_of(record); }};
}

}  // namespace triptych::app
