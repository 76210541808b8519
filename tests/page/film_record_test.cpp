// The door through which a film's data come in: good ones whole, others named with file and key.

#include "page/film_record.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "page/a_film.h"
#include "page/page.h"

namespace bookspin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AnyOf;
using testing::HasSubstr;
using testing::StartsWith;

TEST(FilmRecord, HoldsWhatThePageNeeds) {
  json data = a_film();
  data["clip"]["first_frame"] = 5;
  data["clip"]["drawn_frames"] = 10;
  data["books"][0]["exploded_frame"] = 19;
  data["books"][0]["data"]["tilt"][7] = nullptr;
  const FilmRecord film = as_read(data);
  EXPECT_EQ(film.name, "a");
  EXPECT_EQ(film.title, "A film");
  EXPECT_EQ(film.film, "a.mp4");
  EXPECT_EQ(film.width, 64);
  EXPECT_EQ(film.seconds(), 1.0);
  EXPECT_EQ(film.expectations.at(0).frame, 19);
  EXPECT_EQ(film.quantities.at(0).unit, "°");
  EXPECT_EQ(film.quantities.at(2).scale, 100.0);
  EXPECT_EQ(film.quantities.at(5).title, "Error of the orientation");
  EXPECT_EQ(film.quantities.at(5).high, 0.1);
  EXPECT_EQ(film.quantities.at(5).most, 3.14);
  EXPECT_EQ(film.books.at(0).name, "matrix");  // none of its own
  EXPECT_EQ(film.books.at(0).exploded_frame, 19);
  EXPECT_EQ(film.books.at(0).data.at("tilt").size(), 20U);
  EXPECT_TRUE(std::isnan(film.books.at(0).data.at("tilt").at(7)));
  data.erase("film");
  EXPECT_EQ(as_read(data).film, "");
}

struct Door : testing::Test {
  // What is said about a.json with this text; "nothing" when it is passed over.
  std::string said(const std::string& text) {
    write_text(scratch / "a.json", text);
    try {
      return read_film_record(scratch / "a.json") ? "read" : "nothing";
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), StartsWith((scratch / "a.json").string() + ": "));
      return std::string(error.what()).substr((scratch / "a.json").string().size() + 2);
    }
  }
  Scratch scratch;
};

TEST_F(Door, PassesOverWhatIsNoFilm) {
  for (const char* text : {"", "[]", "{}", "null", "{\"title\": 1", R"({"format": 1})", R"({"format": "GeoJSON"})"}) {
    EXPECT_EQ(said(text), "nothing") << text;
  }
}

TEST_F(Door, NamesAnotherVersionAndAFileCutShort) {
  json film = a_film();
  EXPECT_EQ(said(film.dump()), "read");
  film["format"] = "bookspin film 2";
  EXPECT_EQ(said(film.dump()), "format: found \"bookspin film 2\"; allowed: \"bookspin film 1\"");
  const std::string whole = a_film().dump();
  EXPECT_THAT(said(whole.substr(0, whole.size() - 5)), StartsWith("is cut short or broken: parse error at line "));
  EXPECT_EQ(said(R"({"format": "bookspin film 1", "n": 1e9999})"),
            "is cut short or broken: number overflow parsing '1e9999'; `bookspin render a.toml` makes it");
}

