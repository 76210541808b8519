#include "video/film_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <thread>

#include "video/mp4_reader.h"
#include "video/palette.h"
#include "video/test_pictures.h"

namespace bookspin {
namespace {

using testing::Each;
using testing::ElementsAre;

// A film of `frames` pictures of the moving box.
std::filesystem::path film(const std::filesystem::path& file, const MovingBox& scene, int frames, bool whole = false) {
  Part part(file);
  FilmWriter writer(part, {.width = scene.width, .height = scene.height, .fps = 60, .title = {}});
  for (int k = 0; k < frames; ++k) {
    const Image picture = scene.draw(k);
    writer.write(picture, {whole ? picture.bounds() : scene.changed(k)});
  }
  writer.finish();
  publish({&part});
  return file;
}

class FilmLength : public testing::TestWithParam<int> {};

TEST_P(FilmLength, EveryFrameIsThereForItsTime) {
  const int frames = GetParam();
  const MovingBox scene{192, 108};
  const auto folder = empty_folder("length_" + std::to_string(frames));
  const auto file = film(folder / "film.mp4", scene, frames);
  const Mp4Info info = read_mp4_info(file);
  EXPECT_EQ(info.frames, frames);
  EXPECT_NEAR(info.duration, frames / 60.0, 1e-6);  // measured 3.4e-7: libav tells microseconds
  EXPECT_EQ(info.packet_durations.size(), static_cast<std::size_t>(frames));
  EXPECT_THAT(info.packet_durations, Each(1));

  const int last = frames - 1;
  double worst = 1e9;
  const int decoded = read_frames(file, [&](int k, const Image& picture) {
    if (k == 0 || k == last || k == frames / 2) worst = std::min(worst, psnr(picture, scene.draw(k)));
  });
  EXPECT_EQ(decoded, frames);
  EXPECT_GE(worst, 36.0);  // measured 37.5 to 41.4 dB; against the next frame instead: 20.5
}

INSTANTIATE_TEST_SUITE_P(FilmWriter, FilmLength, testing::Values(1, 2, 250));

TEST(FilmWriter, WritesWebMByTheNamesEnd) {
  const MovingBox scene{192, 108};
  const auto file = film(empty_folder("webm") / "film.webm", scene, 60);
  const Mp4Info info = read_mp4_info(file);
  EXPECT_EQ(info.codec, "vp9");
  EXPECT_EQ(info.matrix, "bt709");
  EXPECT_NEAR(info.duration, 1.0, 2e-3);  // measured 0; the container counts milliseconds
  double worst = 1e9;
  EXPECT_EQ(
      read_frames(file, [&](int k, const Image& picture) { worst = std::min(worst, psnr(picture, scene.draw(k))); }),
      60);
  EXPECT_GE(worst, 33.0);  // dB; measured 39.4
}

// 60 frames a second cannot be told in hundredths of a second: 20 can.
TEST(FilmWriter, WritesAGifOfEveryThirdPicture) {
  const Mp4Info info = read_mp4_info(film(empty_folder("gif") / "film.gif", {192, 108}, 60));
  EXPECT_EQ(info.codec, "gif");
  EXPECT_EQ(info.packet_durations.size(), 20U);
  EXPECT_NEAR(info.duration, 1.0, 1e-6);  // measured 0
  EXPECT_EQ(bytes_of(film(empty_folder("gif") / "a.gif", {192, 108}, 9)),
            bytes_of(film(empty_folder("gif") / "b.gif", {192, 108}, 9, true)));
}

TEST(FilmWriter, RefusesANameThatSaysNoFormat) {
  EXPECT_THROW(film(empty_folder("avi") / "film.avi", {192, 108}, 2), std::invalid_argument);
}

// What fills the samples keeps its color; the rest is nearer than half a step of the coarse cube.
TEST(Palette, HasTheSamplesColorsAndSomeOfAll) {
  Palette palette;
  palette.sample(flat_picture(16, 16, 32, 39, 49));
  palette.choose();
  std::mt19937 generator(1);
  Image picture = random_picture(16, 16, generator);
  std::copy_n(std::array<std::uint8_t, 4>{32, 39, 49, 255}.begin(), 4, picture.rgba.begin());
  std::array<std::uint8_t, 256> indices{};
  palette.convert(picture, picture.bounds(), indices.data(), 16);
  EXPECT_EQ(palette.argb().size(), 256U);
  EXPECT_EQ(palette.argb()[indices[0]], 0xff202731U);
  int worst = 0;
  for (std::size_t i = 0; i < 256; ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      const auto found = static_cast<int>(palette.argb()[indices[i]] >> (16 - 8 * c) & 0xffU);
      worst = std::max(worst, std::abs(found - picture.rgba[4 * i + c]));
    }
  }
  EXPECT_LE(worst, 51);  // half a step of the cube, and a bin
}

TEST(FilmWriter, FileSaysWhatPlayersNeed) {
  const auto folder = empty_folder("tags");
  const auto file = folder / "odd: folder" / "odd: name.mp4";
  std::filesystem::create_directories(file.parent_path());
  const MovingBox scene{128, 72};
  Part part(file);
  FilmWriter writer(part, {.width = 128, .height = 72, .fps = 30, .title = "Bücher – a title"});
  for (int k = 0; k < 100; ++k) writer.write(scene.draw(k), {scene.changed(k)});
  writer.finish();
  publish({&part});
  const Mp4Info info = read_mp4_info(file);
  EXPECT_EQ(info.codec, "h264");
  EXPECT_EQ(info.profile, "High");
  EXPECT_EQ(info.pixel_format, "yuv420p");
  EXPECT_EQ(info.width, 128);
  EXPECT_EQ(info.height, 72);
  EXPECT_EQ(info.fps, 30);
  EXPECT_EQ(info.matrix, "bt709");
  EXPECT_EQ(info.primaries, "bt709");
  EXPECT_EQ(info.transfer, "bt709");
  EXPECT_EQ(info.range, "tv");
  EXPECT_EQ(info.siting, "left");
  EXPECT_EQ(info.title, "Bücher – a title");
  EXPECT_TRUE(info.moov_before_mdat);
  EXPECT_TRUE(info.closed_gops);
  EXPECT_THAT(info.key_frames, ElementsAre(0, 30, 60, 90));
  EXPECT_EQ(files_in(folder), 1);
}

// A cut to another picture in the middle of a second makes no key frame of its own.
TEST(FilmWriter, KeyFramesFallOnWholeSecondsDespiteCuts) {
  const auto folder = empty_folder("cuts");
  const MovingBox scene{128, 72};
  Part part(folder / "film.mp4");
  FilmWriter writer(part, {.width = 128, .height = 72, .fps = 20, .title = {}});
  for (int k = 0; k < 50; ++k) {
    Image picture = scene.draw(k);
    if (k / 15 % 2 == 1) std::reverse(picture.rgba.begin(), picture.rgba.end());
    writer.write(picture, {picture.bounds()});
  }
  writer.finish();
  publish({&part});
  EXPECT_THAT(read_mp4_info(folder / "film.mp4").key_frames, ElementsAre(0, 20, 40));
}

TEST(FilmWriter, FlatColorsComeBack) {
  const auto folder = empty_folder("colors");
  const std::array<std::array<std::uint8_t, 3>, 9> colors{{{255, 0, 0},
                                                           {0, 255, 0},
                                                           {0, 0, 255},
                                                           {128, 128, 128},
                                                           {255, 255, 255},
                                                           {0, 0, 0},
                                                           {200, 120, 40},
                                                           {30, 60, 90},
                                                           {250, 246, 238}}};
  int worst = 0;
  for (const auto& [r, g, b] : colors) {
    const Image drawn = flat_picture(64, 48, r, g, b);
    Part part(folder / "film.mp4");
    FilmWriter writer(part, {.width = 64, .height = 48, .fps = 60, .title = {}});
    for (int k = 0; k < 3; ++k) writer.write(drawn, {k == 0 ? drawn.bounds() : Rect{}});
    writer.finish();
    publish({&part});
    EXPECT_EQ(read_frames(folder / "film.mp4",
                          [&](int, const Image& shown) {
                            for (std::size_t i = 0; i < drawn.rgba.size(); ++i)
                              worst = std::max(worst, std::abs(drawn.rgba[i] - shown.rgba[i]));
                          }),
              3);
  }
  EXPECT_LE(worst, 3);  // measured 1
}

TEST(FilmWriter, DecodedPictureIsTheDrawnOne) {
  const MovingBox scene{640, 360};
  const auto file = film(empty_folder("quality") / "film.mp4", scene, 30);
  double worst = 1e9;
  read_frames(file, [&](int k, const Image& shown) { worst = std::min(worst, psnr(shown, scene.draw(k))); });
  EXPECT_GE(worst, 41.0);  // measured 42.4 dB
}

TEST(FilmWriter, ChangedRectangleGivesTheSameFile) {
  const auto folder = empty_folder("changed");
  const MovingBox scene{192, 108};
  EXPECT_EQ(bytes_of(film(folder / "part.mp4", scene, 90)), bytes_of(film(folder / "whole.mp4", scene, 90, true)));
}

TEST(FilmWriter, ChangedRectangleMayReachOverTheEdge) {
  const auto folder = empty_folder("edge");
  const MovingBox scene{64, 48};
  Part part(folder / "over.mp4");
  FilmWriter writer(part, {.width = 64, .height = 48, .fps = 60, .title = {}});
  for (int k = 0; k < 5; ++k) writer.write(scene.draw(k), {{-100, -7, 1000, 900}});
  writer.finish();
  publish({&part});
  EXPECT_EQ(bytes_of(folder / "over.mp4"), bytes_of(film(folder / "whole.mp4", scene, 5, true)));
}

TEST(FilmWriter, PiecesJoinToTheSameBytes) {
  const auto folder = empty_folder("pieces");
  const MovingBox scene{192, 108};
  const FilmWriter::Settings settings{.width = 192, .height = 108, .fps = 60, .title = {}};
  constexpr int frames = 6 * 60 + 7;
  const auto write = [&](FilmWriter& writer, int first, int end) {
    for (int k = first; k < end; ++k) {
      const Image picture = scene.draw(k);
      writer.write(picture, {k == first ? picture.bounds() : scene.changed(k)});
    }
  };
  const Part odd(folder / "odd"), even(folder / "even");
  for (const Part* piece : {&odd, &even}) {
    FilmWriter its_writer(*piece, {.width = 192, .height = 108, .fps = 60, .title = {}, .piece = true});
    for (int first = piece == &odd ? 60 : 120; first < frames; first += 120)
      write(its_writer, first, std::min(first + 60, frames));
    its_writer.finish();
  }
  Part part(folder / "joined.mp4");
  FilmWriter writer(part, settings);
  ASSERT_EQ(writer.segment(), 60);
  write(writer, 0, 60);
  PieceReader from_odd(odd), from_even(even);
  for (int first = 60; first < frames; first += 60)
    writer.append(first % 120 == 0 ? from_even : from_odd, std::min(60, frames - first));
  writer.finish();
  publish({&part});
  const auto whole = film(folder / "whole.mp4", scene, frames);
  EXPECT_EQ(bytes_of(folder / "joined.mp4"), bytes_of(whole));
  EXPECT_EQ(read_mp4_info(whole).frames, frames);
}

TEST(FilmWriter, SamePicturesGiveTheSameBytesInAnyThread) {
  const auto folder = empty_folder("threads");
  const MovingBox scene{192, 108};
  const std::string alone = bytes_of(film(folder / "alone.mp4", scene, 80));
  EXPECT_GT(alone.size(), 1000U);
  std::array<std::thread, 4> threads;
  for (std::size_t i = 0; i < threads.size(); ++i) {
    threads.at(i) = std::thread([&, i] { film(folder / (std::to_string(i) + ".mp4"), scene, 80); });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < threads.size(); ++i)
    EXPECT_EQ(bytes_of(folder / (std::to_string(i) + ".mp4")), alone) << i;
}

}  // namespace
}  // namespace bookspin
