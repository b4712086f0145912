#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/sweep/case_list.hpp"

namespace arcwall::sweep {

/// What a case came to, read from its folder.
struct CaseResult {
  bool there = false;           ///< it has been run
  std::optional<int> status{};  ///< of `trace-path run`; empty if a signal ended it
  std::string reason{};         ///< `stop`, `min_step`, …, `wrong_input`, `crash`; see docs/reference/sweep.md
  std::string detail{};         ///< of that reason; may be empty
  Json counts{};                ///< of result.json; null without it
  std::vector<Json> events{};   ///< as in events.json; of a curve its special points, as in curve.json
  std::vector<std::pair<double, double>> curve{};  ///< of a curve its points: the number and λ

  /// Whether it does not tell what a sweep is for: neither did it end as its deck says, nor early behind its snap.
  bool failed() const;
};

/// What the process of a case came to besides its outputs, as it stands in case.json.
struct CaseEnd {
  int number = 0;
  Json set{};                            ///< values of the keys
  std::vector<std::string> options{};    ///< of `trace-path run`
  std::optional<double> most_seconds{};  ///< that it was given
  std::optional<int> status{};           ///< empty if a signal ended it
  int signal = 0;                        ///< 0: none
  bool overdue = false;                  ///< it was killed because it did not stop in time

  Json json() const;

  /// Whether something outside hindered it: a full disk, too little memory, or somebody who killed it. It may succeed
  /// another time.
  bool was_hindered() const;
};

/// The same of case.json; empty if it is none.
std::optional<CaseEnd> read_case_end(const Json& json);

/// Reads what a case wrote into a folder, and how its process ended. OutputError if files are damaged.
CaseResult read_folder(const std::filesystem::path& folder, const CaseEnd& end);

/// The members of a case's record, and the result that such members tell. Throws Json::exception of others.
Json record_of(const CaseEnd& end, const CaseResult& result);
CaseResult result_of_record(const Json& record);

/// λ of the first event of one of these kinds, or a monitor there, where one is named.
std::optional<double> first_load(const CaseResult& result, const std::vector<std::string>& kinds,
                                 const std::string& monitor = {});

/// λ of every limit point, those at changes of contact included, in the order of the events.
std::vector<double> limit_loads(const CaseResult& result);

/// The load under which the structure snaps: λ of the first limit point at which a stable path loses its stability.
/// Or a monitor there, where one is named.
std::optional<double> snap_load(const CaseResult& result, const std::string& monitor = {});

}  // namespace arcwall::sweep
