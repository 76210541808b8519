// What is left when a film cannot be made, and what a long one costs in memory.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <stdexcept>

#include "video/film_writer.h"
#include "video/mp4_reader.h"
#include "video/test_pictures.h"

namespace bookspin {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

const MovingBox scene{128, 72};
const FilmWriter::Settings settings{.width = 128, .height = 72, .fps = 60, .title = {}};

void write_frames(FilmWriter& writer, int frames) {
  for (int k = 0; k < frames; ++k) writer.write(scene.draw(k), {scene.changed(k)});
}

void write_film(const std::filesystem::path& file, int frames) {
  Part part(file);
  FilmWriter writer(part, settings);
  write_frames(writer, frames);
  writer.finish();
  publish({&part});
}

TEST(Mp4Safety, UnfinishedFilmLeavesTheOldOne) {
  const auto folder = empty_folder("unfinished");
  write_film(folder / "film.mp4", 10);
  const std::string good = bytes_of(folder / "film.mp4");
  {
    const Part part(folder / "film.mp4");
    FilmWriter writer(part, settings);
    write_frames(writer, 100);
    EXPECT_EQ(bytes_of(folder / "film.mp4"), good);
  }
  EXPECT_EQ(bytes_of(folder / "film.mp4"), good);
  EXPECT_EQ(files_in(folder), 1);
  write_film(folder / "film.mp4", 11);
  EXPECT_EQ(read_mp4_info(folder / "film.mp4").frames, 11);
  EXPECT_EQ(files_in(folder), 1);
}

TEST(Mp4Safety, BadDataIsRefused) {
  const Part part(empty_folder("refused") / "film.mp4");
  const auto open = [&](int width, int height, int fps) {
    return
        [&part, width, height, fps] { FilmWriter(part, {.width = width, .height = height, .fps = fps, .title = {}}); };
  };
  const auto odd = [](const std::string& size) {
    return ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr("film.mp4"), HasSubstr(size), HasSubstr("even")));
  };
  EXPECT_THAT(open(129, 72, 60), odd("129x72"));
  EXPECT_THAT(open(128, 71, 60), odd("128x71"));
  EXPECT_THAT(open(0, 72, 60), odd("0x72"));
  EXPECT_THAT(open(-2, 72, 60), odd("-2x72"));
  EXPECT_THAT(open(128, 72, 0), ThrowsMessage<std::invalid_argument>(HasSubstr("0 frames a second")));

  FilmWriter writer(part, settings);
  EXPECT_THAT([&] { writer.write(Image(128, 70), {}); },
              ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr("128x70"), HasSubstr("128x72"))));
  EXPECT_THAT([&] { writer.finish(); }, ThrowsMessage<std::invalid_argument>(HasSubstr("at least one frame")));
}

TEST(Mp4Safety, LibavSpeaksInTheError) {
  const Part part(empty_folder("encoder") / "film.mp4");
  EXPECT_THAT(([&] { FilmWriter(part, {.width = 1 << 28, .height = 2, .fps = 60, .title = {}}); }),
              ThrowsMessage<std::runtime_error>(
                  AllOf(HasSubstr("film.mp4"), HasSubstr("open the encoder"), HasSubstr("268435456x2"))));
}

TEST(Mp4Safety, UnwritableFolderIsNamed) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
  const auto folder = empty_folder("read_only");
  std::filesystem::permissions(folder, std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  EXPECT_THAT([&] { write_film(folder / "film.mp4", 2); },
              ThrowsMessage<std::runtime_error>(
                  AllOf(HasSubstr("film.mp4: cannot be opened for writing"), HasSubstr("Permission denied"))));
  std::filesystem::permissions(folder, std::filesystem::perms::owner_all);
}

// While it lives, no file may grow over `bytes`: writing past that fails as on a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST(Mp4Safety, FullDiskIsAnErrorWhereverItStrikes) {
  const auto folder = empty_folder("full");
  constexpr int frames = 200;
  write_film(folder / "film.mp4", frames);
  const std::string good = bytes_of(folder / "film.mp4");
  const auto index_size = good.find("mdat");  // the index stands before it
  ASSERT_GT(good.size(), 2 * index_size);

  // In the header, among the pictures, while the pictures move to make room for the index, in the very last byte.
  for (const std::size_t bytes : {std::size_t{0}, std::size_t{20}, good.size() / 2, good.size() - index_size,
                                  good.size() - index_size / 2, good.size() - 1}) {
    EXPECT_THAT(([&] {
                  const FileSizeLimit limit(bytes);
                  write_film(folder / "film.mp4", frames);
                }),
                ThrowsMessage<std::runtime_error>(AllOf(HasSubstr("film.mp4: write"), HasSubstr("File too large"))))
        << bytes << " of " << good.size();
    EXPECT_EQ(bytes_of(folder / "film.mp4"), good);
    EXPECT_EQ(files_in(folder), 1);
  }
  const FileSizeLimit limit(good.size());
  write_film(folder / "film.mp4", frames);
  EXPECT_EQ(bytes_of(folder / "film.mp4"), good);
}

std::int64_t resident_bytes() {
  std::ifstream in("/proc/self/statm");
  std::int64_t all = 0;
  std::int64_t resident = 0;
  in >> all >> resident;
  return resident * sysconf(_SC_PAGESIZE);
}

TEST(Mp4Safety, LongFilmNeedsNoMoreMemory) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "the address sanitizer keeps freed memory";
#endif
  if (resident_bytes() == 0) GTEST_SKIP() << "this system does not say how much memory a process holds";
  const Part part(empty_folder("memory") / "film.mp4");
  FilmWriter writer(part, settings);
  write_frames(writer, 300);
  const std::int64_t before = resident_bytes();
  write_frames(writer, 2700);
  const std::int64_t grown = resident_bytes() - before;
  writer.finish();
  EXPECT_LE(grown, 2'000'000);  // measured 352 kB, the index; every picture kept would be 37 MB
}

}  // namespace
}  // namespace bookspin
