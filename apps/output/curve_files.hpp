#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "answers/event_curve.hpp"
#include "answers/worst_combination.hpp"
#include "apps/output/curve_page.hpp"
#include "apps/output/exit_status.hpp"
#include "apps/output/files.hpp"
#include "model/run_description.hpp"

namespace arcwall {

/// curve.csv: a row a point, from one end of the curve to the other.
std::string curve_csv(const EventCurve& curve, UnitLabels labels);

/// curve.json: what was followed, and the special points. `run`: the deck that was followed.
nlohmann::ordered_json curve_json(const EventCurve& curve, const RunDescription& run);

/// The files of a curve by their names, in the order in which they are written: curve.csv, report.html, curve.json.
/// `loads`: what λ multiplies.
using NamedTexts = std::vector<std::pair<std::string, std::string>>;
NamedTexts curve_files(const EventCurve& curve, const std::vector<LoadText>& loads, UnitLabels labels,
                       const RunDescription& run);

/// Throws OutputError if a folder is that of a run, whose report.html the curve's would replace, and that is to be
/// refused.
void require_no_run(const std::filesystem::path& folder, Foreign foreign);

/// What the command shows: the special points as a table.
std::string curve_text(const EventCurve& curve);

/// What is followed, and over which number: `limit-point 1 over wall.upper.profile.z`.
std::string followed_event(const EventCurve& curve);

/// curve.json of the worst combination of numbers, and what the command shows of it.
nlohmann::ordered_json worst_json(const deck::Deck& deck, const WorstCombination& worst, const RunDescription& run);
std::string worst_text(const deck::Deck& deck, const WorstCombination& worst);

/// The status of a curve by the reasons of its ends.
ExitStatus curve_status(const EventCurve& curve);

}  // namespace arcwall
