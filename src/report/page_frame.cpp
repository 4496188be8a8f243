#include "report/page_frame.hpp"

#include <fmt/format.h>

#include "report/html.hpp"
#include "triptych_report_embedded.hpp"

namespace triptych::report {

std::string page_begin(std::string_view title, std::string_view heading, std::string_view lead) {
  std::string text =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">";
  text += fmt::format("<title>{}</title><style>", escape(title));
  text += embedded("style.css");
  text += "</style>\n";
  for (const std::string_view script : {"vega.min.js", "vega-lite.min.js", "vega-embed.min.js"}) {
    text += "<script>";
    text += embedded(script);
    text += "</script>\n";
  }
  return text + fmt::format("</head><body>\n<header><h1>{}</h1><p>{}</p></header>\n",
                            escape(heading), escape(lead));
}

std::string page_end() {
  return "</body></html>\n";
}

std::string chart(std::string_view id, std::string_view specification) {
  // Within a script "</script" ends it, and "<!--" with "<script" hides its end. JSON has "<" in
  // strings alone, where its number is the same text.
  std::string safe;
  for (const char c : specification) {
    if (c == '<') {
      safe += "\\u003c";
    } else {
      safe += c;
    }
  }
  return fmt::format(
      "<div class=\"chart\" id=\"{0}\"></div>"
      "<script>vegaEmbed('#{0}', {1}, {{actions: false, renderer: 'svg'}});</script>\n",
      id, safe);
}

}  // namespace triptych::report
