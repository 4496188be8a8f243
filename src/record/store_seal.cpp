#include "record/store_seal.hpp"

#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/json_text.hpp"

namespace triptych::record {

using core::Json;

std::string seal_of(const Run& run) {
  return core::json_hash(Json(run));
}

std::string seal_of(const Device& device, const std::vector<ClockTrust>& clocks) {
  return core::json_hash(Json{{"device", device}, {"clocks", clocks}});
}

std::string seal_of(const Record& record) {
  Json json = record;
  json.erase("run");
  return core::json_hash(json);
}

std::string seal_of(const TruthImage& truth) {
  return core::HashBuilder("truth")
      .add(truth.scene)
      .add(truth.version)
      .add(core::content_hash(truth.image))
      .add(core::content_hash(truth.bound))
      .hash();
}

void require_seal(std::string_view stored, std::string_view found, const std::string& what) {
  if (stored != found) throw core::InputError(what + " was changed after it was written");
}

}  // namespace triptych::record
