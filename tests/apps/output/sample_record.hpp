#pragma once

#include "model/record.hpp"

namespace arcwall {

/// One branch of three points: the start, a corner where three contacts close and λ turns, and the end at a stop.
inline Record sample_record() {
  Record record{
      .deck = "sample.toml", .title = "A sample", .energy_unit = "kN cm", .columns = {{"mid", "cm"}, {"turn", "rad"}}};
  record.branches.push_back({.id = 0,
                             .points = 3,
                             .least_lambda = 0.0,
                             .greatest_lambda = 0.1,
                             .end = BranchEnd{EndReason::stop, "mid = 0.2"}});
  const StabilityCount stable{.unstable = 0, .stability = Stability::stable};
  record.points.push_back({.monitors = {0.0, -0.0}, .count = stable, .iterations = 1, .event = EventKind::start});
  record.points.push_back({.step = 1,
                           .arc = 0.30000000000000004,
                           .lambda = 0.1,
                           .monitors = {1.0 / 3.0, 1e-300},
                           .contacts = 3,
                           .energy = -2.5,
                           .iterations = 4,
                           .event = EventKind::contact_limit_point});
  record.points.push_back({.step = 2,
                           .arc = 0.5,
                           .lambda = 0.05,
                           .monitors = {0.2, infinity},
                           .count = {.unstable = 1, .stability = Stability::unstable},
                           .contacts = 3,
                           .energy = -3.0,
                           .iterations = 2,
                           .event = EventKind::end});
  const auto contact = [](double fraction) {
    return RecordContact{.label = {.wall = "upper", .member = "column", .fraction = fraction}, .x = 2.0 * fraction};
  };
  record.events.push_back({.id = 0, .monitors = {0.0, -0.0}, .unstable_before = 0, .unstable_after = 0});
  record.events.push_back({.id = 1,
                           .kind = EventKind::contact_closes,
                           .step = 1,
                           .arc = 0.30000000000000004,
                           .lambda = 0.1,
                           .monitors = {1.0 / 3.0, 1e-300},
                           .unstable_before = 0,
                           .contacts = {contact(0.25), contact(0.5), contact(0.75), contact(0.875)}});
  record.events.push_back({.id = 2,
                           .kind = EventKind::contact_limit_point,
                           .step = 1,
                           .arc = 0.30000000000000004,
                           .lambda = 0.1,
                           .monitors = {1.0 / 3.0, 1e-300},
                           .unstable_before = 0,
                           .unstable_after = 1});
  record.events.push_back({.id = 3,
                           .kind = EventKind::end,
                           .step = 2,
                           .arc = 0.5,
                           .lambda = 0.05,
                           .monitors = {0.2, infinity},
                           .unstable_before = 1,
                           .unstable_after = 1,
                           .branch_end = record.branches.front().end});
  return record;
}

}  // namespace arcwall
