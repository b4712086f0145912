#pragma once

#include <optional>
#include <span>
#include <string>

#include "contact/sliding/setting.hpp"
#include "contact/sliding/unknowns.hpp"
#include "core/frictional_contact.hpp"

/// Coulomb friction at closed contacts: points that move along the body, and free ends (docs/theory.md, section 18.5).
namespace arcwall::sliding {

/// The coefficient of friction of a contact of a layout, 0 without friction [-].
double friction_coefficient(const SlidingSetting& setting, const SlidingContactLayout& layout, std::size_t contact);

/// Why friction is not modelled where contacts of an active set are closed on obstacles that have it; empty if it is:
/// at points beside which no obstacle presses on the body, and at tips.
std::string why_friction_is_not_modelled(const SlidingSetting& setting, const ActiveSet& active_set);

/// Why it is not at a contact of a layout that closes by itself.
std::string why_friction_is_not_modelled_at(const SlidingSetting& setting, const SlidingContactLayout& layout,
                                            std::size_t contact);

/// Whether a contact moves along the body: a tracked point does, the end of a strand stays what it is.
inline bool moves_along_body(const SlidingState& at, std::size_t contact) {
  return contact < at.layout.points().size();
}

/// 1 where the body runs along the obstacle's tangent, which has the body to its left; −1 where it runs against it.
double body_sense(const SlidingSetting& setting, const SlidingState& at, std::size_t contact);

/// How much longer than stress-free the body is where friction acts at a contact: the mean of both sides, between which
/// the friction force makes it jump. Beyond a free end the body would be free, beyond a plane of symmetry it is the
/// same.
double mean_stretch(const SlidingSetting& setting, const SlidingState& at, std::size_t contact);

/// Where a contact with friction is, and the rates of that along a direction.
ContactPlace place_of_rubbing(const SlidingSetting& setting, const SlidingState& at, std::size_t contact);
ContactPlace rates_of_rubbing(const SlidingSetting& setting, const SlidingState& at, const Direction& direction,
                              std::size_t contact);

/// The rate of its slip along the obstacle, v = ẇ − Λ ṡ; not a derivative of anything. At an end s does not change.
Row slip_gradient(const SlidingSetting& setting, const SlidingState& at, std::size_t contact);

/// How far it has slipped since the contact closed: each slip by the mean of the stretch at its ends [length].
double slip_of(const SlidingSetting& setting, const SlidingState& at, std::size_t contact);

/// The law of friction of a contact, in the row of its place w: T + ε μ p = 0 where it slips in the sense ε; where it
/// sticks w − w_a − (Λ_a + Λ)/2 (s − s_a) = 0.
struct LawOfFriction {
  double value = 0.0;
  Row row{};
};
LawOfFriction law_of_friction(const SlidingSetting& setting, const SlidingState& at, std::size_t contact);

/// The same equilibrium with contacts in other modes: see FrictionalContact::with_modes.
State with_modes(const SlidingSetting& setting, const SlidingState& at, std::span<const ModeOfContact> modes);

/// Whether two states have the same contacts: on one mesh all, which may open and close; on two those that are closed.
/// None has parted then, come together or moved to an end.
bool has_same_contacts(const SlidingState& one, const SlidingState& other);

/// How far a contact of a state, which slips, has slipped since an event at which contacts changed, see
/// FrictionalContact::slip_since. One whose anchor the event has, too, is the same contact; any other anchor was taken
/// at the event, where the contact has rolled to its place: nothing slips there [length].
double slip_since(const SlidingSetting& setting, const SlidingState& event, const SlidingState& at,
                  std::size_t contact);

/// The contact with friction of another state that is nearest along the body to one of a state, on the same obstacle.
std::optional<Index> nearest_rubbing(const SlidingSetting& setting, const SlidingState& at, std::size_t contact,
                                     const SlidingState& other);

/// What a contact does, with its anchor where it is now.
SlidingContactLayout::Rubbing anchored_anew(const SlidingSetting& setting, const SlidingState& at, std::size_t contact);

}  // namespace arcwall::sliding
