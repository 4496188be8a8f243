#include "view/references.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "core/json.hpp"

namespace triptych::view {
namespace {

struct Asked {
  std::string key;
  measure::Configuration factors;
  std::map<std::string, double> precision;
};

// Returns a key. Records with equal keys have the same reference image and bound.
std::string key_of(const record::Record& record) {
  return core::Json{record.factors, record.precision}.dump(-1, ' ', true,
                                                           core::Json::error_handler_t::replace);
}

}  // namespace

struct References::Shared {
  std::unique_ptr<measure::SuiteWithTruth> suite;
  std::function<void()> changed;

  std::mutex mutex;
  std::condition_variable wake;
  std::vector<Asked> asked;
  std::map<std::string, std::shared_ptr<const Reference>> ready;  // by key_of
  bool stop = false;

  // Images by SuiteWithTruth::truth_key, with the newest image last. Only the rendering thread uses
  // this member.
  std::deque<std::pair<std::string, std::shared_ptr<const Reference>>> rendered = {};

  [[nodiscard]] std::shared_ptr<const Reference> reference(const Asked& wanted) {
    constexpr std::size_t most_kept = 16;
    const std::string key = suite->truth_key(wanted.factors, wanted.precision);
    const auto known =
        std::ranges::find(rendered, key, [](const auto& each) { return each.first; });
    if (known != rendered.end()) return known->second;
    auto made = std::make_shared<const Reference>(
        Reference{.pair = suite->truth(wanted.factors, wanted.precision), .error = {}});
    rendered.emplace_back(key, made);
    if (rendered.size() > most_kept) rendered.pop_front();
    return made;
  }
};

References::References(std::unique_ptr<measure::SuiteWithTruth> suite,
                       std::function<void()> changed)
    : shared_(std::make_shared<Shared>()) {
  shared_->suite = std::move(suite);
  shared_->changed = std::move(changed);
  std::thread([shared = shared_] { serve(shared); }).detach();
}

References::~References() {
  {
    const std::lock_guard lock(shared_->mutex);
    shared_->stop = true;
    shared_->changed = [] {};
  }
  shared_->wake.notify_one();
}

void References::show(const std::vector<const record::Record*>& records) {
  {
    const std::lock_guard lock(shared_->mutex);
    std::map<std::string, std::shared_ptr<const Reference>> kept;
    shared_->asked.clear();
    for (const record::Record* record : records) {
      Asked wanted{key_of(*record), record->factors, record->precision};
      if (kept.contains(wanted.key)) continue;
      const auto known = shared_->ready.find(wanted.key);
      if (known != shared_->ready.end())
        kept.insert(*known);
      else
        shared_->asked.push_back(std::move(wanted));
    }
    shared_->ready = std::move(kept);
  }
  shared_->wake.notify_one();
}

std::shared_ptr<const Reference> References::find(const record::Record& record) const {
  const std::lock_guard lock(shared_->mutex);
  const auto known = shared_->ready.find(key_of(record));
  return known == shared_->ready.end() ? nullptr : known->second;
}

void References::serve(const std::shared_ptr<Shared>& shared) {
  constexpr int lower_priority = 10;
  ::setpriority(PRIO_PROCESS, 0, lower_priority);  // on Linux, affects this thread and its children
  for (;;) {
    std::unique_lock lock(shared->mutex);
    shared->wake.wait(lock, [&] { return shared->stop || !shared->asked.empty(); });
    if (shared->stop) return;
    const Asked wanted = shared->asked.front();
    lock.unlock();
    std::shared_ptr<const Reference> reference;
    try {
      reference = shared->reference(wanted);
    } catch (const std::exception& error) {
      reference = std::make_shared<const Reference>(Reference{.pair = {}, .error = error.what()});
    }
    lock.lock();
    // If the window now shows another configuration, this image is no longer needed.
    const auto done = std::ranges::find(shared->asked, wanted.key, &Asked::key);
    if (done == shared->asked.end()) continue;
    shared->asked.erase(done);
    shared->ready.emplace(wanted.key, std::move(reference));
    const auto changed = shared->changed;
    lock.unlock();
    changed();
  }
}

}  // namespace triptych::view
