// A file in the making. It grows in its final folder under a private name, ".bookspin-PID-N.part", which no other
// program can have, and is gone unless it is published.
//
// The constructor makes the file, empty, and throws when the final name cannot be replaced by it: a folder, a device, a
// FIFO, a symbolic link, a name too long. The part is locked while it lives: what a killed program left is nobody's,
// and is removed by the next Part in that folder. publish() flushes all parts to the disk and then renames them, in
// their order; whoever publishes in that folder at the same time comes before all of them or after. All parts must be
// in one folder. Throws std::runtime_error "FILE: what failed: the system's reason".
#pragma once

#include <filesystem>
#include <vector>

namespace bookspin {

class Part {
 public:
  explicit Part(std::filesystem::path file);
  ~Part();
  Part(const Part&) = delete;
  Part& operator=(const Part&) = delete;

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }  // the name it will have
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }  // where to write it

 private:
  friend void publish(const std::vector<Part*>& parts, const std::filesystem::path& obsolete);

  std::filesystem::path file_;
  std::filesystem::path path_;  // empty: published
  int descriptor_ = -1;         // holds the lock
};

// `obsolete`, if any, is a file of that folder that goes when the parts come.
void publish(const std::vector<Part*>& parts, const std::filesystem::path& obsolete = {});

}  // namespace bookspin
