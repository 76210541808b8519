#include "files/checksums.h"

#include <fmt/format.h>
#include <sha2.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>

#include "files/files.h"

namespace bookspin {
namespace {

namespace fs = std::filesystem;

// A newline would end the line; a backslash introduces what stands for one.
std::string escaped(const std::string& name) {
  std::string out;
  for (const char c : name) out += c == '\\' ? "\\\\" : c == '\n' ? "\\n" : c == '\r' ? "\\r" : std::string(1, c);
  return out;
}

std::string unescaped(std::string_view name) {
  std::string out;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const bool escape = name[i] == '\\' && i + 1 < name.size();
    const char c = escape ? name[++i] : name[i];
    out += escape && c == 'n' ? '\n' : escape && c == 'r' ? '\r' : c;
  }
  return out;
}

// Nothing for what is not there, or too large to be text of ours.
std::string text_in(const fs::path& file) try { return read_file(file); } catch (const std::runtime_error&) {
  return {};
}

bool has_all(std::string_view text, std::initializer_list<std::string_view> parts) {
  return std::all_of(parts.begin(), parts.end(),
                     [text](std::string_view part) { return text.find(part) != text.npos; });
}

// As the versions without lists wrote their JSON: outermost keys behind a newline and a space, where no text has any.
bool is_film_data(std::string_view text) {
  return (text.starts_with("{\n \"format\": \"bookspin film") || text.starts_with("{\n \"title\": ")) &&
         has_all(text, {"\n \"made_with\": {", "\n \"clip\": {", "\n \"script\": \"", "\n \"books\": ["});
}

bool is_report_data(std::string_view text) {
  return text.starts_with("{\n \"") &&
         has_all(text, {"\n \"processor\": \"", "\n \"compiler\": \"", "\n \"flags\": \""});
}

bool is_page(std::string_view text) {
  return has_all(text, {"<title>The unstable rotation of a book</title>"}) ||
         has_all(text, {"content=\"Films of a book that tumbles in space, each with its chart"}) ||
         has_all(text, {"<title>A tumbling book: speed against error</title>"});
}

}  // namespace

std::string sha256(const std::string& bytes) {
  std::array<char, SHA256_DIGEST_STRING_LENGTH> digits{};
  return SHA256Data(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), digits.data());
}

std::string sha256_of(const fs::path& file) {
  std::array<char, SHA256_DIGEST_STRING_LENGTH> digits{};
  if (SHA256File(file.c_str(), digits.data()) == nullptr) throw_file_error(file, "cannot be read");
  return digits.data();
}

Checksums parse_checksums(std::string_view text) {
  Checksums checksums;
  while (!text.empty()) {
    std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    const bool escape = line.starts_with('\\');
    if (escape) line.remove_prefix(1);
    const std::string_view digest = line.substr(0, 64);
    if (line.size() < 67 || line.substr(64, 2) != "  ") continue;
    if (digest.find_first_not_of("0123456789abcdef") != std::string_view::npos) continue;
    const std::string name(line.substr(66));
    checksums[escape ? unescaped(name) : name] = digest;
  }
  return checksums;
}

std::string text_of(const Checksums& checksums) {
  std::string text;
  for (const auto& [name, digest] : checksums) {
    const std::string written = escaped(name);
    text += fmt::format("{}{}  {}\n", written == name ? "" : "\\", digest, written);
  }
  return text;
}

Checksums read_checksums(const fs::path& folder) {
  const fs::path file = folder / checksums_name;
  return is_file(file) ? parse_checksums(read_file(file)) : Checksums();
}

bool is_as_listed(const Checksums& listed, const fs::path& file) {
  const auto entry = listed.find(file.filename().string());
  return entry != listed.end() && is_file(file) && entry->second == sha256_of(file);
}

bool is_own(const Checksums& listed, const fs::path& file) {
  const std::string name = file.filename().string();
  const std::string kind = file.extension().string();
  if (listed.contains(name)) return true;
  if (name == "index.html") return is_page(text_in(file));
  const std::string data = text_in(fs::path(file).replace_extension(".json"));
  if (kind == ".json") return is_film_data(data) || is_report_data(data);
  if (is_film_data(data)) {
    if (kind == ".vtt") return text_in(file).starts_with("WEBVTT\n");
    return has_all(data, {fmt::format("\n \"{}\": {}", kind == ".png" ? "poster" : "film", '"' + name + '"')});
  }
  const std::string report = text_in(file.parent_path() / "report.json");
  return is_report_data(report) && (has_all(report, {fmt::format("\n \"{}\": [", file.stem().string())}) ||
                                    has_all(text_in(file.parent_path() / "index.html"), {'"' + name + '"'}));
}

}  // namespace bookspin
