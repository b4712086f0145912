#pragma once

#include <memory>
#include <string>
#include <vector>

#include "contact/contact_point.hpp"
#include "contact/contact_scales.hpp"
#include "contact/continuum_choice.hpp"
#include "contact/sliding/given_contacts.hpp"
#include "contact/sliding/layout.hpp"
#include "contact/sliding_obstacle.hpp"
#include "core/frictional_contact.hpp"
#include "core/sliding_body.hpp"
#include "core/system.hpp"

namespace arcwall {

struct SlidingSetting;

/// A body of slender members among obstacles, with contact where it is: the material coordinates s of the contact
/// points are unknowns, and the mesh moves with them (docs/theory.md, section 8).
///
///     F(x, s, λ) − Σ p_k ∇g_k − Σ m_k ∇t_k = 0,   −g_k = 0 (closed),   −t_k = 0,   m_k = 0
///
/// g is the gap, t the angle between the body and the wall, p ≥ 0 the contact force; m, a moment that holds the
/// tangency, vanishes, or at the ends of a pressed part what the body bends more than the wall does. Tracked points are
/// closed, or open and follow a least gap. Unknowns: x, p, m, s; of closed points with friction the place on the wall
/// is held, too, by T, and where it is held is an unknown w.
///
/// Between two closed points on one wall the body may lie on the wall: straight and without pressure, or with nodes
/// that are pressed on the wall, where wall or body are curved. The guards of an active set are those of its contacts
/// (the tracked points, then free ends) and, behind them, the bounds of its layout.
class SlidingContact final : public System, public ContactQuery, public FrictionalContact {
 public:
  /// `body` must outlive this.
  SlidingContact(const SlidingBody& body, std::vector<SlidingObstacle> obstacles, const ContactScales& scales,
                 ContinuumChoice continuum = ContinuumChoice::symmetric);
  ~SlidingContact() override;

  Dimensions dimensions(const ActiveSet& active_set) const override;
  void residual(const State& state, Eigen::Ref<Vector> F) const override;
  void linearize(const State& state, Linearization& out) const override;
  double energy(const State& state) const override;
  StateMetric metric(const ActiveSet& active_set) const override;

  ActiveSet open_active_set() const override { return open_; }
  Vector guards(const State& state) const override;
  double guard(const State& state, Index j) const override;
  Row guard_gradient(const State& state, Index j) const override;
  GuardsAlong guards_along(const State& state, const Direction& direction) const override;
  std::string watched_place(const State& state, Index j) const override { return words_of(contact(state, j).label); }
  Vector unit_force(const State& state, Index j) const override;
  Enforcement enforcement(const ActiveSet& active_set, Index j) const override;
  Vector transfer(const Vector& x, const ActiveSet& from, const ActiveSet& to) const override;
  CountedDirections counted_directions(const ActiveSet& active_set) const override;

  std::vector<Transition> transitions(const State& state, const Direction& forward, Index bound,
                                      double tolerance) const override;
  StepVerdict check(const CheckedStep& step) const override;
  std::optional<std::string> penetrated_place(const State& state, double margin) const override;
  std::optional<PathKink> kink_between(const State& from, const State& to) const override;
  Index separate_contacts(const ActiveSet& active_set) const override;
  ActiveSet canonical_active_set(const State& state) const override;

  PathDependence path_dependence() const override { return {.friction = has_friction_ ? this : nullptr}; }
  bool is_rough(const ActiveSet& active_set, Index j) const override { return coefficient(active_set, j) > 0.0; }
  bool contacts_move() const override { return true; }
  std::string why_not_modelled(const ActiveSet& active_set, Index j) const override;
  std::string why_not_modelled(const ActiveSet& active_set) const override;
  double coefficient(const ActiveSet& active_set, Index j) const override;
  bool share_point(const ActiveSet& active_set, Index j, Index k) const override;
  ContactMode mode(const ActiveSet& active_set, Index j) const override;
  std::vector<Index> slipping(const ActiveSet& active_set) const override;
  double slip_rate(const State& state, const Direction& direction, Index j) const override;
  Row slip_gradient(const State& state, Index j) const override;
  double slip(const State& state, Index j) const override;
  /// The length of a closed obstacle's round that contact j may touch, 0 of one that is not closed [length].
  double round_length(const ActiveSet& active_set, Index j) const;

  double slip_since(const State& event, const State& state, Index j) const override;

  /// Returns the contact with friction of another state on the path that is nearest along the body to contact j of a
  /// state, on the same obstacle: j itself where both have the same contacts; empty if there is none.
  std::optional<Index> counterpart(const State& state, Index j, const State& other) const;

