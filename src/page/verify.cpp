#include "page/verify.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "files/checksums.h"
#include "files/files.h"
#include "files/part.h"
#include "page/film_record.h"

namespace bookspin {
namespace {

namespace fs = std::filesystem;

std::string damage_of(const fs::path& file, const Checksums& listed) {
  if (!is_file(file)) return "is missing";
  if (!listed.contains(file.filename().string())) return fmt::format("is not listed in {}", checksums_name);
  return is_as_listed(listed, file) ? "" : "is not as it was made";
}

// The first of the film's products that is damaged, or not of the data's making; else how all were made.
Finding finding_of(const FilmRecord& film, const fs::path& folder, const Checksums& listed) {
  Finding finding{film.name + ".json", false, true, ""};
  for (const std::string& product : {finding.file, film.poster, film.film}) {
    if (product.empty()) continue;
    const std::string damage = damage_of(folder / product, listed);
    const auto wanted = film.sha256.find(product == film.film ? "film" : product == film.poster ? "poster" : "");
    const bool other = wanted != film.sha256.end() && damage.empty() && listed.at(product) != wanted->second;
    if (damage.empty() && !other) continue;
    finding.says = fmt::format("{} {}", product, other ? "is of another making than its data" : damage);
    return finding;
  }
  finding.whole = true;
  const auto met =
      std::count_if(film.expectations.begin(), film.expectations.end(), [](const auto& e) { return e.met; });
  finding.met = met == static_cast<std::ptrdiff_t>(film.expectations.size());
  finding.says = fmt::format("{}x{}, {} frames, {} of {} expectations met; by", film.width, film.height,
                             film.drawn_frames, met, film.expectations.size());
  for (const auto& [name, version] : film.versions) finding.says += fmt::format(" {} {},", name, version);
  finding.says.pop_back();
  return finding;
}

}  // namespace

std::vector<Finding> verify(const fs::path& folder) {
  settle(folder);
  const Checksums listed = read_checksums(folder);
  if (listed.empty()) {
    throw std::runtime_error(fmt::format("{}: holds nothing that bookspin has made: {} is missing or empty",
                                         folder.string(), checksums_name));
  }
  std::vector<Finding> findings;
  std::set<std::string> of_films;
  for (const auto& [name, digest] : listed) {
    if (fs::path(name).extension() != ".json" || !is_file(folder / name)) continue;
    try {
      const std::optional<FilmRecord> film = read_film_record(folder / name);
      if (!film) continue;
      findings.push_back(finding_of(*film, folder, listed));
      of_films.insert({name, film->poster, film->film});
    } catch (const std::invalid_argument& error) {
      findings.push_back({name, false, true, error.what()});
      of_films.insert(name);
    }
  }
  for (const auto& [name, digest] : listed) {
    if (of_films.contains(name)) continue;
    const std::string damage = damage_of(folder / name, listed);
    findings.push_back({name, damage.empty(), true, damage});
  }
  return findings;
}

}  // namespace bookspin
