#include "report/page/page.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <regex>
#include <set>

#include "scripted_store.hpp"
#include "support/temporary_folder.hpp"
#include "support/well_formed.hpp"

namespace triptych::report {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string page_of(bool wrong, const std::string& factor = "step") {
  const test::TemporaryFolder folder;
  return ScriptedStore(folder.path() / "s.sqlite", wrong, factor).page();
}

std::string before(const std::string& page, std::string_view what) {
  return page.substr(0, page.find(what));
}

TEST(Page, OfAPassShowsVerdictRowsAndImages) {
  const std::string page = page_of(false);
  EXPECT_THAT(page, HasSubstr("<header id=\"verdict\" class=\"pass\"><h1>PASS (0)</h1>"));
  EXPECT_THAT(page, HasSubstr("16 within their error bounds"));
  EXPECT_THAT(page, Not(HasSubstr("id=\"findings\"")));
  // For each of two scenes, three images are visible: the reference, a rendered image and the
  // difference.
  const std::string open = before(page.substr(page.find("id=\"images\"")), "<details>");
  int images = 0;
  for (auto at = open.find("<img "); at != std::string::npos; at = open.find("<img ", at + 1)) {
    ++images;
  }
  EXPECT_EQ(images, 6);
  EXPECT_LT(page.size(), 2'000'000U);
}

TEST(Page, OfAFailureBeginsWithCausesCommandsAndWrongImages) {
  const std::string page = page_of(true);
  EXPECT_THAT(page, HasSubstr("<h1>FAIL (1)</h1>"));
  const std::string findings = before(page.substr(page.find("id=\"findings\"")), "id=\"images\"");
  EXPECT_LT(findings.find("crashed: the worker was killed by SIGSEGV"),
            findings.find("811 of 2304"));
  EXPECT_THAT(findings, HasSubstr("(3 configurations)"));
  EXPECT_THAT(findings, HasSubstr("<pre><span>triptych render volume</span> <span>--device "
                                  "vulkan:lavapipe</span> <span>--set data=ball"));
  const std::string open = before(page.substr(page.find("id=\"images\"")), "<details>");
  EXPECT_THAT(open, HasSubstr("aria-label=\"vulkan:lavapipe: crashed, no image\">crashed</div>"));
  EXPECT_THAT(open, Not(HasSubstr("within the error bound")));
}

TEST(Page, EveryLinkHasATarget) {
  const std::string page = page_of(true);
  const std::regex link("href=\"#([^\"]+)\"");
  int seen = 0;
  for (std::sregex_iterator at(page.begin(), page.end(), link), end; at != end; ++at, ++seen) {
    EXPECT_THAT(page, HasSubstr("id=\"" + (*at)[1].str() + "\""));
  }
  EXPECT_GE(seen, 3);
}

TEST(Page, ShowsCostAndTimesNextToStoredValues) {
  EXPECT_THAT(page_of(false),
              HasSubstr("<p>All 16 frames execute the stored number of instructions.</p>"));
  const std::string page = page_of(true);
  EXPECT_THAT(page,
              HasSubstr("<p>4 of 15 frames do not execute the stored number of instructions.</p>"));
  EXPECT_THAT(page, HasSubstr("<td class=\"number\">968\u2009288 → 987\u2009654</td>"));
  EXPECT_THAT(page, HasSubstr("<span class=\"bar more\" style=\"width:100.0%\">"));
  EXPECT_THAT(page, HasSubstr("<td class=\"number\">-10.00 %</td><td><span class=\"bar less\""));
}

// If an image is wrong, its finding also reports its wrong counters. Therefore the finding has both
// checks, `counters` and `image`, so that the filter for either check shows it.
TEST(Page, ListsEveryValueThatDiffersFromTheStoredOne) {
  const std::string page = page_of(true);
  const std::string table = page.substr(page.find("data-kind=\"values\" data-check=\"counters\""));
  EXPECT_THAT(table, HasSubstr("counters: 3 of the stored values differ"));
  EXPECT_THAT(table, HasSubstr("<td>samples</td><td class=\"number\">3</td><td class=\"number\">4"
                               "</td><td class=\"number\">+33.33 %</td>"));
  EXPECT_THAT(page, HasSubstr("data-check=\"counters image\""));
  EXPECT_THAT(page_of(false), Not(HasSubstr("data-kind=\"values\"")));
}

// A single pixel is easily overlooked, and not all readers can distinguish the same colours.
TEST(Page, RingsPixelsBeyondTheirBound) {
  EXPECT_THAT(page_of(true), HasSubstr("<circle class=\"over\""));
  EXPECT_THAT(page_of(false), Not(HasSubstr("<circle class=\"over\"")));
}

TEST(Page, StatesWhatWasTested) {
  const std::string page = page_of(false);
  EXPECT_THAT(page, HasSubstr("<dt>machine</dt><dd><div>two cores</div></dd>"));
  EXPECT_THAT(page, HasSubstr("<dt>measured</dt><dd><div>2026-01-02T03:04:05Z</div></dd>"));
  EXPECT_THAT(page, HasSubstr("<div>vulkan:lavapipe: d 1</div>"));
  EXPECT_THAT(page, HasSubstr("<span>triptych gate volume/quick</span> <span>--measure</span>"));
}

TEST(Page, ExplainsItsTerms) {
  const std::string page = page_of(true);
  for (const char* word : {"reference image", "bound", "limit", "front"}) {
    EXPECT_THAT(page, HasSubstr(fmt::format("<td>{}</td>", word)));
  }
}

TEST(Page, ShowsTheShareOfNecessaryWork) {
  const std::string page = page_of(false);
  const std::string row =
      "<td>distance</td><td class=\"number\">123\u2009456</td><td class=\"number\">92\u2009592</td>"
      "<td class=\"number\">0.750</td>";
  EXPECT_THAT(page, HasSubstr(row));
  const std::string devices = before(page.substr(page.find(row) + row.size()), "</tr>");
  EXPECT_THAT(devices, HasSubstr(", "));  // all devices did the same work, so they share a row
}

TEST(Page, NeedsNoNetwork) {
  const std::string page = page_of(true);
  EXPECT_THAT(page, Not(HasSubstr("src=\"http")));
  EXPECT_THAT(page, Not(HasSubstr("href=\"http")));
}

// Each reference image is embedded only once in the page.
TEST(Page, ContainsEachImageOnce) {
  const std::string page = page_of(false);
  std::set<std::string> seen;
  const std::regex source("src=\"(data:image[^\"]+)\"");
  for (std::sregex_iterator at(page.begin(), page.end(), source), end; at != end; ++at) {
    EXPECT_TRUE(seen.insert((*at)[1].str()).second);
  }
  EXPECT_THAT(page, HasSubstr("<img data-same=\"0\""));
}

// A plan can contain any factor name, even one with markup. The page must escape it.
TEST(Page, EscapesMarkup) {
  const std::string page = page_of(true, "<script>\"&\x1b");
  EXPECT_EQ(page.find("<script"), page.rfind("<script"));  // the only script is the page's own
  EXPECT_EQ(page.find('\x1b'), std::string::npos);
}

}  // namespace
}  // namespace triptych::report
