#include "record/merge/merged_rows.hpp"

#include <algorithm>
#include <utility>

#include "record/store_file.hpp"

namespace triptych::record {

MergedRows::MergedRows(const std::vector<Source>& sources, std::string_view select, int keys,
                       Before before, const std::vector<std::string>& parameters)
    : sources_(sources), keys_(keys), before_(std::move(before)) {
  queries_.reserve(sources.size());
  for (std::size_t i = 0; i < sources.size(); ++i) {
    on_store(sources[i].file, [&] { queries_.emplace_back(sources[i].database, select); });
    if (!parameters.empty()) queries_[i].bind(1, std::string_view(parameters[i]));
    advance(i);
  }
}

const MergedRows::Row* MergedRows::next() {
  if (row_) {
    advance(row_->source);
    for (const std::size_t each : row_->other_sources) advance(each);
    row_.reset();
  }
  if (waiting_.empty()) return nullptr;
  row_ = Row{.source = take_first(), .other_sources = {}};
  while (!waiting_.empty() && compare(waiting_.front(), row_->source) == 0) {
    std::size_t other = take_first();
    if (before_(queries_[other], queries_[row_->source])) std::swap(other, row_->source);
    row_->other_sources.push_back(other);
  }
  return &*row_;
}

// Compares keys byte by byte, which is the order in which SQLite sorts them.
int MergedRows::compare(std::size_t a, std::size_t b) const {
  for (int key = 0; key < keys_; ++key) {
    const int order = queries_[a].text(key).compare(queries_[b].text(key));
    if (order != 0) return order;
  }
  return 0;
}

void MergedRows::advance(std::size_t source) {
  if (!on_store(sources_[source].file, [&] { return queries_[source].step(); })) return;
  waiting_.push_back(source);
  std::ranges::push_heap(waiting_, [this](auto a, auto b) { return compare(a, b) > 0; });
}

std::size_t MergedRows::take_first() {
  std::ranges::pop_heap(waiting_, [this](auto a, auto b) { return compare(a, b) > 0; });
  const std::size_t first = waiting_.back();
  waiting_.pop_back();
  return first;
}

}  // namespace triptych::record
