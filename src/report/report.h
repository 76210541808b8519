// The report: speed against error, stability limits, the instability, the paper's claims, the cost of a film's frame.
//
// Writes into `folder`: index.html, report.json (every table), NAME.csv beside each plot NAME.svg and each table. Every
// file takes its name when it is complete, index.html last. Reads scene scripts, references, shaders and textures of
// `project`. quick: every file, every table with every method, in seconds: for tests, not for reading. Throws
// std::runtime_error (file, operation, reason).
#pragma once

#include <filesystem>

#include "report/measure.h"

namespace bookspin {

struct ReportOrder {
  std::filesystem::path folder;  // made when missing
  std::filesystem::path project;
  bool quick = false;
};

void make_report(const ReportOrder& order, const Tell& tell);

}  // namespace bookspin
