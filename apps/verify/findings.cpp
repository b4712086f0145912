#include "apps/verify/findings.hpp"

#include <algorithm>
#include <utility>

namespace arcwall::verify {

void Findings::at(std::string file, Index branch, Index step) {
  file_ = std::move(file);
  branch_ = branch;
  step_ = step;
}

CheckSummary& Findings::summary(const std::string& check) {
  const auto found = std::find_if(checks_.begin(), checks_.end(), [&](const auto& one) { return one.name == check; });
  return found != checks_.end() ? *found : checks_.emplace_back(CheckSummary{.name = check, .bound = 1.0});
}

void Findings::compare(const std::string& check, double value, double bound, const std::string& what) {
  CheckSummary& sum = summary(check);
  const bool worst = sum.count++ == 0 || !(value * sum.bound <= sum.value * bound);
  if (worst) {
    sum.value = value;
    sum.bound = bound;
    sum.branch = branch_;
    sum.step = step_;
  }
  if (value <= bound) return;
  ++offences_;
  if (!first_)
    first_ = Offence{.file = file_,
                     .branch = branch_,
                     .step = step_,
                     .what = what.empty() ? check : check + ", " + what,
                     .value = value,
                     .bound = bound};
}

void Findings::require(const std::string& check, bool holds, const std::string& what) {
  compare(check, holds ? 0.0 : 1.0, 0.5, what);
}

}  // namespace arcwall::verify
