#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "model/record.hpp"

namespace arcwall {

enum class Progress { shown, hidden };

/// Hidden unless standard error is a terminal and NO_COLOR is not set.
Progress progress_wanted();

/// One line on standard error, rewritten at most ten times a second and gone in the end.
class ProgressLine {
 public:
  explicit ProgressLine(Progress progress) : progress_(progress) {}
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ~ProgressLine();

  /// Shows the last point of the record, and what λ is there (see names_of_lambda()).
  void show(const Record& record, const std::vector<std::string>& lambda_is);

  void show(const std::string& text);

 private:
  using Clock = std::chrono::steady_clock;

  bool is_due() const;

  Progress progress_;
  Clock::time_point last_{};  // when it was written
  bool visible_ = false;
};

/// `branch 0  123 points  λ=1.25 (way of hill)  mid=0.1  unstable 0  contacts 3`, of the record up to one of its
/// points, with what λ is in each stage where that is known.
std::string progress_text(const Record& record, const RecordPoint& point, const std::vector<std::string>& lambda_is);

}  // namespace arcwall
