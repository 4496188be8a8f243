#include "report/page/page_frame.hpp"

#include "triptych_report_embedded.hpp"

namespace triptych::report {

namespace {

// Allows only content of the page itself. Inline styles are allowed, because the widths of bars are
// style attributes, which a policy cannot identify by a hash.
Html policy() {
  return markup(
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
      "style-src 'unsafe-inline'; script-src 'sha256-{}'; base-uri 'none'; form-action 'none'\">",
      embedded_sha256("page.js"));
}

}  // namespace

Html page_begin(std::string_view title) {
  return markup(
             "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
             "{}<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"
             "<title>{}</title><link rel=\"icon\" href=\"data:,\"><style>",
             policy(), title) +
         embedded_markup("style.css") + markup("</style></head><body>\n");
}

Html page_end() {
  return markup("<script>{}</script></body></html>\n", embedded_markup("page.js"));
}

Html folded(const Content& summary, const Html& body) {
  if (body.empty()) return {};
  return markup("<details><summary>{}</summary>{}</details>\n", summary.html(), body);
}

}  // namespace triptych::report
