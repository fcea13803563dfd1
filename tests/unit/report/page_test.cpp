#include "report/page.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "report/page_parts.h"
#include "tyndall/error.h"

using namespace tyndall;
using nlohmann::ordered_json;

namespace {

constexpr const char* kHostile = "</script><b>&\"' <!-- {{script}}";

Image grey(int width, int height) {
  Image image;
  image.data = image.display = {0, 0, width, height};
  for (const char* name : {"R", "G", "B"})
    for (float& v : image.add_channel(name).values) v = 0.5f;
  return image;
}

/// What stands between the first `begin` and the next `end` after it.
std::string between(const std::string& text, const std::string& begin, const std::string& end) {
  const std::size_t start = text.find(begin);
  REQUIRE(start != std::string::npos);
  const std::size_t stop = text.find(end, start + begin.size());
  REQUIRE(stop != std::string::npos);
  return text.substr(start + begin.size(), stop - start - begin.size());
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (std::size_t i = text.find(what); i != std::string::npos; i = text.find(what, i + what.size())) ++n;
  return n;
}

const std::string kResultsBegin = "<script type=\"application/json\" id=\"results\">";

}  // namespace

TEST_CASE("results.json is in the page, equal to what was given") {
  const ordered_json results = {{"scene", "hall.pbrt"},
                                {"variants", {{{"name", kHostile}, {"relmse", 0.1 + 0.2}, {"slope", nullptr}}}}};
  const std::string page = compare_page(results, {});
  CHECK(ordered_json::parse(between(page, kResultsBegin, "</script>")) == results);
  CHECK(between(page, "<title>", "</title>") == "Tyndall: hall.pbrt");
}

TEST_CASE("a picture says what its values are, so that samples are not shown as light") {
  const ordered_json results = {{"scene", "hall.pbrt"}, {"variants", ordered_json::array()}};
  const std::string page =
      compare_page(results, {{"", "tree", grey(2, 2)}, {"", "tree samples", grey(2, 2), PagePicture::Kind::samples}});
  CHECK(between(page, "data-name=\"tree\" data-kind=\"", "\"") == "light");
  CHECK(between(page, "data-name=\"tree samples\" data-kind=\"", "\"") == "samples");
}

TEST_CASE("hostile names end neither a script nor an attribute nor the title") {
  const ordered_json results = {{"suite", kHostile}, {"cases", ordered_json::array()}};
  const std::string page = regress_page(results, {{kHostile, kHostile, grey(2, 2)}});
  CHECK(ordered_json::parse(between(page, kResultsBegin, "</script>")) == results);
  const std::string escaped = "&lt;/script&gt;&lt;b&gt;&amp;&quot;&#39; &lt;!-- {{script}}";
  CHECK(between(page, "<title>", "</title>") == "Tyndall: " + escaped);
  CHECK(between(page, "data-group=\"", "\"") == escaped);
  CHECK(between(page, "data-name=\"", "\"") == escaped);
  CHECK(count(page, "<b>") == 0);
  CHECK(count(page, "<!--") == 0);
  CHECK(count(page, "<script") == 3);
  CHECK(count(page, "</script") == 3);
}

TEST_CASE("broken UTF-8 and numbers that JSON lacks do not stop a page") {
  const ordered_json results = {{"scene", "a\xff.pbrt"}, {"seconds", std::nan("")}};
  const ordered_json read = ordered_json::parse(between(compare_page(results, {}), kResultsBegin, "</script>"));
  CHECK(read["scene"] == "a\xef\xbf\xbd.pbrt");
  CHECK(read["seconds"].is_null());
}

TEST_CASE("pictures are in the page with their names and sizes") {
  const std::string page = compare_page({{"scene", "s"}}, {{"", "reference", grey(5, 3)}, {"", "tree", grey(5, 3)}});
  CHECK(count(page, "class=\"picture\"") == 2);
  CHECK(count(page, "data-width=\"5\" data-height=\"3\"") == 2);
  CHECK(count(page, "data-name=\"tree\"") == 1);
  CHECK_THROWS_AS(compare_page({}, {{"", "empty", Image{}}}), Error);
}

TEST_CASE("a page is whole: every part is in it, and none asks for anything outside") {
  const std::string compare = compare_page({}, {}), all = compare + regress_page({}, {}) + live_page({}, "nonce");
  CHECK(count(all, "{{") == 0);
  CHECK(compare.rfind("<!doctype html>", 0) == 0);
  CHECK(compare.substr(compare.size() - 8) == "</html>\n");
  REQUIRE(page_parts().size() > 10);
  for (const PagePart& part : page_parts()) {
    CAPTURE(part.name);
    if (part.name != "page.html") CHECK(all.find(part.text) != std::string::npos);
  }
  for (const char* outside : {"https://", "src=", "@import", "url("}) CHECK(count(all, outside) == 0);
  CHECK(count(all, "http://") == 3);  // the name of SVG
  CHECK(count(all, "<script nonce=\"nonce\">") == 1);
}
