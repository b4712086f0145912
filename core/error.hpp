#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace arcwall {

/// Describes one error of the input: location, cause and cure.
struct Diagnostic {
  std::string file{};     ///< as the user named it; empty: no file (a command line, a program's own model)
  int line = 0;           ///< counts from 1; 0: unknown
  int column = 0;         ///< counts from 1; 0: unknown
  std::string key{};      ///< dotted path of the key, e.g. `member.column.elements`; may be empty
  std::string message{};  ///< what is wrong, with the value that was found
  std::string cure{};     ///< what would be right; may be empty
};

/// Returns `file:line:column: key: message; cure`, without the unknown parts.
std::string to_text(const Diagnostic& diagnostic);

/// Reports wrong input with all diagnostics found; what() has one a line.
class InputError : public std::runtime_error {
 public:
  /// `diagnostics` must not be empty.
  explicit InputError(std::vector<Diagnostic> diagnostics);

  /// Makes one diagnostic without file, line and key.
  explicit InputError(const std::string& message);

  const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }

 private:
  std::vector<Diagnostic> diagnostics_;
};

/// Reports a file that cannot be written or read; what() names the file and the system's reason.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace arcwall
