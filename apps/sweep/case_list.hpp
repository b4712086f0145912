#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "apps/sweep/sweep_file.hpp"

namespace arcwall::sweep {

/// One run of a sweep.
struct Case {
  int number = 0;                                   ///< counts from 0
  std::string deck{};                               ///< file in the sweep's folder
  std::vector<std::pair<std::string, Json>> set{};  ///< keys of the deck and their values, the varied ones first
};

/// The files of a planned sweep's folder.
inline constexpr const char* sweep_file_name = "sweep.toml";
inline constexpr const char* case_list_name = "cases.jsonl";

/// A value as `--set` takes it.
std::string toml_text(const Json& value);

/// `key=value` for each value of the case, as of `--set`.
std::vector<std::string> assignments(const Case& one);

/// The cases of a sweep; `deck` is the deck's file name in the sweep's folder.
std::vector<Case> cases(const Sweep& sweep, const std::string& deck);

/// cases.jsonl: one object a line.
std::string to_text(const std::vector<Case>& cases);

/// The cases of a planned folder, numbered from 0 in the order of their lines. InputError if it is none,
/// OutputError if its list cannot be read or is empty.
std::vector<Case> read_cases(const std::filesystem::path& folder);

/// Numbers as they are written everywhere, texts without quotes, the rest as TOML: for tables and labels.
std::string label(const Json& value);

}  // namespace arcwall::sweep
