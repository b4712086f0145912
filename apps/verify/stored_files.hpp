#pragma once

#include <string>
#include <vector>

#include "apps/verify/completeness.hpp"
#include "apps/verify/counts.hpp"
#include "apps/verify/point_checks.hpp"
#include "apps/verify/verify.hpp"

namespace arcwall::verify {

/// Rows of a CSV file without its header, cells without quotes.
std::vector<std::vector<std::string>> csv_rows(const std::string& text);

/// What a row of path.csv is held against.
struct PathExpectation {
  std::vector<std::string> names{};  ///< of the monitors
  std::vector<double> monitors{},
      allowed{};                         ///< recomputed, and how far the cells may be from it; infinite: not checked
  std::optional<Energy> energy{};        ///< empty: not checked
  std::optional<CountRange> unstable{};  ///< empty: not checked
  std::optional<CountRange> unstable_load_control{};
  Index contacts = 0;
  std::optional<Index> slipping{};     ///< of them, in decks with friction
  bool moves_supports = false;         ///< so that it has a column unstable_load_control
  std::optional<std::string> stage{};  ///< of a deck with stages
};

/// A row of path.csv against its point.
void check_path_row(const std::vector<std::string>& row, const RecordPoint& point, const PathExpectation& expected,
                    Findings& findings);

/// The rows of contacts.csv that belong to a point, from `next` on, which moves behind them.
void check_contact_rows(const std::vector<std::vector<std::string>>& rows, std::size_t& next, const RecordPoint& point,
                        const Touches& touches, const Model& model, Findings& findings);

/// events.json against the points; gives the events that belong to one.
std::vector<ListedEvent> check_events(const std::string& text, const Record& record, const Model& model,
                                      const WallsOfStages& walls, Findings& findings);

}  // namespace arcwall::verify
