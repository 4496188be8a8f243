#include "report/html.hpp"

#include <gtest/gtest.h>

#include <array>

namespace triptych::report {
namespace {

TEST(Html, EscapesSpecialCharacters) {
  EXPECT_EQ(escape("a<b & \"c\">\x01"), "a&lt;b &amp; &quot;c&quot;&gt;\\x01");
}

TEST(Html, ShowsHiddenCharacters) {
  EXPECT_EQ(escape("\u202Egnp.exe\x1b\n"), "\\u{202e}gnp.exe\\x1b\n");
}

// Only literals are markup. All arguments are escaped automatically.
TEST(Html, MarkupEscapesItsArguments) {
  const std::string name = "<script>\"";
  const Html inner = markup("<b>{}</b>", name);
  EXPECT_EQ(inner.text(), "<b>&lt;script&gt;&quot;</b>");
  EXPECT_EQ(markup("<p id=\"{}\">{}{}</p>", name, inner, 3).text(),
            "<p id=\"&lt;script&gt;&quot;\"><b>&lt;script&gt;&quot;</b>3</p>");
  EXPECT_EQ(table({{name}, {inner}}).text(),
            "<div class=\"scroll\" tabindex=\"0\"><table "
            "class=\"\">\n<tr><th>&lt;script&gt;&quot;</th></tr>\n"
            "<tr><td><b>&lt;script&gt;&quot;</b></td></tr>\n</table></div>\n");
}

TEST(Html, MalformedTextIsReplaced) {
  EXPECT_EQ(escape("µ–\U0001F600"), "µ–\U0001F600");
  EXPECT_EQ(escape("a\xff<"), "a\uFFFD&lt;");
  EXPECT_EQ(escape("\xC2"), "\uFFFD");                      // truncated
  EXPECT_EQ(escape("\xC0\xBC"), "\uFFFD\uFFFD");            // '<' in an overlong encoding
  EXPECT_EQ(escape("\xED\xA0\x80"), "\uFFFD\uFFFD\uFFFD");  // half of a surrogate pair
  EXPECT_EQ(escape("\xEF\xBF\xBF"), "\\u{ffff}");           // not a valid character in XML
  EXPECT_EQ(escape("\xF5\x80\x80\x80"), "\uFFFD\uFFFD\uFFFD\uFFFD");
}

TEST(Html, AllowsLineBreaksBetweenParts) {
  EXPECT_EQ(breakable("gl:x,a=<1").text(), "gl:<wbr>x,<wbr>a=<wbr>&lt;1<wbr>");
  EXPECT_EQ(breakable("").text(), "");
}

// The examples are from RFC 4648, section 10.
TEST(Html, DataUriIsBase64) {
  const auto encoded = [](std::string_view text) {
    return data_uri(std::as_bytes(std::span(text.data(), text.size()))).text().substr(22);
  };
  EXPECT_EQ(encoded(""), "");
  EXPECT_EQ(encoded("f"), "Zg==");
  EXPECT_EQ(encoded("fo"), "Zm8=");
  EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
}

TEST(Html, DurationsHaveThreeDigits) {
  EXPECT_EQ(duration(999), "999 ns");
  EXPECT_EQ(duration(12345), "12.3 µs");
  EXPECT_EQ(duration(1234567), "1.23 ms");
  EXPECT_EQ(duration(2.5e9), "2.50 s");
}

TEST(Html, NumbersAreGrouped) {
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(1234567), "1\u2009234\u2009567");
}

TEST(Html, ColumnsOfQuantitiesAreFlushRight) {
  const std::string text =
      table({{"API", "time"}, {"4.5", "12.3 ms"}, {"3.1+debian", ""}, {"gl", "-0.01 ± 0.08"}})
          .text();
  EXPECT_NE(text.find("<td>4.5</td><td class=\"number\">12.3 ms"), std::string::npos) << text;
  EXPECT_NE(text.find("<td>gl</td><td class=\"number\">-0.01"), std::string::npos) << text;
  EXPECT_NE(text.find("<th>API</th><th class=\"number\">time"), std::string::npos) << text;
}

}  // namespace
}  // namespace triptych::report
