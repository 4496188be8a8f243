#include "backends/gl/program_code.hpp"

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "measure/code/compiled_code.hpp"

namespace triptych::gl_backend {
namespace {

// radeonsi names the stage at the end of a line of statistics: "… (PS, W64)".
constexpr std::array<std::pair<std::string_view, GLenum>, 6> stage_codes{{
    {"(VS", GL_VERTEX_SHADER},
    {"(TCS", GL_TESS_CONTROL_SHADER},
    {"(TES", GL_TESS_EVALUATION_SHADER},
    {"(GS", GL_GEOMETRY_SHADER},
    {"(PS", GL_FRAGMENT_SHADER},
    {"(CS", GL_COMPUTE_SHADER},
}};

// Returns the name of the shader that a line of statistics describes.
std::string shader_of(const Api::Report& report) {
  const std::size_t at = report.text.rfind('(');
  const std::string_view code =
      at == std::string::npos ? std::string_view() : std::string_view(report.text).substr(at);
  for (const auto& [start, type] : stage_codes) {
    if (!code.starts_with(start)) continue;
    for (const Api::LinkedStage& stage : report.program) {
      if (stage.type == type) return stage.name;
    }
  }
  return report.program.empty() ? "program" : report.program.front().name;
}

// Parses radeonsi's "Shader Stats: SGPRS: 32 VGPRS: 16 …" and Intel's "FS SIMD16 shader: 55 inst,
// …". Returns an empty map for any other message.
std::map<std::string, double> statistics_of(const std::string& text) {
  if (text.starts_with("Shader Stats:")) return measure::parse_statistics(text);
  if (const std::size_t at = text.find(" shader: "); at != std::string::npos) {
    return measure::parse_counts(text.substr(at));
  }
  return {};
}

// A line of statistics and the disassembly that follows it.
struct Reported {
  std::string name;
  std::map<std::string, double> statistics;
  std::string assembly;
};

}  // namespace

measure::Compiled code_of(std::span<const Api::Report> reports) {
  measure::CompiledCode code;
  std::optional<Reported> reported;
  bool disassembles = false;
  const auto finish = [&] {
    if (!reported) return;
    code.add(reported->name, std::move(reported->statistics), std::move(reported->assembly));
    reported.reset();
  };
  for (const Api::Report& report : reports) {
    if (report.text.starts_with("Shader Disassembly Begin")) {
      disassembles = true;
    } else if (report.text.starts_with("Shader Disassembly End")) {
      disassembles = false;
    } else if (disassembles) {
      if (reported) reported->assembly += report.text + "\n";
    } else if (auto statistics = statistics_of(report.text); !statistics.empty()) {
      finish();
      reported = {shader_of(report), std::move(statistics), {}};
    }
  }
  finish();
  return code.take();
}

}  // namespace triptych::gl_backend
