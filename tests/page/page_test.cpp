// The page as a whole: what it needs, what it leaves, what it does with hostile words.

#include "page/page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <regex>

#include "page/a_film.h"
#include "scratch.h"

namespace bookspin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

const fs::path real_templates = fs::path(BOOKSPIN_SOURCE_DIR) / "videos" / "page";

struct Page : testing::Test {
  Page() {
    for (const auto& entry : fs::directory_iterator(real_templates)) {
      fs::create_directories(scratch / "templates");
      fs::copy_file(entry.path(), scratch / ("templates/" + entry.path().filename().string()));
    }
    fs::create_directories(scratch / "site");
    write_text(scratch / "templates/template.html",
               "{{#story}}<main>{{film a: tilt}}</main>{{/story}}{{#more}}<li>{{{html}}}</li>{{/more}}"
               "<s>{{{behavior}}}</s>");
    put("a", a_film());
  }
  void put(const std::string& name, json film) {
    film["poster"] = name + ".png";
    film["film"] = name + ".mp4";
    write_text(scratch / ("site/" + name + ".json"), film.dump());
    write_text(scratch / ("site/" + name + ".png"), "picture");
    write_text(scratch / ("site/" + name + ".mp4"), "film");
  }
  std::string made() {
    write_page({scratch / "site", scratch / "templates"});
    return read_text(scratch / "site/index.html");
  }
  std::string message() {
    try {
      made();
      return "made";
    } catch (const std::exception& error) {
      return error.what();
    }
  }
  Scratch scratch;
};

TEST_F(Page, AFilmStandsInItsPlaceAndOthersFollow) {
  put("b", a_film());
  const std::string html = made();
  EXPECT_THAT(html, HasSubstr("<main><article class=\"film\" id=\"a\""));
  EXPECT_THAT(html, HasSubstr("<li><article class=\"film\" id=\"b\""));
}

TEST_F(Page, TheStoryIsToldWhenHalfOfItsFilmsAreThere) {
  const auto places = [this](const std::string& names) {
    write_text(scratch / "templates/template.html",
               "{{#story}}<main>" + names + "</main>{{/story}}{{#more}}<li>{{{html}}}</li>{{/more}}");
  };
  places("{{film a}}{{film b}}");
  EXPECT_THAT(made(), HasSubstr("<main><article class=\"film\" id=\"a\""));
  EXPECT_THAT(made(), HasSubstr("<code>bookspin render b.toml</code> makes it"));
  EXPECT_THAT(made(), Not(HasSubstr("<li><article")));
  places("{{film a}}{{film b}}{{film c}}");
  EXPECT_THAT(made(), Not(HasSubstr("<main>")));
  EXPECT_THAT(made(), HasSubstr("<li><article class=\"film\" id=\"a\""));
}

TEST_F(Page, AStrangersFilmsHaveAPageOfTheirOwn) {
  fs::copy_file(real_templates / "template.html", scratch / "templates/template.html",
                fs::copy_options::overwrite_existing);
  put("b", a_film());
  write_text(scratch / "site/other.json", "{\"format\": \"GeoJSON\"}");
  const std::string html = made();
  EXPECT_THAT(html, HasSubstr("<title>Films of a tumbling book</title>"));
  EXPECT_THAT(html, HasSubstr("<li><a href=\"#a\">A film</a></li>"));
  EXPECT_THAT(html, testing::ContainsRegex("The films</h2>\n<article class=\"film\" id=\"a\""));
  for (const char* of_the_paper : {"Postma", "Introduction", "render fig", "class=\"number\""}) {
    EXPECT_THAT(html, Not(HasSubstr(of_the_paper)));
  }
}

TEST_F(Page, ANameIsGoodInAnAddressWhateverItIs) {
  fs::remove(scratch / "site/a.json");
  put("my film#2: 50%", a_film());
  const std::string html = made();
  EXPECT_THAT(html, HasSubstr("id=\"my%20film%232%3A%2050%25\""));
  EXPECT_THAT(html, HasSubstr("src=\"my%20film%232%3A%2050%25.mp4\""));
  EXPECT_THAT(html, HasSubstr("<code>my film#2: 50%.toml</code>"));
}

