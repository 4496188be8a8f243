// The interactive controls: filters, and a dialog that compares two images with a slider. They are
// hidden until the script of the page shows them.

#include <fmt/format.h>

#include <set>

#include "report/html.hpp"
#include "report/page/page_sections.hpp"

namespace triptych::report {
namespace {

Html choice(std::string_view label, std::string_view name, const std::set<std::string>& values) {
  Html text = markup("<label>{} <select name=\"{}\"><option value=\"\">all</option>", label, name);
  for (const std::string& value : values) text += markup("<option>{}</option>", value);
  return text + markup("</select></label>");
}

}  // namespace

Html filters(std::span<const PlanData> plans) {
  std::set<std::string> devices;
  std::set<std::string> suites;
  std::set<std::string> checks;
  for (const PlanData& plan : plans) {
    for (const auto& [device, clocks] : plan.devices) devices.insert(device.id);
    suites.insert(suite_of(plan));
    for (const judge::Finding& finding : plan.verdict->findings) {
      checks.emplace(judge::topic_of(finding));
    }
  }
  return markup(
      "<form id=\"filters\" role=\"search\" aria-label=\"Filter\" hidden>{}{}{}"
      "<button type=\"reset\">Show all</button><output aria-live=\"polite\"></output></form>\n",
      choice("Device", "device", devices), choice("Suite", "suite", suites),
      choice("Check", "check", checks));
}

Html comparison_dialog() {
  return markup(
      "<dialog id=\"compare\" aria-labelledby=\"compared\"><h2 id=\"compared\">Compare</h2>"
      "<div class=\"choices\"><label>Left <select></select></label>"
      "<label>Right <select></select></label></div>"
      "<div class=\"view\"><div class=\"layer\"><img alt=\"\"><span class=\"mark\"></span></div>"
      "<div class=\"layer over\"><img alt=\"\"><span class=\"mark\"></span></div></div>"
      "<label class=\"border\">Border between the left and the right image "
      "<input type=\"range\" min=\"0\" max=\"100\" value=\"50\"></label>"
      "<div class=\"choices\"><button type=\"button\" class=\"zoom\" "
      "aria-pressed=\"false\">Zoom "
      "to the worst pixel</button><output aria-live=\"polite\"></output>"
      "<form method=\"dialog\"><button>Close</button></form></div></dialog>\n");
}

}  // namespace triptych::report
