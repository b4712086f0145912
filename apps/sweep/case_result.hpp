#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/sweep/case_list.hpp"

namespace arcwall::sweep {

/// What a case came to, read from its folder.
struct CaseResult {
  bool there = false;           ///< it has been run
  std::optional<int> status{};  ///< of `trace-path run`; empty if a signal ended it
  std::string reason{};         ///< `stop`, `min_step`, …, `wrong_input`, `crash`; see docs/sweep.md
  std::string detail{};         ///< of that reason; may be empty
  Json counts{};                ///< of result.json; null without it
  std::vector<Json> events{};   ///< as in events.json; empty without it

  /// Whether it does not tell what a sweep is for: neither did it end as its deck says, nor early behind its snap.
  bool failed() const;
};

/// Reads a case's results. OutputError if they are there but damaged.
CaseResult read_result(const std::filesystem::path& sweep_folder, int number);

/// Whether something outside hindered a case that has results: a full disk, too little memory, or somebody who killed
/// it. It may succeed another time.
bool was_hindered(const std::filesystem::path& sweep_folder, int number);

/// λ of the first event of one of these kinds.
std::optional<double> first_load(const CaseResult& result, const std::vector<std::string>& kinds);

/// λ of every limit point, those at changes of contact included, in the order of the events.
std::vector<double> limit_loads(const CaseResult& result);

/// The load under which the structure snaps: λ of the first limit point at which a stable path loses its stability.
std::optional<double> snap_load(const CaseResult& result);

}  // namespace arcwall::sweep
