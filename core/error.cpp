#include "core/error.hpp"

#include <cassert>

namespace arcwall {

namespace {

std::string one_a_line(const std::vector<Diagnostic>& diagnostics) {
  std::string text;
  for (const Diagnostic& diagnostic : diagnostics) {
    if (!text.empty()) text += '\n';
    text += to_text(diagnostic);
  }
  return text;
}

}  // namespace

std::string to_text(const Diagnostic& diagnostic) {
  std::string text = diagnostic.file;
  if (diagnostic.line > 0) text += (text.empty() ? "line " : ":") + std::to_string(diagnostic.line);
  if (diagnostic.line > 0 && diagnostic.column > 0) text += ":" + std::to_string(diagnostic.column);
  if (!diagnostic.key.empty()) text += (text.empty() ? "" : ": ") + diagnostic.key;
  if (!text.empty()) text += ": ";
  text += diagnostic.message;
  if (!diagnostic.cure.empty()) text += "; " + diagnostic.cure;
  return text;
}

InputError::InputError(std::vector<Diagnostic> diagnostics)
    : std::runtime_error(one_a_line(diagnostics)), diagnostics_(std::move(diagnostics)) {
  assert(!diagnostics_.empty());
}

InputError::InputError(const std::string& message)
    : InputError(std::vector<Diagnostic>{Diagnostic{.message = message}}) {}

}  // namespace arcwall