  bool rolls(const ActiveSet& active_set, Index j) const override;
  ContactPlace place(const State& state, Index j) const override;
  ContactPlace place_rates(const State& state, const Direction& direction, Index j) const override;
  std::optional<Index> force_index(const ActiveSet& active_set, Index j) const override;
  std::optional<Index> friction_index(const ActiveSet& active_set, Index j) const override;
  HeldPlace held_place(const ActiveSet& active_set, Index j) const override;
  double friction_force(const State& state, Index j) const override;
  std::optional<ModeOfContact> beyond_friction_bound(const ActiveSet& active_set, Index guard) const override;
  State with_modes(const State& state, std::span<const ModeOfContact> modes) const override;

  /// Why friction is not modelled where λ goes on from its start towards a value; empty if it is.
  std::string why_friction_is_not_modelled(double toward) const;

  ContactPoint contact(const State& state, Index j) const override;
  double force(const State& state, Index j) const override;
  std::vector<ContactPoint> closed_contacts(const State& state) const override;
  std::vector<ContactPoint> pressed_nodes(const State& state) const override;
  WallAction wall_action(const State& state, const ContactsOfWall& of, const Vec2& about) const override;

  /// The stress-free state, all contacts open.
  State rest() const;

  /// The same with those strands pressed along their obstacles that lie on them from end to end at rest and are pressed
  /// all along as λ goes from 0 towards this value.
  State start(double toward) const;

  /// Whether at rest a part of a strand, but not all of it, lies flush on a straight obstacle. How much of it stays in
  /// contact under the least load no gap tells: a beam that projects over the end of its bed lifts off behind it.
  bool rests_on_part() const;

  /// The state with those strands pressed along their obstacles that have come down flush on them and are pressed all
  /// along as λ goes on towards this value; empty if none has.
  std::optional<State> with_strands_come_to_lie(const State& state, double toward) const;

  /// Why a state in which strands are pressed along obstacles is none any more as λ goes from 0 towards that of the
  /// state: it moves what they lie on, or their ends into it; empty if it does not.
  std::string why_not_lying(const State& state) const;

  /// The same state of this body, of one on another body that differs from it in its loads alone.
  State adopted(const State& state) const;

  /// Returns the state of this body, which is held where that of `free` is free, from one there: what walls exert on
  /// the ends that are held now, and the moments at tips that are, is left to the supports. So is friction of an end
  /// that they hold along its wall.
  State gripped(const SlidingContact& free, const State& state) const;

  /// The state from which λ goes towards a value: parts that lie on walls without pressure, and along which a load
  /// begins to act then, are pressed or free.
  State with_flat_parts_loaded(const State& state, double toward) const;

  /// The state with the same unknowns, of a body among obstacles that differs from this one in numbers alone. Empty
  /// where other numbers make other strands, ends or bounds, so that the unknowns do not mean the same.
  std::optional<State> taken_over(const State& state) const;

  /// The state with these contacts closed, of one in which all are open and whose shape is nearly theirs: a start for
  /// Newton's method.
  State with_given_contacts(const State& open, const std::vector<GivenContact>& contacts) const;

  /// The layout of so many elements and these points that began at these places; null if they do not belong together.
  std::shared_ptr<const SlidingContactLayout> layout_of(const ElementsPerSegment& elements,
                                                        std::vector<SlidingContactLayout::Point> points,
                                                        const Vector& origin, SlidingContactLayout::Lying lying,
                                                        SlidingContactLayout::EndRubbings ends) const;

  /// Where the body is deeper than this inside an obstacle between its contacts, deepest [length].
  struct Entered {
    ContactLabel label{};
    double depth = 0.0;
  };
  std::optional<Entered> entered(const State& state, double depth) const;

  /// The least gap at `places` points of each element against every obstacle, flat parts included [length].
  double least_gap(const State& state, int places) const;

  /// The ends of strands with the obstacles that may touch them: the contacts behind those of the points, in their
  /// order.
  struct EndContact {
    Index strand = 0;
    bool last = false;
    std::size_t obstacle = 0;
  };
  std::vector<EndContact> ends() const;

  /// Where two obstacles leave the body no clearance: two contacts each that are closed for good.
  struct PinchedPlace {
    std::string obstacle{}, other{};  ///< their names
    Vec2 place = Vec2::Zero();        ///< of the axis
    Vec2 axis = Vec2::Zero();         ///< direction of the axis there at rest
    Vec2 normal = Vec2::Zero();       ///< across it; the first obstacle presses along it
    bool knife_edges = false;         ///< they leave the direction free
  };
  std::vector<PinchedPlace> pinches() const;

  const ContactScales& scales() const;
  const SlidingBody& body() const;
  const std::vector<SlidingObstacle>& obstacles() const;

 private:
  StepVerdict check_converged(const State& from, const State& to) const;

  std::unique_ptr<const SlidingSetting> setting_;
  ActiveSet open_;
  bool has_friction_ = false;
  double speed_of_walls_ = 0.0;  // the greatest [length scale a unit of λ]
};

}  // namespace arcwall
