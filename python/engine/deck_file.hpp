#pragma once

#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "apps/output/files.hpp"
#include "core/error.hpp"
#include "model/deck/given_points.hpp"
#include "model/run_description.hpp"

namespace arcwall::python {

/// What a run of Python's is of. It has the whole path of the deck's file if there is such a file, and that has this
/// text.
inline RunDescription described(const std::string& file, const std::string& text,
                                const std::vector<std::string>& assignments) {
  RunDescription of{.deck = file, .deck_text = text, .assignments = assignments};
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return of;
  try {
    if (deck::read_deck_file(file) == text) of.deck_path = whole_path(file);
  } catch (const InputError&) {
    // A file that cannot be read is not the deck's.
  }
  return of;
}

}  // namespace arcwall::python
