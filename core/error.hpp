#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace arcwall {

/// One thing that is wrong with the input, where it stands and what would be right.
struct Diagnostic {
  std::string file{};     ///< as the user named it; empty: no file (a command line, a program's own model)
  int line = 0;           ///< counts from 1; 0: unknown
  int column = 0;         ///< counts from 1; 0: unknown
  std::string key{};      ///< dotted path of the key, e.g. `member.column.elements`; may be empty
  std::string message{};  ///< what is wrong, with the value that was found
  std::string cure{};     ///< what would be right; may be empty
};

/// `file:line:column: key: message; cure`, without the parts that are unknown.
std::string to_text(const Diagnostic& diagnostic);

/// The input is wrong. Carries every diagnostic found, never only the first; what() has one a line.
class InputError : public std::runtime_error {
 public:
  /// `diagnostics` must not be empty.
  explicit InputError(std::vector<Diagnostic> diagnostics);

  /// One diagnostic without a place.
  explicit InputError(const std::string& message);

  const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }

 private:
  std::vector<Diagnostic> diagnostics_;
};

/// A file cannot be written or read; what() names it and the system's reason.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace arcwall