TEST_F(Page, AFilmHasAllThatAReaderNeeds) {
  const std::string html = made();
  EXPECT_THAT(html, HasSubstr("src=\"a.mp4\""));
  EXPECT_THAT(html, HasSubstr("1 of 1 claims hold, measured"));
  EXPECT_THAT(html, HasSubstr("Flips so far 1 <a href=\"a.mp4#t=1.900\" data-time=\"1.900\">at t = 10</a>"));
  EXPECT_THAT(html,
              HasSubstr("<a href=\"a.mp4#t=1.000\" data-time=\"1.000\">t = 5</a> <span>The book has turned over."));
  EXPECT_THAT(html, HasSubstr("<a href=\"a.mp4\" download>"));
  EXPECT_THAT(html, HasSubstr("<a href=\"a.vtt\" download>"));
  EXPECT_THAT(html, HasSubstr("src=&quot;a.vtt&quot;"));  // in the snippet
  EXPECT_THAT(html, HasSubstr("data:text/vtt;charset=utf-8,WEBVTT%0A%0A00%3A00%3A00.000"));
  EXPECT_THAT(read_text(scratch / "site/a.vtt"),
              HasSubstr("\n00:00:01.000 --> 00:00:02.000\nThe book has turned over.\n"));
  EXPECT_THAT(html, HasSubstr("title = &quot;A film&quot;"));
}

TEST_F(Page, WordsStayWords) {
  json film = a_film();
  film["title"] = R"(</script><script>alert("1 < 2")</script> & 'more')";
  film["caption"] = "</figcaption>{{script}}<img src=x onerror=alert(1)>";
  film["script"] = "# </pre></textarea><b>\"&amp;\"</b>";
  film["expectations"][0]["says"] = "<i>it</i> --> & turns";
  put("a", film);
  const std::string html = made();
  EXPECT_THAT(html, Not(HasSubstr("<script>")));
  EXPECT_THAT(html, Not(HasSubstr("<img src=x")));
  EXPECT_THAT(html, Not(HasSubstr("</textarea>")));
  EXPECT_THAT(html, Not(HasSubstr("<i>it")));
  EXPECT_THAT(html, HasSubstr("# &lt;/pre&gt;&lt;/textarea&gt;&lt;b&gt;&quot;&amp;amp;&quot;&lt;/b&gt;"));
  EXPECT_THAT(html, HasSubstr("&lt;i&gt;it&lt;/i&gt; --&gt; &amp; turns"));
  EXPECT_THAT(html, HasSubstr("{{script}}"));               // data is not a template
  EXPECT_THAT(html, HasSubstr("&amp;lt;/script&amp;gt;"));  // in the snippet, which is shown as text: escaped twice
}

TEST_F(Page, WhatIsFoundIsReadable) {
  json film = a_film();
  json& e = film["expectations"][0];
  const auto with = [&](const char* quantity, const json& found) {
    e["quantity"] = quantity;
    e["found"] = found;
    put("a", film);
    return made();
  };
  EXPECT_THAT(with("tilt", 177.93), HasSubstr("Tilt of the spin axis 178° <a"));
  EXPECT_THAT(with("stretch", 0.000563), HasSubstr("Stretch 0.0563 % <a"));
  EXPECT_THAT(with("energy_ratio", 4.44e-16), HasSubstr("Energy E/E₀ 4 × 10⁻¹⁶ <a"));
  EXPECT_THAT(with("angle_error", nullptr), HasSubstr("<small> <a"));
  EXPECT_THAT(with("exploded", 1), HasSubstr("<small> <a"));  // the film does not have it
}

TEST_F(Page, AMomentThatWasNotFilmedIsNoLink) {
  json film = a_film();
  film["clip"]["drawn_frames"] = 10;
  put("a", film);
  EXPECT_THAT(made(), Not(HasSubstr("at t = 10")));
}

TEST_F(Page, AnUnmetClaimIsShownAsOne) {
  json film = a_film();
  film["expectations"][0]["met"] = false;
  put("a", film);
  EXPECT_THAT(made(), HasSubstr("0 of 1 claims hold, measured"));
  EXPECT_THAT(made(), HasSubstr("Does not hold:"));
}

TEST_F(Page, TwoBoundsUnderTheSameWordsAreOneClaim) {
  json film = a_film();
  film["expectations"].push_back({{"says", "it turns over"},
                                  {"quantity", "flips"},
                                  {"text", "flips at most 2: found 1"},
                                  {"met", true},
                                  {"found", 1},
                                  {"frame", 19}});
  put("a", film);
  const std::string html = made();
  EXPECT_THAT(html, HasSubstr("1 of 1 claims hold, measured"));
  EXPECT_EQ(html.find("Flips so far 1"), html.rfind("Flips so far 1"));  // found once
  film["expectations"][1]["met"] = false;
  put("a", film);
  EXPECT_THAT(made(), HasSubstr("0 of 1 claims hold, measured"));
}

