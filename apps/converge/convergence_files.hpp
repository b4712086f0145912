#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "apps/converge/convergence.hpp"

namespace arcwall {

/// Which deck a study is of: its text, and what `--set` changed.
struct StudiedDeck {
  std::string_view text{};
  std::string path{};  ///< whole; empty where the text is not from a file
  const std::vector<std::string>& assignments;
};

/// convergence.json
nlohmann::ordered_json convergence_json(const Convergence& study, const StudiedDeck& of);

/// convergence.txt: the meshes and the events as tables for people.
std::string convergence_text(const Convergence& study);

/// What a run says of the error bars that a convergence.json in its folder has for its events: a table for people.
/// Empty where there is no such file, or it is of another deck.
std::string error_bars_text(const std::filesystem::path& folder, const Record& record, const StudiedDeck& of);

}  // namespace arcwall
