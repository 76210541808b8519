// A file in the making. It grows in its final folder under a private name, ".bookspin-PID-N.part", which no other
// program can have, and is gone unless it is published.
//
// The constructor makes the file, empty, and throws when the final name cannot be replaced by it: a folder, a device, a
// FIFO, a symbolic link, a name too long; and a file of the user's under a name that the program has chosen
// (its own: checksums.h). publish() gives all parts their names, or on any error none: what stands there then is
// what stood there. The parts must be in one folder. A program that is killed leaves files whose names begin with
// ".bookspin-", locked by nobody: the next Part in that folder, or settle(), takes back what it had half published and
// removes them. Throws std::runtime_error "FILE: what failed: the system's reason".
#pragma once

#include <filesystem>
#include <vector>

namespace bookspin {

enum class NamedBy { user, program };

class Part {
 public:
  explicit Part(std::filesystem::path file, NamedBy named_by = NamedBy::user);
  ~Part();
  Part(const Part&) = delete;
  Part& operator=(const Part&) = delete;

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }  // the name it will have
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }  // where to write it
  [[nodiscard]] std::filesystem::path shown() const;  // in messages: a file of the transaction is its folder

 private:
  friend void publish(const std::vector<Part*>& parts, const std::filesystem::path& obsolete);
  friend void abandon_parts();
  void require_replaceable() const;
  void flush() const;
  void take_name();

  std::filesystem::path file_;
  NamedBy named_by_;
  std::filesystem::path path_;  // empty: published
  int descriptor_ = -1;         // holds the lock
  int pid_ = 0;                 // of the process that made it, whose children know of it
};

// `obsolete`, if any, is a file of that folder that goes when the parts come, if it is the program's own.
void publish(const std::vector<Part*>& parts, const std::filesystem::path& obsolete = {});

void settle(const std::filesystem::path& folder);

// For a process that ends although its work goes on: waits while another thread gives parts their names, removes what
// else this process has in the making, and keeps that thread from making or publishing anything more.
void abandon_parts();

}  // namespace bookspin
