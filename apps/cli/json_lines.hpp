#pragma once

#include "model/record.hpp"

namespace arcwall {

/// Points, events and ends of a record on standard output as they come, one JSON object a line.
class JsonLines {
 public:
  /// What is in `record` already is not printed.
  explicit JsonLines(const Record& record);

  void print_new(const Record& record);

 private:
  std::size_t branch_ = 0, points_ = 0, events_ = 0;
};

}  // namespace arcwall
