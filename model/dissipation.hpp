#pragma once

#include <vector>

#include "core/frictional_contact.hpp"
#include "model/record.hpp"

namespace arcwall {

/// The slips along a direction at a state; none without friction. `unit`: the user's length over that of the model.
std::vector<RecordSlip> slips_along(const FrictionalContact* contacts, const State& state, const Direction& direction,
                                    double unit);

/// What friction dissipates while a slip goes from one end of an arc to the other, −∫ T (dw − Λ ds), with cubics of T,
/// w, Λ and s by the arc length (docs/theory.md, section 18.4). ≥ 0.
double dissipated(const RecordSlip& from, const RecordSlip& to, double arc_length);

/// What contacts that slip at the first point of an active set, `slips` there, have dissipated since an event at which
/// contacts have parted, come together or moved to ends. `unit`: that of lengths.
void add_dissipated_before(const FrictionalContact& contacts, const State& event, const State& first, double unit,
                           std::vector<RecordSlip>& slips);

/// Closed contacts that slip.
Index slipping_contacts(const RecordPoint& point);

/// Of all walls at a point.
double total_dissipation(const RecordPoint& point);

}  // namespace arcwall
