#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/verify/findings.hpp"
#include "model/model.hpp"
#include "model/record.hpp"

namespace arcwall::verify {

/// An event as events.json has it.
struct ListedEvent {
  std::string kind{};
  Index branch = -1, step = -1;
  std::optional<Index> unstable_before{}, unstable_after{};
  double lambda_uncertainty = 0.0;  ///< half-width in λ of what is left uncertain
  bool unconfirmed = false;
  std::string monitor{};                 ///< of a turning point or a value crossing
  std::optional<double> value{};         ///< of a value crossing
  std::vector<ContactLabel> contacts{};  ///< that change
};

/// Whether the list of events tells all that changes along the points, and nothing that does not:
///
/// - the number of unstable directions changes at events only, and by what they say;
/// - every contact that is there at one point and not at the next, or the reverse, is named by an event of either;
/// - λ, and each watched monitor, turns at events only, and turns there;
/// - each watched value is passed at an event only, and passed there;
/// - no point is beyond a bound of path.stop.
///
/// What happens and is undone between two points is not seen.
void check_completeness(const std::vector<ListedEvent>& events, const Record& record, const Model& model,
                        Findings& findings);

/// The number of the point at which contact has changed that makes a stretch, if that stretch is not there yet at a
/// later point: where it would be too short for its unknowns, target values are landed on with the contacts of before.
/// Else the number of the later point itself.
///
/// `points`: contacts slide in them. `makes_stretch`: whether a step has such a change.
std::size_t change_before(std::span<const RecordPoint> points, std::size_t point,
                          const std::function<bool(Index step)>& makes_stretch);

}  // namespace arcwall::verify
