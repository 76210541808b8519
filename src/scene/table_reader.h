// Reads the keys of one TOML table with their limits. A key is declared where it is read, with its meaning: the same
// declarations are what an unknown key is held against, the manual and the schema (reference.h).
//
// All failures throw std::invalid_argument: "file:line:column: key: found ...; allowed: ...".
#pragma once

#include <Eigen/Core>
#include <optional>
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

using Words = std::vector<std::string_view>;

// The names in a table.
[[nodiscard]] Words names_of(const auto& table) {
  Words names;
  for (const auto& row : table) names.push_back(row.name);
  return names;
}

struct Key {
  std::string name;
  std::string meaning;
  std::string allowed;      // in words
  std::string schema;       // members of its JSON schema
  std::string otherwise{};  // the default, as TOML and JSON write it; empty: none
  std::string manual{};     // what the manual says in place of `allowed`; empty: that
  bool needed = false;
};

struct KeyTable {
  std::string name;  // "clip", "book"; empty: the root
  std::vector<Key> keys;
};

class TableReader {
 public:
  // The root of a script. `record`: where done() puts the keys that were declared, once for tables of one name.
  explicit TableReader(const toml::table& table, std::vector<KeyTable>* record = nullptr)
      : table_(&table), record_(record) {}

  [[nodiscard]] bool has(std::string_view key) const { return table_->contains(key); }

  // Each leaves `value`, the default, alone when the table lacks the key.
  void read(std::string_view key, std::string& value, const char* meaning);
  void read(std::string_view key, bool& value, const char* meaning);
  void read(std::string_view key, int& value, int least, int most, const char* meaning);
  void read(std::string_view key, std::optional<int>& value, int least, int most, const char* meaning);
  void read(std::string_view key, double& value, Range range, const char* meaning);
  void read(std::string_view key, std::optional<double>& value, Range range, const char* meaning);
  void read(std::string_view key, Eigen::Vector3d& value, Range each, const char* meaning);
  // One number for each name in "w, x, y, z"; whether they are there.
  bool read(std::string_view key, std::span<double> values, const char* names, Range each, const char* meaning);

  // Index of the word found, 0 when the table lacks the key; indices of the words in a list, none when it does.
  [[nodiscard]] std::size_t read_word(std::string_view key, const Words& words, const char* meaning,
                                      const char* manual = "");
  [[nodiscard]] std::vector<std::size_t> read_words(std::string_view key, const Words& words, const char* meaning,
                                                    const char* manual = "");

  // Readers of [key], one or none; of [[key]], one for each.
  [[nodiscard]] std::vector<TableReader> table(std::string_view key, const char* meaning);
  [[nodiscard]] std::vector<TableReader> tables(std::string_view key, const char* meaning);

  // What is read in another way; nullptr: absent.
  const toml::node* declare(Key key);

  void need(std::string_view key);  // declared before; an error when it is absent

  // An error for a key that was not declared.
  void done() const;

  [[noreturn]] void fail(std::string_view key, std::string_view allowed = "") const;  // empty: as declared
  // `allowed` and the word of `words`, if any, that the one found is near to.
  [[noreturn]] void fail_word(const toml::node& at, std::string_view key, const Words& words,
                              std::string allowed) const;
  [[noreturn]] void fail_missing(std::string_view key, std::string_view allowed) const;

 private:
  [[noreturn]] void fail(const toml::node& at, std::string_view key, std::string_view allowed) const;
  [[nodiscard]] std::string full_key(std::string_view key) const;
  [[nodiscard]] const Key& declared(std::string_view key) const;

  const toml::table* table_;
  std::string path_;  // dotted, of the table itself; empty: the root
  std::vector<Key> keys_;
  std::vector<KeyTable>* record_;
};

// "file:line:column: ", or "--set book.0.method=matrix: " for a value that came from there.
[[nodiscard]] std::string location(const toml::source_region& source);

}  // namespace bookspin
