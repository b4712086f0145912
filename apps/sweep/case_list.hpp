#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/sweep/line_reader.hpp"
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

/// The cases of a planned folder one after the other, which need not be in memory together.
class CaseReader {
 public:
  /// InputError if the folder is no planned one, OutputError if its list cannot be read.
  explicit CaseReader(const std::filesystem::path& folder);

  /// Empty at the end. Cases are numbered from 0 in the order of their lines; throws InputError where they are not.
  std::optional<Case> next();

  /// Passes over the next case without a look at what it is. False at the end.
  bool skip();

 private:
  LineReader lines_;
  std::filesystem::path file_;
  int number_ = 0;
};

/// How many cases a planned folder has. Throws as CaseReader does, and OutputError if there is none.
std::size_t count_cases(const std::filesystem::path& folder);

/// Numbers as they are written everywhere, texts without quotes, the rest as TOML: for tables and labels.
std::string label(const Json& value);

}  // namespace arcwall::sweep
