// The manual and the schema of scene scripts: they and the reader say the same.

#include "scene/reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "scene/override.h"
#include "scene/scene_file.h"
#include "scratch.h"

namespace bookspin {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

const Json& schema() {
  static const Json parsed = Json::parse(script_schema());
  return parsed;
}

bool is_of(const std::string& type, const Json& value) {
  return type == "object"    ? value.is_object()
         : type == "array"   ? value.is_array()
         : type == "string"  ? value.is_string()
         : type == "boolean" ? value.is_boolean()
         : type == "integer" ? value.is_number_integer()
                             : type == "number" && value.is_number();
}

// JSON schema, as far as ours goes. Source: json-schema.org, draft 7.
bool is_valid(const Json& value, const Json& by) {
  for (const auto& [word, rule] : by.items()) {
    bool good = true;
    if (word == "$ref") {
      good = is_valid(value, schema().at(Json::json_pointer(rule.get<std::string>().substr(1))));
    } else if (word == "type") {
      good = rule.is_string()
                 ? is_of(rule, value)
                 : std::any_of(rule.begin(), rule.end(), [&](const Json& type) { return is_of(type, value); });
    } else if (word == "enum") {
      good = std::find(rule.begin(), rule.end(), value) != rule.end();
    } else if (word == "minimum") {
      good = !value.is_number() || value >= rule;
    } else if (word == "exclusiveMinimum") {
      good = !value.is_number() || value > rule;
    } else if (word == "maximum") {
      good = !value.is_number() || value <= rule;
    } else if (word == "minItems") {
      good = !value.is_array() || value.size() >= rule;
    } else if (word == "maxItems") {
      good = !value.is_array() || value.size() <= rule;
    } else if (word == "items") {
      good = !value.is_array() ||
             std::all_of(value.begin(), value.end(), [&](const Json& one) { return is_valid(one, rule); });
    } else if (word == "required") {
      good = std::all_of(rule.begin(), rule.end(), [&](const Json& key) { return value.contains(key); });
    } else if (word == "properties") {
      if (!value.is_object()) continue;
      for (const auto& [key, one] : value.items()) {
        good = good && rule.contains(key) && is_valid(one, rule[key]);  // additionalProperties is false everywhere
      }
    } else if (!std::set<std::string>{"$schema", "$defs", "title", "description", "default", "additionalProperties"}
                    .contains(word)) {
      ADD_FAILURE() << "this validator does not know " << word;
    }
    if (!good) return false;
  }
  return true;
}

bool schema_takes(const std::string& script, const std::string& override) {
  toml::table table = parse_toml(script, "s.toml");
  if (!override.empty()) apply_override(table, override);
  std::ostringstream json;
  json << toml::json_formatter(table);
  return is_valid(Json::parse(json.str()), schema());
}

bool reader_takes(const std::string& script, const std::string& override) {
  try {
    (void)parse_scene(script, "s.toml", std::vector{override});
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

TEST(Reference, TheManualInTheRepositoryIsTheProgramsOwn) {
  EXPECT_EQ(read_text(BOOKSPIN_SOURCE_DIR "/videos/README.md"), script_manual())
      << "to have it so: bookspin help scene >videos/README.md";
}

TEST(Reference, EveryVideoIsValid) {
  int scripts = 0;
  for (const auto& entry : fs::directory_iterator(BOOKSPIN_SOURCE_DIR "/videos")) {
    if (entry.path().extension() != ".toml") continue;
    EXPECT_TRUE(schema_takes(read_text(entry.path()), "")) << entry.path();
    ++scripts;
  }
  EXPECT_GE(scripts, 17);
}

TEST(Reference, TheSchemaAndTheReaderTakeTheSameValues) {
  const std::string script =
      "title = 'T'\n[clip]\n[view]\n[[book]]\n[[expect]]\nquantity = 'tilt'\nat_most = 9\n"
      "[[cue]]\nsays = 'S'\nframes = [0, 1]\n";
  std::map<std::string, const Json*> places{{"", &schema()}};
  for (const auto& [name, table] : schema()["$defs"].items()) {
    places[name == "clip" || name == "view" ? name + "." : name + ".0."] = &table;
  }
  int taken = 0;
  int refused = 0;
  for (const auto& [place, table] : places) {
    EXPECT_FALSE(schema_takes(script, place + "not_there=1"));
    for (const auto& [key, rule] : (*table)["properties"].items()) {
      std::vector<Json> values{-1,  0,      1,   2,       0.5, -0.5, 7,    240, 241,
                               1e5, 100001, 1e6, 1000001, 2e6, 3e9,  true, "x", "rk4"};
      for (const char* list :
           {"[]", "[1]", "[0, 1]", "[1, 2, 3]", "[0, 0, 0.5]", "[1, 2, 3, 4]", "['trace']", "['tilt']"})
        values.push_back(list);
      for (const char* word : {"minimum", "exclusiveMinimum", "maximum", "default"}) {
        if (rule.contains(word)) values.push_back(rule[word]);
      }
      if (rule.contains("enum")) values.insert(values.end(), rule["enum"].begin(), rule["enum"].end());
      for (const Json& value : values) {
        const std::string override = place + key + "=" + (value.is_string() ? value.get<std::string>() : value.dump());
        const bool takes = schema_takes(script, override);
        // What the schema cannot say: which integrator goes with what, which of the books there are, what shapes.
        const bool beyond = key == "integrator" || key == "size" || key == "moments";
        if (takes && (beyond || override.starts_with("expect.0.book"))) continue;
        EXPECT_EQ(takes, reader_takes(script, override)) << override;
        ++(takes ? taken : refused);
      }
    }
  }
  EXPECT_GT(taken, 100);
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace bookspin
