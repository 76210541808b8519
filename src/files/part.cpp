#include "files/part.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <mutex>
#include <regex>
#include <set>
#include <sstream>
#include <system_error>
#include <utility>

#include "files/checksums.h"
#include "files/descriptor.h"
#include "files/files.h"

namespace bookspin {
namespace fs = std::filesystem;

namespace {

std::mutex making;  // of the set, and of the names of what is in it
std::set<const Part*> in_the_making;

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : ".";
}

fs::path private_name(const fs::path& folder, std::string_view kind) {
  static std::atomic<int> count = 0;
  return folder / fmt::format(".bookspin-{}-{}.{}", getpid(), ++count, kind);
}

std::string kind_of(const std::string& name) {
  static const std::regex pattern(R"(\.bookspin-[0-9]+-[0-9]+\.(part|undo|old))");
  std::smatch found;
  return std::regex_match(name, found, pattern) ? found[1].str() : "";
}

// Whoever holds the folder publishes there, and nobody else: what is half published is then a killed program's. Not
// every file system locks a folder; there, two who publish the same names at the same moment may meet.
class FolderLock {
 public:
  explicit FolderLock(const fs::path& folder) : folder_{open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)} {
    constexpr int most_tries = 500;  // in ten seconds: a publisher takes less, `flock FOLDER bookspin ...` for ever
    for (int tries = 0; folder_.number >= 0 && !held_; ++tries) {
      held_ = flock(folder_.number, LOCK_EX | LOCK_NB) == 0;
      if (held_ || errno != EWOULDBLOCK) return;
      if (tries == most_tries) throw_file_error(folder, "cannot be changed", "another program has locked it");
      if (usleep(20000) != 0)
        throw_file_error(folder, "cannot be changed", "stopped while another program had locked it");
    }
  }
  [[nodiscard]] bool held() const { return held_; }
  void flush(const fs::path& folder) const {
    if (held_ && fsync(folder_.number) != 0 && errno != EINVAL)
      throw_file_error(folder, "cannot be flushed to the disk");
  }

 private:
  Descriptor folder_;
  bool held_ = false;
};

// One of a transaction's steps, as its journal has them: the name takes a new file, and what stood there is kept.
struct Step {
  ino_t inode = 0;     // of the new file; 0: none, the name goes
  std::string name;    // within the folder, as all
  std::string backup;  // where the old file is kept; empty: there is none
};

constexpr char end_of_field = '\0';  // the one character, beside the slash, that a name never has

std::string journal_of(const std::vector<Step>& steps) {
  std::string text;
  for (const Step& step : steps) {
    for (const std::string& field : {std::to_string(step.inode), step.name, step.backup}) text += field + end_of_field;
  }
  return text;
}

std::vector<Step> read_journal(const fs::path& file) {
  std::istringstream in(read_file(file));
  const auto next = [&in](std::string& field) { return bool(std::getline(in, field, end_of_field)); };
  std::vector<Step> steps;
  Step step;
  for (std::string inode; next(inode) && next(step.name) && next(step.backup); steps.push_back(step)) {
    step.inode = std::strtoull(inode.c_str(), nullptr, 10);
  }
  return steps;
}

// Where the name still has, or again has, another file than the new one, nothing is taken back. May be done twice.
void undo(const fs::path& folder, const std::vector<Step>& steps) {
  for (const Step& step : steps) {
    const fs::path file = folder / fs::path(step.name).filename();  // whatever a damaged journal says
    struct stat found {};
    const bool there = lstat(file.c_str(), &found) == 0;
    if (there ? found.st_ino != step.inode : errno != ENOENT) continue;
    const fs::path backup = folder / fs::path(step.backup).filename();
    const int done = !step.backup.empty() ? rename(backup.c_str(), file.c_str()) : there ? unlink(file.c_str()) : 0;
    if (done != 0 && errno != ENOENT) throw_file_error(file, "cannot be given back what it held");
  }
}

bool removed(const fs::path& file) {
  return unlink(file.c_str()) == 0 || errno == ENOENT;
}

// What renaming a file to this name would replace; a link, a device or a FIFO stands for something else.
struct stat require_replaceable_kind(const fs::path& file) {
  struct stat found {};
  if (lstat(file.c_str(), &found) != 0) {
    if (errno != ENOENT) throw_file_error(file, "cannot be opened for writing");
  } else if (!S_ISREG(found.st_mode)) {
    throw_file_error(file, "cannot be replaced",
                     S_ISDIR(found.st_mode)   ? "is a folder"
                     : S_ISLNK(found.st_mode) ? "is a symbolic link"
                                              : "is not a regular file");
  }
  return found;
}

// A link, so that the name never is without a file; where the file system knows none, the file itself.
void keep_as(const fs::path& backup, const fs::path& file) {
  if (link(file.c_str(), backup.c_str()) == 0) return;
  if (rename(file.c_str(), backup.c_str()) != 0) throw_file_error(file, "cannot be replaced");
}

}  // namespace

