// The list of the paper's claims: what each says, how it is tried, and what its numbers mean.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "report/claims.h"
#include "scene/judge.h"

namespace bookspin {

struct Trial {
  std::string script;
  std::vector<std::string> overrides;
  std::string expect;  // one inline table, with one bound
};

struct Answer {
  const char* verdict;
  std::string measured;
};

using Found = std::vector<Verdict>;

struct Claim {
  const char* section;
  const char* text;
  std::vector<Trial> trials;  // none: the numbers are those of other parts of the report
  std::function<Answer(const Found& found, const Facts& facts)> answer;
};

[[nodiscard]] std::vector<Claim> claims_of_the_paper(bool quick);

}  // namespace bookspin
