#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "core/error.hpp"

namespace arcwall::deck {

/// More than any deck needs, less than any parser chokes on.
struct TextLimits {
  std::size_t bytes = 16u << 20u;
  std::size_t line_bytes = 1u << 20u;
  int depth = 32;      ///< of brackets and braces in each other
  int key_parts = 32;  ///< of one dotted key
};

/// What forbids to hand the text to a TOML parser, with its line and column, or nothing: a limit, a byte that is not
/// UTF-8, a control character, a table header without a name.
std::optional<Diagnostic> precheck(std::string_view text, const TextLimits& limits = {});

}  // namespace arcwall::deck
