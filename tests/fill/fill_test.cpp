// The template language.

#include "fill/fill.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace bookspin {
namespace {

using nlohmann::json;

std::string filled(std::string_view text, const json& data) {
  return fill(text, data, "some.html");
}

TEST(Fill, EscapesWhatHtmlWouldRead) {
  const json data{{"title", R"(<b> & "it's" </script>)"}};
  EXPECT_EQ(filled("<i title='{{title}}'>", data), "<i title='&lt;b&gt; &amp; &quot;it&#39;s&quot; &lt;/script&gt;'>");
  EXPECT_EQ(filled("{{{title}}}", data), R"(<b> & "it's" </script>)");
  EXPECT_EQ(filled("{{ title }}", {{"title", "{{title}}"}}), "{{title}}");  // data is not a template
}

TEST(Fill, RepeatsAListAndLooksOutwards) {
  const json data{{"of", "two"}, {"books", {{{"name", "a"}}, {{"name", "b"}}}}, {"plain", {"x", "y"}}};
  EXPECT_EQ(filled("{{#books}}{{name}} of {{of}}; {{/books}}", data), "a of two; b of two; ");
  EXPECT_EQ(filled("{{#plain}}({{.}}){{/plain}}", data), "(x)(y)");
}

TEST(Fill, ShowsASectionOrItsOpposite) {
  const std::string_view text = "{{#a}}yes{{/a}}{{^a}}no{{/a}}";
  for (const json& value : {json(true), json("text"), json(0), json{1}}) {
    EXPECT_THAT(filled(text, {{"a", value}}), testing::StartsWith("yes")) << value;
    EXPECT_THAT(filled(text, {{"a", value}}), testing::Not(testing::HasSubstr("no"))) << value;
  }
  for (const json& value : {json(false), json(""), json(nullptr), json::array()})
    EXPECT_EQ(filled(text, {{"a", value}}), "no") << value;
  EXPECT_EQ(filled(text, json::object()), "no");
}

TEST(Fill, EntersObjectsAndNestedSections) {
  const json data{{"films", {{"fig05", "here"}}}, {"a", {{{"b", {1, 2}}}, {{"b", {3}}}}}};
  EXPECT_EQ(filled("{{films.fig05}}", data), "here");
  EXPECT_EQ(filled("{{#a}}[{{#b}}{{.}}{{/b}}]{{/a}}", data), "[12][3]");
  EXPECT_EQ(filled("{{#none}}{{#b}}{{unknown}}{{/b}}{{/none}}.", data), ".");
}

TEST(Fill, ASectionTagAloneOnItsLineLeavesNoLine) {
  EXPECT_EQ(filled("a\n  {{#on}}\nb\n{{/on}}\nc\n", {{"on", true}}), "a\nb\nc\n");
  EXPECT_EQ(filled("a\n{{#on}}\nb\n{{/on}}\nc\n", {{"on", false}}), "a\nc\n");
  EXPECT_EQ(filled("{{#on}} b {{/on}}\n", {{"on", true}}), " b \n");
  EXPECT_EQ(filled("{{#list}}\n{{.}}\n{{/list}}\n", {{"list", {1, 2}}}), "1\n2\n");
}

TEST(Fill, SaysWhereATemplateIsWrong) {
  const auto message = [](std::string_view text) -> std::string {
    try {
      return filled(text, {{"a", true}});
    } catch (const std::runtime_error& error) {
      return error.what();
    }
  };
  EXPECT_EQ(message("one\ntwo {{b}}"), "some.html:2: nothing is known as 'b'");
  EXPECT_EQ(message("{{#a}}\n{{/b}}"), "some.html:2: {{/b}} does not close {{#a}}");
  EXPECT_EQ(message("{{#a}} and no more"), "some.html:1: {{/a}} is missing");
  EXPECT_EQ(message("\n\n{{a"), "some.html:3: a tag does not end");
}

}  // namespace
}  // namespace bookspin