void settle(const fs::path& folder) {
  const FolderLock lock(folder);
  if (!lock.held()) return;
  std::vector<fs::path> journals;
  std::vector<fs::path> others;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::string kind = kind_of(entry->path().filename().string());
    struct stat found {};
    if (kind.empty() || lstat(entry->path().c_str(), &found) != 0) continue;
    if (!S_ISREG(found.st_mode) || found.st_uid != geteuid()) continue;
    (kind == "undo" ? journals : others).push_back(entry->path());
  }
  for (const fs::path& journal : journals) {
    undo(folder, read_journal(journal));
    unlink(journal.c_str());
  }
  for (const fs::path& file : others) {
    // What somebody writes is locked, in whatever process or container the writer lives.
    const Descriptor part(open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    if (part.number >= 0 && flock(part.number, LOCK_EX | LOCK_NB) == 0) unlink(file.c_str());
  }
}

Part::Part(fs::path file, NamedBy named_by) : file_(std::move(file)), named_by_(named_by) {
  const fs::path folder = folder_of(file_);
  settle(folder);
  require_replaceable();
  const std::lock_guard lock(making);
  while (descriptor_ < 0) {
    path_ = private_name(folder, "part");
    descriptor_ = open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (descriptor_ < 0 && errno != EEXIST) throw_file_error(shown(), "cannot be opened for writing");
    if (descriptor_ < 0) continue;
    // Another program that settled the folder between creation and lock has taken the file away. A file system may
    // know no locks.
    struct stat found {};
    const bool taken = flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    if (taken || fstat(descriptor_, &found) != 0 || found.st_nlink == 0) close(std::exchange(descriptor_, -1));
  }
  pid_ = getpid();
  in_the_making.insert(this);
}

Part::~Part() {
  const std::lock_guard lock(making);
  in_the_making.erase(this);
  if (!path_.empty()) unlink(path_.c_str());
  close(descriptor_);
}

void Part::require_replaceable() const {
  const bool holds_something = require_replaceable_kind(file_).st_size > 0;
  if (named_by_ == NamedBy::user) return;
  require_replaceable_kind(folder_of(file_) / checksums_name);
  if (!holds_something || is_own(read_checksums(folder_of(file_)), file_)) return;
  throw_file_error(file_, "cannot be replaced",
                   fmt::format("is no file of bookspin's ({} does not list it): move it away, or choose another folder",
                               checksums_name));
}

fs::path Part::shown() const {
  return kind_of(file_.filename().string()).empty() ? file_ : folder_of(file_);
}

void Part::take_name() {
  if (rename(path_.c_str(), file_.c_str()) != 0) throw_file_error(shown(), "cannot be renamed");
  path_.clear();
}

void Part::flush() const {
  if (fsync(descriptor_) != 0) throw_file_error(shown(), "cannot be flushed to the disk");
}

void abandon_parts() {
  making.lock();  // for good
  for (const Part* part : in_the_making) {
    if (part->pid_ == getpid() && !part->path_.empty()) unlink(part->path_.c_str());
  }
}

void publish(const std::vector<Part*>& parts, const fs::path& obsolete) {
  const fs::path folder = folder_of(parts.front()->file_);
  const auto name_of = [](const fs::path& file) { return file.filename().string(); };
  Checksums made;
  for (const Part* part : parts) {
    part->flush();
    if (part->named_by_ == NamedBy::program) made[name_of(part->file_)] = sha256_of(part->path_);
  }
  if (parts.size() == 1 && made.empty() && obsolete.empty()) {
    parts.front()->require_replaceable();
    const std::lock_guard lock(making);
    parts.front()->take_name();
    return;
  }
  std::vector<Part*> all = parts;
  Part list(folder / checksums_name);
  Part journal(private_name(folder, "undo"));

  const FolderLock lock(folder);
  for (const Part* part : parts) part->require_replaceable();
  Checksums checksums = read_checksums(folder);
  const bool obsolete_is_ours = fs::is_regular_file(fs::symlink_status(obsolete)) && is_own(checksums, obsolete);
  checksums.erase(name_of(obsolete));
  if (obsolete_is_ours || !made.empty()) {
    std::erase_if(checksums, [&](const auto& entry) { return !is_file(folder / entry.first); });
    made.merge(checksums);
    write_part(list, text_of(made));
    list.flush();
    all.push_back(&list);
  }
  std::vector<Step> steps;
  for (const Part* part : all) {
    struct stat found {};
    if (fstat(part->descriptor_, &found) != 0) throw_file_error(part->shown(), "cannot be renamed");
    const bool replaces = is_file(part->file_);
    steps.push_back({found.st_ino, name_of(part->file_), replaces ? name_of(private_name(folder, "old")) : ""});
  }
  if (obsolete_is_ours) steps.push_back({0, name_of(obsolete), name_of(private_name(folder, "old"))});
  write_part(journal, journal_of(steps));
  journal.flush();

  const std::lock_guard names(making);
  // From here to its removal the journal says how to go back: for us, or for whoever settles the folder after a kill.
  const auto remove_backups = [&] {
    for (const Step& step : steps) {
      if (!step.backup.empty()) removed(folder / step.backup);
    }
  };
  try {
    journal.take_name();
    lock.flush(folder);
    for (const Step& step : steps) {
      if (!step.backup.empty()) keep_as(folder / step.backup, folder / step.name);
    }
    for (Part* part : all) part->take_name();
    if (obsolete_is_ours && !removed(obsolete)) throw_file_error(obsolete, "cannot be removed");
    lock.flush(folder);
    if (!removed(journal.file_)) throw_file_error(folder, "its journal cannot be removed");
  } catch (...) {
    undo(folder, steps);
    if (removed(journal.file_)) remove_backups();
    throw;
  }
  remove_backups();
}

}  // namespace bookspin
