#include "backends/gl/timing.hpp"

#include <chrono>
#include <string>

#include "core/error.hpp"

namespace triptych::gl_backend {
namespace {

double now_ns() {
  using namespace std::chrono;
  return duration<double, std::nano>(steady_clock::now().time_since_epoch()).count();
}

GLuint64 result_of(const Api& gl, const Query& query) {
  GLuint64 value = 0;
  gl.GetQueryObjectui64v(query.get(), GL_QUERY_RESULT, &value);
  return value;
}

}  // namespace

void wait_for_device(const Api& gl) {
  constexpr GLuint64 one_second_ns = 1'000'000'000;
  const Fence fence(gl, gl.FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0));
  if (fence.get() == nullptr) {
    gl.check("glFenceSync");
    throw core::ApiError("glFenceSync", "no fence");
  }
  for (;;) {
    const GLenum state = gl.ClientWaitSync(fence.get(), GL_SYNC_FLUSH_COMMANDS_BIT, one_second_ns);
    if (state == GL_ALREADY_SIGNALED || state == GL_CONDITION_SATISFIED) return;
    gl.check("glClientWaitSync");
    if (state == GL_WAIT_FAILED) throw core::ApiError("glClientWaitSync", "GL_WAIT_FAILED");
  }
}

Stopwatch::Stopwatch(const Api& gl, Stamps stamps)
    : gl_(&gl), stamps_(stamps), begin_(gl), end_(gl) {
  GLint bits = 0;
  gl.GetQueryiv(GL_TIMESTAMP, GL_QUERY_COUNTER_BITS, &bits);
  has_clock_ = bits > 0;
  gl.check("glGetQueryiv");
}

void Stopwatch::start() {
  started_ns_ = now_ns();
  if (!has_clock_) return;
  gl_->QueryCounter(begin_.get(), GL_TIMESTAMP);
  if (stamps_ == Stamps::finished) gl_->Finish();
}

Elapsed Stopwatch::stop() {
  if (has_clock_) {
    if (stamps_ == Stamps::finished) gl_->Finish();
    gl_->QueryCounter(end_.get(), GL_TIMESTAMP);
  }
  wait_for_device(*gl_);
  Elapsed elapsed{now_ns() - started_ns_, std::nullopt};
  if (has_clock_) {
    const GLuint64 begin = result_of(*gl_, begin_);
    const GLuint64 end = result_of(*gl_, end_);
    if (end >= begin) elapsed.device_ns = static_cast<double>(end - begin);
  }
  gl_->check("glQueryCounter");
  return elapsed;
}

Statistics::Statistics(const Api& gl, std::span<const Statistic> wanted) : gl_(&gl) {
  if (gl.ARB_pipeline_statistics_query == 0) return;
  for (const Statistic& each : wanted) {
    GLint bits = 0;
    gl.GetQueryiv(each.target, GL_QUERY_COUNTER_BITS, &bits);
    if (bits > 0) queries_.push_back({each, Query(gl)});
  }
  gl.check("glGetQueryiv");
}

void Statistics::begin() {
  for (const ActiveQuery& each : queries_) gl_->BeginQuery(each.statistic.target, each.query.get());
}

record::Counts Statistics::end() {
  for (const ActiveQuery& each : queries_) gl_->EndQuery(each.statistic.target);
  record::Counts counts;
  for (const ActiveQuery& each : queries_) {
    counts.emplace(std::string(each.statistic.name), result_of(*gl_, each.query));
  }
  gl_->check("glEndQuery");
  return counts;
}

}  // namespace triptych::gl_backend
