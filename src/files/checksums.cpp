#include "files/checksums.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <fstream>
#include <initializer_list>
#include <sstream>

#include "files/files.h"

namespace bookspin {
namespace {

namespace fs = std::filesystem;
using Word = std::uint32_t;

// The first 32 bits of the fractional parts of the cube roots of the first 64 primes.
constexpr std::array<Word, 64> round_constants{
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

void add_block(std::array<Word, 8>& hash, std::string_view block) {
  std::array<Word, 64> w{};
  for (std::size_t i = 0; i < 64; ++i) w[i / 4] = w[i / 4] << 8U | static_cast<unsigned char>(block[i]);
  for (std::size_t i = 16; i < 64; ++i) {
    const Word s0 = std::rotr(w[i - 15], 7) ^ std::rotr(w[i - 15], 18) ^ w[i - 15] >> 3U;
    const Word s1 = std::rotr(w[i - 2], 17) ^ std::rotr(w[i - 2], 19) ^ w[i - 2] >> 10U;
    w[i] = w[i - 16] + s0 + w[i - 7] + s1;
  }
  auto [a, b, c, d, e, f, g, h] = hash;
  for (std::size_t i = 0; i < 64; ++i) {
    const Word s1 = std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25);
    const Word t1 = h + s1 + ((e & f) ^ (~e & g)) + round_constants[i] + w[i];
    const Word s0 = std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22);
    const Word t2 = s0 + ((a & b) ^ (a & c) ^ (b & c));
    h = g, g = f, f = e, e = d + t1, d = c, c = b, b = a, a = t1 + t2;
  }
  const std::array<Word, 8> sums{a, b, c, d, e, f, g, h};
  for (std::size_t i = 0; i < 8; ++i) hash[i] += sums[i];
}

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

std::string sha256(std::istream& in) {
  // The first 32 bits of the fractional parts of the square roots of the first 8 primes.
  std::array<Word, 8> hash{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                           0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<char, 64> block{};
  std::uint64_t bits = 0;
  while (in.read(block.data(), block.size())) {
    add_block(hash, {block.data(), block.size()});
    bits += 512;
  }
  std::string end(block.data(), static_cast<std::size_t>(in.gcount()));  // then a one, zeros, and the number of bits
  bits += 8 * end.size();
  end += '\x80';
  while (end.size() % 64 != 56) end += '\0';
  for (int shift = 56; shift >= 0; shift -= 8) end += static_cast<char>(bits >> static_cast<unsigned>(shift) & 0xffU);
  for (std::size_t i = 0; i < end.size(); i += 64) add_block(hash, std::string_view(end).substr(i));
  std::string digits;
  for (const Word word : hash) digits += fmt::format("{:08x}", word);
  return digits;
}

}  // namespace

std::string sha256(const std::string& bytes) {
  std::istringstream in(bytes);
  return sha256(in);
}

std::string sha256_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string digits = in ? sha256(in) : "";
  if (!in.eof() || in.bad()) throw_file_error(file, "cannot be read");
  return digits;
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
  return fs::is_regular_file(file) ? parse_checksums(read_file(file)) : Checksums();
}

bool is_as_listed(const Checksums& listed, const fs::path& file) {
  const auto entry = listed.find(file.filename().string());
  return entry != listed.end() && fs::is_regular_file(file) && entry->second == sha256_of(file);
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
    return has_all(data, {fmt::format("\n \"{}\": {}", kind == ".mp4" ? "film" : "poster", '"' + name + '"')});
  }
  const std::string report = text_in(file.parent_path() / "report.json");
  return is_report_data(report) && (has_all(report, {fmt::format("\n \"{}\": [", file.stem().string())}) ||
                                    has_all(text_in(file.parent_path() / "index.html"), {'"' + name + '"'}));
}

}  // namespace bookspin
