#pragma once

#include <span>
#include <string>

#include "contact/sliding/setting.hpp"
#include "contact/sliding/unknowns.hpp"
#include "core/frictional_contact.hpp"

/// Coulomb friction at closed points that move along the body (docs/theory.md, section 18.5).
namespace arcwall::sliding {

/// The coefficient of friction of a contact of a layout, 0 without friction [-].
double friction_coefficient(const SlidingSetting& setting, const SlidingContactLayout& layout, std::size_t contact);

/// Whether friction is modelled wherever contacts of an active set are closed on obstacles that have it: at points
/// beside which the body lies on no obstacle.
bool friction_is_modelled(const SlidingSetting& setting, const ActiveSet& active_set);

/// What is told where it is not.
std::string friction_under_pressure();
std::string friction_at_end();

/// 1 where the body runs along the obstacle's tangent, which has the body to its left; −1 where it runs against it.
double body_sense(const SlidingSetting& setting, const SlidingState& at, std::size_t point);

/// How much longer than stress-free the body is where friction acts at a point: the mean of both sides, between which
/// the friction force makes it jump.
double mean_stretch(const SlidingSetting& setting, const SlidingState& at, std::size_t point);

/// Where a point with friction is, and the rates of that along a direction.
ContactPlace place_of_rubbing(const SlidingSetting& setting, const SlidingState& at, std::size_t point);
ContactPlace rates_of_rubbing(const SlidingSetting& setting, const SlidingState& at, const Direction& direction,
                              std::size_t point);

/// The rate of its slip along the obstacle, v = ẇ − Λ ṡ; not a derivative of anything.
Row slip_gradient(const SlidingSetting& setting, const SlidingState& at, std::size_t point);

/// How far it has slipped since the contact closed: each slip by the mean of the stretch at its ends [length].
double slip_of(const SlidingSetting& setting, const SlidingState& at, std::size_t point);

/// The law of friction of a point, in the row of its place w: T + ε μ p = 0 where it slips in the sense ε; where it
/// sticks w − w_a − (Λ_a + Λ)/2 (s − s_a) = 0.
struct LawOfFriction {
  double value = 0.0;
  Row row{};
};
LawOfFriction law_of_friction(const SlidingSetting& setting, const SlidingState& at, std::size_t point);

/// The same equilibrium with contacts in other modes: see FrictionalContact::with_modes.
State with_modes(const SlidingSetting& setting, const SlidingState& at, std::span<const ModeOfContact> modes);

/// What a point does, with its anchor where it is now.
SlidingContactLayout::Rubbing anchored_anew(const SlidingSetting& setting, const SlidingState& at, std::size_t point);

}  // namespace arcwall::sliding
