#pragma once

#include <vector>

#include "contact/candidate.hpp"
#include "contact/constraint_force.hpp"
#include "contact/contact_point.hpp"
#include "contact/contact_scales.hpp"
#include "contact/friction_layout.hpp"
#include "core/system.hpp"

namespace arcwall {

/// What obstacles answer a contact with (docs/theory.md, section 7.4). Stiffnesses are per length of axis and of gap
/// [force/length²]: a contact has that times its tributary length.
struct ContactLaw {
  enum class Method {
    rigid,      ///< no gap, whatever the force
    penalty,    ///< springs in compression: p = −stiffness · gap
    augmented,  ///< no gap, and springs beside the forces that vanish with it: K alone holds the contacts
    compliant,  ///< a pressure by penetration along members (WallPressure): no law of MultiplierContact
  };
  Method method = Method::rigid;
  double stiffness = 0.0;
};

/// A system with unilateral contact: the forces p ≥ 0 of the closed contacts are unknowns behind those of the inner
/// system.
///
///     F_inner(x, λ) − Σ t_j ∇g_j = 0,   −g_j − c_j p_j = 0   (closed)     [ K − Σ t ∇²g + Σ r ∇g ∇gᵀ   −Gᵀ ]
///     p_j = 0,   g_j ≥ 0                                     (open)       [ −G                         −c  ]
///
/// with t = p − r g; c = 0 but for the method `penalty`, r = 0 but for `augmented`.
///
/// Two candidates that are opposite to each other (Candidate::opposite) are one contact that holds in both senses: both
/// are closed on every active set of a path, and the first of them has the force of both, of either sign, without a
/// guard.
///
/// A contact with friction holds its place σ on the wall, too: T is the multiplier of that, and w where it is held.
///
///     F_inner(x, λ) − Σ t ∇g − Σ T ∇σ = 0,   w − σ = 0,   w = w_a (sticks),   T + ε μ p = 0 (slips, ε = ±1 its sense)
///
/// Unknowns: x, p, T, then the w of what slips, which are a border of K: its column is not its row. The guards behind
/// those of the contacts are (μ p − T, μ p + T) of each contact that sticks, in their order.
class MultiplierContact final : public System, public FrictionalContact, public ContactQuery {
 public:
  /// `inner` must outlive this. Methods other than `rigid` need candidates with tributary lengths. Candidates whose
  /// points have no unknowns stand last; they are no contacts, but no step leads over their walls.
  MultiplierContact(const Equations& inner, std::vector<Candidate> candidates, const ContactScales& scales,
                    const ContactLaw& law = {});

  Dimensions dimensions(const ActiveSet& active_set) const override;
  void residual(const State& state, Eigen::Ref<Vector> F) const override;
  void linearize(const State& state, Linearization& out) const override;
  double energy(const State& state) const override;
  StateMetric metric(const ActiveSet& active_set) const override;

  ActiveSet open_active_set() const override;
  Index contact_count() const { return static_cast<Index>(candidates_.size()); }
  Vector guards(const State& state) const override;
  Row guard_gradient(const State& state, Index j) const override;
  GuardsAlong guards_along(const State& state, const Direction& direction) const override;
  std::string watched_place(const State& state, Index j) const override;
  double guard(const State& state, Index j) const override;
  Vector unit_force(const State& state, Index j) const override;
  Enforcement enforcement(const ActiveSet& active_set, Index j) const override {
    return {.multiplier = multiplier_index(active_set, j),
            .force_scale = scales_.force,
            .compliance = springs_at(j).c * scales_.force / scales_.length,
            .two_sided = has_opposite(j)};
  }
  Vector transfer(const Vector& x, const ActiveSet& from, const ActiveSet& to) const override;
  StepVerdict check(const CheckedStep& step) const override;
  std::optional<PathKink> kink_between(const State& from, const State& to) const override;

