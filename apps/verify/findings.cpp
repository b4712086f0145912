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
  return found != checks_.end() ? *found : checks_.emplace_back(CheckSummary{.name = check});
}

void Findings::compare(const std::string& check, double value, double bound, const std::string& what) {
  // How near to its bound a value is; NaN is beyond.
  const auto share = [](double v, double b) { return v <= 0.0 ? 0.0 : v <= b ? v / b : infinity; };
  CheckSummary& sum = summary(check);
  if (sum.count++ == 0 || sum.bound == 0.0 || share(value, bound) > share(sum.value, sum.bound)) {
    sum.value = value;
    sum.bound = bound;
    sum.branch = branch_;
    sum.step = step_;
  }
  if (!(value <= bound)) add_failure(check, what, value, bound);
}

void Findings::require(const std::string& check, bool holds, const std::string& what) {
  ++summary(check).count;
  if (!holds) add_failure(check, what, {}, {});
}

void Findings::add_failure(const std::string& check, const std::string& what, std::optional<double> value,
                           std::optional<double> bound) {
  ++failures_;
  ++summary(check).failures;
  if (first_) return;
  first_ = Failure{.file = file_,
                   .branch = branch_,
                   .step = step_,
                   .what = what.empty() ? check : check + ": " + what,
                   .value = value,
                   .bound = bound};
}

}  // namespace arcwall::verify
