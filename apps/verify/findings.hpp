#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/types.hpp"

namespace arcwall::verify {

/// What does not hold.
struct Failure {
  std::string file{};
  Index branch = 0, step = 0;
  std::string what{};
  std::optional<double> value{}, bound{};  ///< empty of what merely is not so
};

/// The worst of one kind of check.
struct CheckSummary {
  std::string name{};
  Index count = 0;                  ///< of values that were compared
  double value = 0.0, bound = 0.0;  ///< where value/bound is largest
  Index branch = 0, step = 0;       ///< likewise
  Index failures = 0;               ///< values that do not hold
};

/// What was compared, and the first that does not hold.
class Findings {
 public:
  /// Where the values that follow belong; `branch` is −1 of a curve of events, whose points are the steps.
  void at(std::string file, Index branch, Index step);

  /// A value that must not exceed its bound; NaN does. `what` says which of the check's values it is.
  void compare(const std::string& check, double value, double bound, const std::string& what = {});

  /// Something that is or is not so.
  void require(const std::string& check, bool holds, const std::string& what);

  const std::vector<CheckSummary>& checks() const { return checks_; }
  const std::optional<Failure>& first() const { return first_; }
  Index failures() const { return failures_; }

 private:
  CheckSummary& summary(const std::string& check);
  void add_failure(const std::string& check, const std::string& what, std::optional<double> value,
                   std::optional<double> bound);

  std::string file_{};
  Index branch_ = 0, step_ = 0, failures_ = 0;
  std::vector<CheckSummary> checks_{};
  std::optional<Failure> first_{};
};

}  // namespace arcwall::verify
