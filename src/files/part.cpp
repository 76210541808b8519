#include "files/part.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <regex>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace bookspin {
namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& file, std::string_view operation, std::string_view reason) {
  throw std::runtime_error(fmt::format("{}: {}: {}", file.string(), operation, reason));
}

[[noreturn]] void fail(const fs::path& file, std::string_view operation) {
  fail(file, operation, std::generic_category().message(errno));
}

// Renaming a file over a link, a device or a FIFO would replace what stands for something else.
void require_replaceable(const fs::path& file) {
  struct stat found {};
  if (lstat(file.c_str(), &found) != 0) {
    if (errno != ENOENT) fail(file, "cannot be opened for writing");
    return;
  }
  if (S_ISREG(found.st_mode)) return;
  fail(file, "cannot be replaced",
       S_ISDIR(found.st_mode)   ? "is a folder"
       : S_ISLNK(found.st_mode) ? "is a symbolic link"
                                : "is not a regular file");
}

struct Descriptor {
  int number;
  ~Descriptor() {
    if (number >= 0) close(number);
  }
};

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : ".";
}

// A file that somebody writes is locked by its writer, in whatever container or process that lives.
void remove_leftovers(const fs::path& folder) {
  static const std::regex part_name(R"(\.bookspin-[0-9]+-[0-9]+\.part)");
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (!std::regex_match(entry->path().filename().string(), part_name)) continue;
    const Descriptor part{open(entry->path().c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC)};
    struct stat found {};
    const bool ours = fstat(part.number, &found) == 0 && S_ISREG(found.st_mode) && found.st_uid == geteuid();
    if (ours && flock(part.number, LOCK_EX | LOCK_NB) == 0) unlink(entry->path().c_str());
  }
}

// False when another program, looking for leftovers, was there between creation and lock: it takes the file away.
bool lock(int part) {
  if (flock(part, LOCK_EX | LOCK_NB) != 0) return errno != EWOULDBLOCK;  // a file system may know no locks
  struct stat found {};
  return fstat(part, &found) == 0 && found.st_nlink > 0;
}

}  // namespace

Part::Part(fs::path file) : file_(std::move(file)) {
  static std::atomic<int> count = 0;
  require_replaceable(file_);
  remove_leftovers(folder_of(file_));
  while (descriptor_ < 0) {
    path_ = folder_of(file_) / fmt::format(".bookspin-{}-{}.part", getpid(), ++count);
    descriptor_ = open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (descriptor_ < 0 && errno != EEXIST) fail(file_, "cannot be opened for writing");
    if (descriptor_ >= 0 && !lock(descriptor_)) close(std::exchange(descriptor_, -1));
  }
}

Part::~Part() {
  if (!path_.empty()) unlink(path_.c_str());
  close(descriptor_);
}

void publish(const std::vector<Part*>& parts, const fs::path& obsolete) {
  for (const Part* part : parts) {
    if (fsync(part->descriptor_) != 0) fail(part->file_, "cannot be flushed to the disk");
  }
  // Two programs that publish the same names must not mix them. Best effort: not every file system locks a folder.
  const Descriptor folder{open(folder_of(parts.front()->file_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)};
  flock(folder.number, LOCK_EX);
  for (const Part* part : parts) require_replaceable(part->file_);
  for (Part* part : parts) {
    if (rename(part->path_.c_str(), part->file_.c_str()) != 0) fail(part->file_, "cannot be renamed");
    part->path_.clear();
  }
  std::error_code ignored;
  if (!obsolete.empty()) fs::remove(obsolete, ignored);
}

}  // namespace bookspin
