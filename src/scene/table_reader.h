// Reads the keys of one TOML table with their limits, and knows which of them nobody asked for.
//
// All failures throw std::invalid_argument: "file:line:column: key: found ...; allowed: ...".
#pragma once

#include <Eigen/Core>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/toml.h"

namespace bookspin {

struct Range {
  double least;
  double most;
  bool least_excluded = false;
};

inline constexpr double largest_number = 1e6;  // a larger one is a slip of the pen

class TableReader {
 public:
  TableReader(const toml::table& table, std::string path) : table_(table), path_(std::move(path)) {}

  [[nodiscard]] bool has(std::string_view key) const { return table_.contains(key); }

  // Each leaves `value` alone when the table lacks the key.
  void read(std::string_view key, std::string& value);
  void read(std::string_view key, bool& value);
  void read(std::string_view key, int& value, int least, int most);
  void read(std::string_view key, double& value, Range range);
  void read(std::string_view key, std::optional<double>& value, Range range);
  void read(std::string_view key, Eigen::Vector3d& value, Range each);

  // Index of the word found, `otherwise` when the table lacks the key.
  [[nodiscard]] std::size_t read_word(std::string_view key, std::span<const std::string_view> words,
                                      std::size_t otherwise);

  // Indices of the words in a list; empty when the table lacks the key.
  [[nodiscard]] std::vector<std::size_t> read_words(std::string_view key, std::span<const std::string_view> words);

  const toml::node* node(std::string_view key);  // nullptr: absent; either way the key counts as known

  // An error for every key that was not read.
  void done() const;

  [[noreturn]] void fail(const toml::node& at, std::string_view key, std::string_view allowed) const;
  [[noreturn]] void fail_missing(std::string_view key, std::string_view allowed) const;
  [[nodiscard]] std::string full_key(std::string_view key) const;

 private:
  const toml::table& table_;
  std::string path_;  // dotted, of the table itself; empty: the root
  std::set<std::string, std::less<>> known_;
};

// "file:line:column: ", or "--set book.0.method=matrix: " for a value that came from there.
[[nodiscard]] std::string location(const toml::source_region& source);

// A node as it would be written, shortened.
[[nodiscard]] std::string shown(const toml::node& node);

}  // namespace bookspin
