#pragma once

#include "contact/contact_point.hpp"
#include "contact/sliding/setting.hpp"
#include "contact/sliding/unknowns.hpp"
#include "core/linearization.hpp"

/// The equations of a body with contact that slides (8.1): those of its mesh, the forces of contact on the body, and
/// one equation for each force, moment and coordinate.
namespace arcwall::sliding {

void residual(const SlidingSetting& setting, const SlidingState& at, Eigen::Ref<Vector> F);

/// See ContactQuery.
WallAction wall_action(const SlidingSetting& setting, const SlidingState& at, const ContactsOfWall& of,
                       const Vec2& about);

/// See Equations::linearize.
void linearize(const SlidingSetting& setting, const SlidingState& at, Linearization& out);

}  // namespace arcwall::sliding