TEST_F(Door, NamesKeyFoundAndAllowed) {
  const auto with = [this](const char* pointer, const json& value) {
    json film = a_film();
    film[json::json_pointer(pointer)] = value;
    return said(film.dump());
  };
  EXPECT_EQ(with("/clip/fps", 0), "clip.fps: found 0; allowed: a whole number from 1 to 1000");
  EXPECT_EQ(with("/clip/frames", 21),
            "books.0.data.energy_ratio: found a list of 20; allowed: a list of 21, one number or null a frame");
  EXPECT_EQ(with("/clip/first_frame", 20), "clip.first_frame: found 20; allowed: a whole number from 0 to 19");
  EXPECT_EQ(with("/clip/drawn_frames", 1e300), "clip.drawn_frames: found 1e+300; allowed: a whole number from 1 to 20");
  EXPECT_EQ(with("/clip/frames", 18446744073709551615U),
            "clip.frames: found 18446744073709551615; allowed: a whole number from 1 to 1073741824");
  EXPECT_EQ(with("/film", "../../etc/passwd"),
            "film: found \"../../etc/passwd\"; allowed: the name of a file beside this one");
  EXPECT_EQ(with("/poster", ""), "poster: found \"\"; allowed: the name of a file beside this one");
  EXPECT_EQ(with("/books/0/data/tilt/3", "x"), "books.0.data.tilt.3: found \"x\"; allowed: a number or null");
  EXPECT_EQ(with("/expectations/0/met", "yes"), "expectations.0.met: found \"yes\"; allowed: true or false");
  EXPECT_EQ(with("/books", json::array()), "books: found a list of 0; allowed: at least one");
  EXPECT_EQ(with("/quantities/0/axis/high", nullptr), "quantities.0.axis.high: found null; allowed: a number");
  EXPECT_EQ(with("/quantities/0/name", "x"), "quantities: none has the name tilt, of which there are data");
  json film = a_film();
  film["clip"].erase("fps");
  EXPECT_EQ(said(film.dump()), "clip.fps: is missing");
}

// Every key deleted, and replaced by values of every type; of lists the first and the last entry.
TEST_F(Door, EveryMutationEndsInAMessageOrAPage) {
  for (const char* product : {"a.mp4", "a.png"}) write_text(scratch / product, "");
  const json good = a_film();
  int mutations = 0;
  int refused = 0;
  const auto attempt = [&](const json& mutant, const std::string& what, const std::string& last_key) {
    ++mutations;
    write_text(scratch / "a.json", mutant.dump());
    fs::remove(scratch / "index.html");
    try {
      write_page({scratch.folder(), fs::path(BOOKSPIN_SOURCE_DIR) / "videos" / "page"});
      EXPECT_THAT(read_text(scratch / "index.html"), HasSubstr("<article class=\"film\" id=\"a\"")) << what;
    } catch (const std::exception& error) {
      ++refused;
      // The key is named, or a list by its own.
      EXPECT_THAT(error.what(), AnyOf(HasSubstr(last_key), HasSubstr("holds no films"))) << what;
    }
  };
  const std::function<void(const json::json_pointer&)> mutate = [&](const json::json_pointer& at) {
    const json& value = good[at];
    if (!at.empty()) {
      const std::string key =
          at.parent_pointer().empty() || !good[at.parent_pointer()].is_array() ? at.back() : at.parent_pointer().back();
      json mutant = good;
      json& parent = mutant[at.parent_pointer()];
      if (parent.is_array()) {
        parent.erase(std::stoul(at.back()));
      } else {
        parent.erase(at.back());
      }
      attempt(mutant, at.to_string() + " deleted", key);
      for (const json& other : {json(), json(""), json(-1), json(1e300), json::array(), json::object()}) {
        mutant = good;
        mutant[at] = other;
        attempt(mutant, at.to_string() + " = " + other.dump(),
                good[at.parent_pointer()].is_array() ? key + "." + at.back() : key);
      }
    }
    if (value.is_object()) {
      for (const auto& entry : value.items()) mutate(at / entry.key());
    } else if (value.is_array() && !value.empty()) {
      mutate(at / 0);
      if (value.size() > 1) mutate(at / (value.size() - 1));
    }
  };
  mutate(json::json_pointer());
  EXPECT_GE(mutations, 200);  // 308
  EXPECT_GE(refused, 200);    // 236: the rest changes only what the page does not use
}

TEST_F(Door, AFileThatCannotBeReadIsNamed) {
  EXPECT_THROW(static_cast<void>(read_film_record(scratch / "none.json")), std::runtime_error);
}

}  // namespace
}  // namespace bookspin
