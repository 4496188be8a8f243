#include "view/session_json.hpp"

#include "core/json.hpp"
#include "report/words/outcome.hpp"

namespace triptych::view {
namespace {

core::Json error_json(const Session& session, const Column& column) {
  if (!column.error) return {{"not_compared", column.why_no_error}};
  const auto against = session.against();
  return {{"with", against ? session.columns()[*against].side.device : "reference"},
          {"right", column.error->right},
          {"beyond", column.error->beyond},
          {"share_of_bound", column.error->share},
          {"text", column.error->sentence}};
}

core::Json column_json(const Session& session, const Column& column) {
  core::Json json{{"device", column.side.device},
                  {"environment", column.side.environment},
                  {"command", session.command(column)}};
  if (!column.shown) return json;
  const record::Record& record = column.shown->record;
  json["configuration"] = column.shown->request.key;
  json["outcome"] = record::name_of(record.outcome);
  if (record.outcome != record::Outcome::measured) {
    json["reason"] = report::words::text_of(record.reason);
    return json;
  }
  json["image"] = record.image;
  json["counters"] = record.counters;
  json["statistics"] = record.statistics;
  json["time_ns"] = {{"clock", record.clock()}, {"samples", record.time_ns()}};
  json["difference"] = error_json(session, column);
  return json;
}

}  // namespace

core::Json session_json(const Session& session, const std::vector<std::array<int, 4>>& images) {
  core::Json columns = core::Json::array();
  for (std::size_t i = 0; i < session.columns().size(); ++i) {
    columns.push_back(column_json(session, session.columns()[i]));
    if (i < images.size()) columns.back()["place"] = images[i];
  }
  return {{"suite", session.request().suite},
          {"configuration", session.choices().key()},
          {"columns", std::move(columns)}};
}

}  // namespace triptych::view
