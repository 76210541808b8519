// The report: speed against error, stability limits, the instability, the paper's claims, the cost of a film's frame.
//
// Writes into `folder`: index.html, report.json (every table), NAME.csv of each table and NAME.svg of each plot. All
// files take their names together at the end: a report that fails leaves the one before as it was. Reads scene
// scripts, references, shaders, textures and the page's templates of `project`. quick: every file, every table with
// every method, in seconds: for tests, not for reading. Throws std::runtime_error (file, operation, reason).
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace bookspin {

using Tell = std::function<void(std::string_view what)>;  // what is being done: "2 of 7: springs"

struct ReportOrder {
  std::filesystem::path folder;  // made when missing
  std::filesystem::path project;
  bool quick = false;
  std::string commit{};  // of the program's sources; empty: not known
};

void make_report(const ReportOrder& order, const Tell& tell);

}  // namespace bookspin
