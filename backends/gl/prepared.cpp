#include "backends/gl/prepared.hpp"

#include <utility>

#include "core/error.hpp"
#include "core/hash.hpp"

namespace triptych::gl_backend {
namespace {

class DrawingPrepared final : public measure::Prepared, public measure::PixelTracer {
 public:
  DrawingPrepared(Context& context, Stamps stamps, std::unique_ptr<Drawing> drawing)
      : context_(context),
        owned_(std::make_unique<Owned>(context.gl(), stamps, std::move(drawing))) {}

  DrawingPrepared(const DrawingPrepared&) = delete;
  DrawingPrepared& operator=(const DrawingPrepared&) = delete;
  ~DrawingPrepared() override {
    try {
      const Current current(context_);
      owned_.reset();
    } catch (const core::Error&) {
      // The context is lost together with its objects, so there is nothing to delete.
      static_cast<void>(owned_.release());
    }
  }

  void poison() override {
    const Current current(context_);
    const Api& gl = context_.gl();
    owned_->drawing->poison(gl);
    gl.check("poison");
  }

  [[nodiscard]] measure::Frame frame(measure::Purpose purpose) override {
    const Current current(context_);
    const Api& gl = context_.gl();
    Drawing& drawing = *owned_->drawing;
    drawing.bind(gl, purpose);
    gl.check("bind");

    measure::Frame frame;
    const auto draw = [&] {
      const Label label(gl, "frame");
      const Elapsed elapsed = owned_->stopwatch.time([&] { drawing.submit(gl, purpose); });
      frame.wall_ns = elapsed.wall_ns;
      if (purpose == measure::Purpose::timing) frame.device_ns = elapsed.device_ns;
    };
    if (purpose == measure::Purpose::statistics) {
      frame.counts = owned_->statistics.count(draw);
    } else {
      draw();
    }
    gl.check("frame");
    if (purpose == measure::Purpose::counters) frame.counts = drawing.counters(gl);
    return frame;
  }

  [[nodiscard]] core::Image image() override {
    const Current current(context_);
    return owned_->drawing->read(context_.gl());
  }

  [[nodiscard]] std::string kernel_hash() const override { return owned_->drawing->kernel_hash(); }

  [[nodiscard]] technique::RayTrace trace(int x, int y) override {
    const Current current(context_);
    const Api& gl = context_.gl();
    technique::RayTrace trace = owned_->drawing->trace(gl, x, y);
    gl.check("trace");
    return trace;
  }

 private:
  // All objects that exist on the device.
  struct Owned {
    Owned(const Api& gl, Stamps stamps, std::unique_ptr<Drawing> owned_drawing)
        : drawing(std::move(owned_drawing)),
          stopwatch(gl, stamps),
          statistics(gl, drawing->statistics()) {}
    std::unique_ptr<Drawing> drawing;
    Stopwatch stopwatch;
    Statistics statistics;
  };

  Context& context_;
  std::unique_ptr<Owned> owned_;
};

}  // namespace

std::unique_ptr<measure::Prepared> make_prepared(Context& context, Stamps stamps,
                                                 std::unique_ptr<Drawing> drawing) {
  return std::make_unique<DrawingPrepared>(context, stamps, std::move(drawing));
}

std::string hash_of(const Api& gl, std::span<const std::string> sources) {
  std::string hashed = gl.text(GL_VERSION);
  for (const std::string& source : sources) hashed += '\n' + source;
  return core::content_hash(hashed);
}

}  // namespace triptych::gl_backend
