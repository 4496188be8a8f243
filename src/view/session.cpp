#include "view/session.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <utility>

#include "core/error.hpp"
#include "report/words/outcome.hpp"
#include "scene/free_view.hpp"
#include "view/view_command.hpp"

namespace triptych::view {
namespace {

// The camera counts as resting if the mouse has not moved it for this long.
constexpr std::chrono::milliseconds rest{250};

LiveOptions live_options(const measure::ViewRequest& request) {
  return {.program = request.program,
          .suite = request.suite,
          .faults = measure::parse_faults(request.faults),
          .limit = std::chrono::seconds(request.limit_s)};
}

// Returns the free view (azimuth, elevation and distance) that is nearest to a camera. Cameras such
// as "own" can be resolved only by the worker; for these, returns the free view for the default
// camera `default_camera`.
scene::FreeView view_of(const std::string& camera, const std::string& default_camera) {
  try {
    return scene::free_view_near(camera);
  } catch (const core::InputError&) {
    return scene::free_view_near(default_camera);
  }
}

}  // namespace

Session::Session(const measure::ViewRequest& request, Suites suites,
                 measure::InterruptGuard& interrupts, std::function<void()> changed)
    : request_(request),
      options_(live_options(request)),
      interrupts_(interrupts),
      changed_(std::move(changed)),
      suite_(std::move(suites.for_choices)),
      choices_(*suite_, request.configuration),
      references_(std::move(suites.for_references), changed_) {
  for (const measure::ViewSide& side : request.sides) columns_.push_back(make_column(side));
}

Column Session::make_column(const measure::ViewSide& side) {
  Column column;
  column.side = side;
  column.live = std::make_unique<LiveDevice>(side, options_, interrupts_, changed_);
  if (latest_request_.number > 0) column.live->draw(latest_request_);
  return column;
}

Session::~Session() {
  for (Column& each : columns_) retire(each);
  const bool drawing =
      std::ranges::any_of(retired_, [](const auto& each) { return each->state().drawing; });
  // Ends the threads that wait for a worker: each of them reacts to this signal
  // (measure::InterruptGuard). No other code handles the signal at this point.
  if (drawing) ::kill(::getpid(), SIGTERM);
}

void Session::retire(Column& column) {
  column.live->retire();
  retired_.push_back(std::move(column.live));
}

void Session::add_column(const measure::ViewSide& side) {
  columns_.push_back(make_column(side));
}

void Session::remove_column(std::size_t column) {
  retire(columns_.at(column));
  columns_.erase(columns_.begin() + static_cast<std::ptrdiff_t>(column));
  if (!against_) return;
  if (*against_ == column) {
    against_.reset();
  } else if (*against_ > column) {
    --*against_;
  }
}

void Session::set_side(std::size_t column, const measure::ViewSide& side) {
  retire(columns_.at(column));
  columns_.at(column) = make_column(side);
}

std::vector<measure::ViewSide> Session::sides() const {
  std::vector<measure::ViewSide> all;
  for (const record::Device& device : request_.devices) all.push_back({.device = device.id});
  for (const measure::ViewSide& side : request_.sides) {
    if (std::ranges::find(all, side) == all.end()) all.push_back(side);
  }
  return all;
}

void Session::set_camera(const std::string& camera, Clock::time_point now) {
  if (choices_.set("camera", camera).empty()) camera_rests_at_ = now + rest;
}

void Session::turn(double right, double down, Clock::time_point now) {
  const scene::FreeView view = view_of(choices_.value("camera"), choices_.default_level("camera"));
  set_camera(scene::camera_of(scene::turned(view, right, down)), now);
}

void Session::approach(double notches, Clock::time_point now) {
  const scene::FreeView view = view_of(choices_.value("camera"), choices_.default_level("camera"));
  set_camera(scene::camera_of(scene::approached(view, notches)), now);
}

void Session::request_frames(bool moving) {
  latest_request_ = {.number = latest_request_.number + 1,
                     .configuration = choices_.configuration(),
                     .key = choices_.key(),
                     .moving = moving};
  for (Column& each : columns_) each.live->draw(latest_request_);
}

bool Session::collect_frame(Column& column) {
  LiveDevice::State state = column.live->state();
  const bool changed = state.drawn != column.shown || state.drawing != column.state.drawing ||
                       state.loading.has_value() || column.state.loading.has_value();
  column.state = std::move(state);
  if (column.state.drawn != column.shown) {
    column.shown = column.state.drawn;
    column.reference.reset();
  }
  return changed;
}

bool Session::update(Clock::time_point now) {
  const bool moving = camera_rests_at_ && now < *camera_rests_at_;
  if (!moving) camera_rests_at_.reset();
  if (choices_.configuration() != latest_request_.configuration ||
      (latest_request_.moving && !moving))
    request_frames(moving);
  std::erase_if(retired_, [](const auto& each) { return each->has_exited(); });
  bool changed = false;
  std::vector<const record::Record*> judged;
  for (Column& each : columns_) {
    changed = collect_frame(each) || changed;
    if (each.shown && each.shown->has_image() && !each.shown->request.moving) {
      judged.push_back(&each.shown->record);
    }
  }
  references_.show(judged);
  for (Column& each : columns_) {
    if (each.shown && !each.reference) each.reference = references_.find(each.shown->record);
  }
  for (std::size_t i = 0; i < columns_.size(); ++i) changed = refresh_error(i) || changed;
  return changed;
}

std::optional<Session::Clock::time_point> Session::next_update() const {
  return camera_rests_at_;
}

// Returns the reason why a column cannot be compared, or an empty string if it can be compared.
std::string Session::why_not_compared(std::size_t index) const {
  const Column& column = columns_[index];
  if (!column.shown || !column.shown->has_image()) return "no image";
  if (column.shown->request.moving) return "the camera is moving";
  if (against_ == index) return "the other devices are compared with this one";
  const auto wait_for = [](const Column& each) -> std::string {
    if (!each.reference) return "the reference image is being rendered";
    return each.reference->error.empty() ? "" : "no reference image: " + each.reference->error;
  };
  if (std::string waiting = wait_for(column); !waiting.empty()) return waiting;
  if (!against_) return {};
  const Column& other = columns_[*against_];
  if (!other.shown || other.shown->request.number != column.shown->request.number) {
    return fmt::format("waiting for the frame from {}", other.side.device);
  }
  if (!other.shown->has_image()) return fmt::format("no image from {}", other.side.device);
  return wait_for(other);
}

bool Session::refresh_error(std::size_t index) {
  Column& column = columns_[index];
  std::string why = why_not_compared(index);
  if (!why.empty()) {
    const bool changed = column.error != nullptr || why != column.why_no_error;
    column.error.reset();
    column.inputs = {};
    column.why_no_error = std::move(why);
    return changed;
  }
  const Column* other = against_ ? &columns_[*against_] : nullptr;
  const Column::Inputs inputs{
      .frame = column.shown.get(),
      .reference = column.reference.get(),
      .other_frame = other == nullptr ? nullptr : other->shown.get(),
      .other_reference = other == nullptr ? nullptr : other->reference.get()};
  if (column.error && inputs == column.inputs) return false;
  const core::Image& image = column.shown->image;
  const accuracy::TruthPair& pair = column.reference->pair;
  try {
    column.error = std::make_shared<const ShownError>(
        other == nullptr
            ? shown_error(image, pair.truth, pair.bound, "")
            : shown_error(image, other->shown->image, bound_between(pair, other->reference->pair),
                          other->side.device));
    column.why_no_error.clear();
  } catch (const core::Error& error) {
    column.error.reset();
    column.why_no_error = error.what();
  }
  column.inputs = inputs;
  return true;
}

bool Session::is_settled() const {
  return !camera_rests_at_ && std::ranges::all_of(columns_, [&](const Column& each) {
    if (!each.shown || each.shown->request.number != latest_request_.number) return false;
    const bool is_waiting = each.shown->has_image() && !each.reference;
    return !is_waiting;
  });
}

std::string Session::command(const Column& column, std::optional<std::pair<int, int>> pixel) const {
  const std::string key = column.shown ? column.shown->request.key : choices_.key();
  return render_command(request_, column.side, key, pixel);
}

}  // namespace triptych::view