  PathDependence path_dependence() const override { return {.friction = rest_friction_ != nullptr ? this : nullptr}; }
  bool is_rough(Index j) const { return candidate(j).friction() > 0.0; }
  bool is_rough(const ActiveSet&, Index j) const override { return is_rough(j); }
  double coefficient(const ActiveSet&, Index j) const override { return candidate(j).friction(); }
  bool share_point(const ActiveSet&, Index j, Index k) const override {
    return is_rough(j) && is_rough(k) && candidate(j).point().unknowns() == candidate(k).point().unknowns();
  }
  ContactMode mode(const ActiveSet& active_set, Index j) const override;
  std::vector<Index> slipping(const ActiveSet& active_set) const override;
  double slip_rate(const State& state, const Direction& direction, Index j) const override;
  double friction_force(const State& state, Index j) const override;
  Row slip_gradient(const State& state, Index j) const override;
  double slip(const State& state, Index j) const override;
  ContactPlace place(const State& state, Index j) const override;
  ContactPlace place_rates(const State& state, const Direction& direction, Index j) const override;
  std::optional<Index> force_index(const ActiveSet& active_set, Index j) const override;
  std::optional<Index> friction_index(const ActiveSet& active_set, Index j) const override;
  HeldPlace held_place(const ActiveSet& active_set, Index j) const override {
    return {.equation = friction_index(active_set, j).value(), .by_slip = -1.0};
  }
  std::optional<ModeOfContact> beyond_friction_bound(const ActiveSet& active_set, Index guard) const override;
  State with_modes(const State& state, std::span<const ModeOfContact> modes) const override;

  /// The index in x of the force of a contact; empty if it is open or shares that of another.
  std::optional<Index> multiplier_index(const ActiveSet& active_set, Index j) const;

  /// The closed contacts that stick by friction.
  std::vector<Index> sticking(const ActiveSet& active_set) const;

  /// Returns the state of a structure that is held where that of `free` is free, from one there: among the candidates
  /// of `free` those whose points can still move, with their forces and histories. `inner`: its inner unknowns.
  State gripped(const MultiplierContact& free, const State& state, const Vector& inner) const;

  const Candidate& candidate(Index j) const { return candidates_[static_cast<std::size_t>(j)]; }
  const ContactScales& scales() const { return scales_; }

  ContactPoint contact(const State& state, Index j) const override;
  double force(const State& state, Index j) const override;
  std::vector<ContactPoint> closed_contacts(const State& state) const override;
  WallAction wall_action(const State& state, const ContactsOfWall& of, const Vec2& about) const override;

 private:
  // A closed contact with friction: the numbers of its p, T and w in x, the last empty where it sticks.
  struct Friction {
    std::size_t contact = 0;
    Index p = 0, T = 0;
    std::optional<Index> w{};
    FrictionLayout::Contact history{};

    double held(const Vector& x) const { return w ? x[*w] : history.anchor; }
  };
  std::vector<Friction> frictions(const ActiveSet& active_set) const;
  const FrictionLayout& anchors(const ActiveSet& active_set) const;
  Index force_count(const ActiveSet& active_set) const;
  void add_friction(const State& state, Eigen::Ref<Vector> F) const;
  void add_friction(const State& state, Linearization& out) const;
  ConstraintForce friction_force(const State& state, const Friction& friction) const;
  double law_of_slip(const State& state, const Friction& friction) const;

  State inner_state(const State& state) const {
    return {.x = state.x.head(inner_.size({})), .lambda = state.lambda, .active_set = {}};
  }
  // Of one contact: c [length/force] and r [force/length] of the equations above.
  struct Springs {
    double c = 0.0, r = 0.0;
  };
  const Springs& springs_at(Index j) const { return springs_[static_cast<std::size_t>(j)]; }
  bool has_opposite(Index j) const { return candidate(j).opposite().has_value(); }
  bool has_force(const ActiveSet& active_set, std::size_t j) const;
  // Calls `visit(j, k)` for each candidate j that has a force, the k-th of them.
  template <typename Visit>
  void for_each_force(const ActiveSet& active_set, const Visit& visit) const {
    Index k = 0;
    for (std::size_t j = 0; j < active_set.contacts(); ++j)
      if (has_force(active_set, j)) visit(j, k++);
  }
  ConstraintForce contact_force(const State& state, std::size_t j, Index row, const Gap& gap) const;
  double open_guard(Index j, const State& state) const;
  ContactPoint told(const State& state, std::size_t j, double force) const;
  void lay_out(const State& state, Linearization& out) const;
  bool enters(const Candidate& held, const State& from, const State& to) const;
  // What passes through its wall between two states: a point, or what lies between it and the next.
  const Candidate* passing(const State& from, const State& to) const;
  bool comes_behind_an_end(const State& from, const State& to) const;

  const Equations& inner_;
  std::vector<Candidate> candidates_;
  std::vector<Candidate> held_;                                            // whose points do not move but by λ
  std::vector<std::pair<const Candidate*, const Candidate*>> neighbours_;  // along a member, of one wall
  ContactScales scales_;
  double speed_of_walls_ = 0.0;  // the greatest [length scale a unit of λ]
  std::vector<Springs> springs_;
  std::shared_ptr<const FrictionLayout> rest_friction_{};  // of open contacts; null where none has friction
};

}  // namespace arcwall
