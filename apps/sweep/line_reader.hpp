#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "model/regular_file.hpp"

namespace arcwall::sweep {

/// The lines of a regular file, one after the other; the file is never in memory as a whole.
class LineReader {
 public:
  /// Throws OutputError.
  explicit LineReader(const std::filesystem::path& file) : file_(file) {}

  /// False at the end. What stands behind the last line break is no line: a process was writing it.
  bool next(std::string& line);

  /// Where the last line begins in the file.
  std::uintmax_t begin() const { return begin_; }

 private:
  RegularFile file_;
  std::string buffer_{};
  std::size_t used_ = 0;             // of the buffer
  std::uintmax_t buffer_begin_ = 0;  // in the file
  std::uintmax_t begin_ = 0;
};

}  // namespace arcwall::sweep