TEST_F(Page, AMissingProductIsNamed) {
  for (const char* product : {"a.mp4", "a.png"}) {
    fs::remove(scratch / ("site/" + std::string(product)));
    EXPECT_THAT(message(), HasSubstr((scratch / ("site/" + std::string(product))).string() +
                                     ": is missing; `bookspin render a.toml`"));
    put("a", a_film());
  }
  EXPECT_FALSE(fs::exists(scratch / "site/index.html"));
}

TEST_F(Page, AFolderWithoutFilmsIsNamed) {
  fs::remove(scratch / "site/a.json");
  EXPECT_THAT(message(), HasSubstr("site: holds no films; `bookspin render SCENE.toml -o "));
  fs::remove_all(scratch / "site");
  EXPECT_THAT(message(), HasSubstr("site: cannot be listed: No such file or directory"));
}

TEST_F(Page, AFailureLeavesTheOldPage) {
  const std::string old = made();
  json broken = a_film();
  broken.erase("title");
  write_text(scratch / "site/lost.json", broken.dump());
  EXPECT_THAT(message(), HasSubstr("lost.json: title: is missing"));
  fs::remove(scratch / "site/lost.json");
  write_text(scratch / "templates/template.html", "{{unknown}}");
  EXPECT_THAT(message(), HasSubstr("template.html:1: nothing is known as 'unknown'"));
  EXPECT_EQ(read_text(scratch / "site/index.html"), old);
  fs::remove(scratch / "site/index.html");
  fs::create_directory(scratch / "site/index.html");
  write_text(scratch / "templates/template.html", "new");
  EXPECT_THAT(message(), HasSubstr("index.html: cannot be replaced: is a folder"));
}

TEST_F(Page, TheSameFilmsGiveTheSameBytesAndNothingElseIsLeft) {
  const std::string once = made();
  EXPECT_EQ(made(), once);
  EXPECT_EQ(std::distance(fs::directory_iterator(scratch / "site"), fs::directory_iterator()),
            6);  // page, film, poster, data, captions, and the list of bookspin's files
}

TEST_F(Page, TheReportIsLinkedWhenThereIsOne) {
  fs::copy_file(real_templates / "template.html", scratch / "templates/template.html",
                fs::copy_options::overwrite_existing);
  EXPECT_THAT(made(), Not(HasSubstr("report/index.html")));
  fs::create_directories(scratch / "site/report");
  write_text(scratch / "site/report/index.html", "");
  EXPECT_THAT(made(), HasSubstr("<a href=\"report/index.html\">"));
}

TEST_F(Page, TheReportsSpeedIsShown) {
  write_text(scratch / "templates/template.html",
             "{{#speed}}{{processor}}{{#quick}}, quick{{/quick}}:{{#rows}}{{method}}{{#cells}} "
             "{{.}}{{/cells}};{{/rows}}{{/speed}}");
  EXPECT_EQ(made(), "");
  fs::create_directories(scratch / "site/report");
  const fs::path report = scratch / "site/report/report.json";
  write_text(report, R"({"processor": "P", "quick": true, "cheapest_a": [{"method": "rk4", "ns at 1e-2": 22.61,
                     "ns at 1e-6": 1175.8, "ns at 1e-9": "never", "best error": 1.4e-9}, {"method": "exact"}]})");
  EXPECT_EQ(made(), "P, quick:rk4 22.6 1176 never 1 × 10⁻⁹;exact never never never never;");
  for (const char* other : {"", "[]", "{\"cheapest\": 1}"}) {
    write_text(report, other);
    EXPECT_EQ(made(), "") << other;
  }
}

// The page that is shipped: every script of the project has its place, and nothing is loaded from elsewhere.
TEST(PageTemplate, HasAPlaceForEveryScript) {
  const std::string text = read_text(real_templates / "template.html");
  for (const auto& entry : fs::directory_iterator(fs::path(BOOKSPIN_SOURCE_DIR) / "videos")) {
    if (entry.path().extension() != ".toml") continue;
    const std::string name = entry.path().stem().string();
    EXPECT_TRUE(std::regex_search(text, std::regex("\\{\\{film " + name + "[:}]")))
        << name << " has no place in template.html";
  }
}

TEST(PageTemplate, NeedsNoNetwork) {
  for (const char* name : {"template.html", "film.html", "missing.html", "figure.html", "page.css", "page.js",
                           "euler.svg", "springs.svg", "blend.svg", "polhodes.svg"}) {
    std::string text = read_text(real_templates / name);
    text = std::regex_replace(
        text, std::regex("xmlns='http://www.w3.org/2000/svg'|<a href=\"https://|<q cite=\"https://"), "");
    EXPECT_FALSE(std::regex_search(text, std::regex("https?:|src=\"//|@import|fetch\\("))) << name;
  }
}

}  // namespace
}  // namespace bookspin
