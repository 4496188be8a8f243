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

struct ReferenceRequest {
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
  std::vector<ReferenceRequest> requests;
  std::map<std::string, std::shared_ptr<const Reference>> ready;  // by key_of
  bool stop = false;

  // Images by SuiteWithTruth::truth_key, with the newest image last. Only the rendering thread uses
  // this member.
  std::deque<std::pair<std::string, std::shared_ptr<const Reference>>> rendered = {};

  [[nodiscard]] std::shared_ptr<const Reference> reference(const ReferenceRequest& request) {
    constexpr std::size_t max_kept = 16;
    const std::string key = suite->truth_key(request.factors, request.precision);
    const auto known =
        std::ranges::find(rendered, key, [](const auto& each) { return each.first; });
    if (known != rendered.end()) return known->second;
    auto made = std::make_shared<const Reference>(
        Reference{.pair = suite->truth(request.factors, request.precision), .error = {}});
    rendered.emplace_back(key, made);
    if (rendered.size() > max_kept) rendered.pop_front();
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
    shared_->requests.clear();
    for (const record::Record* record : records) {
      ReferenceRequest request{key_of(*record), record->factors, record->precision};
      if (kept.contains(request.key)) continue;
      const auto known = shared_->ready.find(request.key);
      if (known != shared_->ready.end())
        kept.insert(*known);
      else
        shared_->requests.push_back(std::move(request));
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
    shared->wake.wait(lock, [&] { return shared->stop || !shared->requests.empty(); });
    if (shared->stop) return;
    const ReferenceRequest request = shared->requests.front();
    lock.unlock();
    std::shared_ptr<const Reference> reference;
    try {
      reference = shared->reference(request);
    } catch (const std::exception& error) {
      reference = std::make_shared<const Reference>(Reference{.pair = {}, .error = error.what()});
    }
    lock.lock();
    // If the window now shows another configuration, this image is no longer needed.
    const auto done = std::ranges::find(shared->requests, request.key, &ReferenceRequest::key);
    if (done == shared->requests.end()) continue;
    shared->requests.erase(done);
    shared->ready.emplace(request.key, std::move(reference));
    const auto changed = shared->changed;
    lock.unlock();
    changed();
  }
}

}  // namespace triptych::view
