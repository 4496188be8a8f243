#include "report/page_frame.hpp"

#include <fmt/format.h>

#include "report/html.hpp"
#include "triptych_report_embedded.hpp"

namespace triptych::report {

std::string page_begin(std::string_view title) {
  std::string text =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">";
  text += fmt::format("<title>{}</title><link rel=\"icon\" href=\"data:,\"><style>", escape(title));
  text += embedded("style.css");
  return text + "</style></head><body>\n";
}

std::string page_end(std::string_view script) {
  if (script.empty()) return "</body></html>\n";
  return fmt::format("<script>{}</script></body></html>\n", script);
}

std::string folded(std::string_view summary, const std::string& body) {
  if (body.empty()) return {};
  return fmt::format("<details><summary>{}</summary>{}</details>\n", summary, body);
}

}  // namespace triptych::report
