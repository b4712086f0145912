#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "contact/contact_point.hpp"
#include "contact/slip_layout.hpp"
#include "core/linearization.hpp"
#include "core/path_history.hpp"
#include "core/path_kink.hpp"
#include "elements/structure.hpp"
#include "elements/wall_pressure.hpp"

namespace arcwall {

/// Coulomb friction of compliant walls by an elastic slip and return mapping at material points of the members
/// (WallPressure::rubbed()):
///
///     e = T_c − k (σ − σ_c),      T = e where |e| ≤ μ P, else T = μ P sign e
///
/// σ is the place of the point along the wall, P the force across the wall on its part of the member, T the friction
/// force along the wall's tangent, c what was committed last, k the elastic stiffness. While a point slips in one sense
/// T = ∓μ P whatever c is, and while it sticks c does not count either: only where its slip ends does the length of
/// steps, by its second power.
class CompliantFriction final : public PathHistory {
 public:
  /// An element under the pressure of a wall with friction.
  struct Pressed {
    const WallPressure* pressure = nullptr;
    Index element = 0;
    std::size_t contact = 0;      ///< of the active set: closed while it acts
    double from = 0.0, to = 1.0;  ///< fractions of the member
    double coefficient = 0.0;     ///< μ > 0 [-]
    double stiffness = 0.0;       ///< k by length of the axis [force/length²]
    double round = 0.0;           ///< length after which places along the wall begin again; 0: they do not
  };

  /// `structure` must outlive this.
  CompliantFriction(const Structure& structure, std::vector<Pressed> pressed, std::size_t contacts);

  /// The history of what has touched nothing yet.
  const std::shared_ptr<const SlipLayout>& rest() const { return rest_; }

  void add(const State& state, Eigen::Ref<Vector> F) const;
  /// Writes N, too.
  void add(const State& state, Linearization& out) const;

  /// The elastic energy at fixed slips [force·length].
  double energy(const State& state) const;

  State committed(const State& state, const Direction& arrives, double length) const override;
  Leaving leaving(const State& state, const Direction& direction, bool one) const override;

  /// The first point that begins to slip between two states.
  std::optional<PathKink> kink_between(const State& from, const State& to) const;

  /// A material point under pressure at a state.
  struct Point {
    const Pressed* pressed = nullptr;
    std::size_t number = 0;  ///< of the element's points
    double fraction = 0.0;   ///< of the member
    double force = 0.0;      ///< T [force]
    double most = 0.0;       ///< μ P [force]
    double slip = 0.0;       ///< since the wall was touched [length]
    double place = 0.0;      ///< along the wall [length]
    int sense = 0;           ///< 1 or −1 where it slips
  };
  std::vector<Point> points(const State& state) const;

  /// T of such a point, μ P and its slip, with their derivatives.
  struct Rows {
    Row force{}, most{}, slip{};
  };
  Rows rows(const State& state, const Point& point) const;

  /// Adds what friction exerts on the structure at a point.
  void add_action(const State& state, const Point& point, const Vec2& about, WallAction& to) const;

  /// The elastic energy at fixed slips on one element, and its derivatives by the element's unknowns.
  struct OnElement {
    Index element = 0;
    double energy = 0.0;
    Vector gradient{};
    Matrix stiffness{};
  };
  std::vector<OnElement> on_elements(const State& state) const;

  /// Return the material points of all elements as they were committed, and the contacts of these points.
  const std::vector<SlipLayout::Point>& committed_points(const State& state) const { return history(state).points(); }
  std::size_t contact_of(std::size_t point) const { return pressed_[point / WallPressure::rubbing_points].contact; }

  /// What friction exerts along a degree of freedom, with its derivatives [force or force·length].
  double force_on(const State& state, Index dof) const;
  Row force_on_gradient(const State& state, Index dof) const;

  /// The unit tangent of the wall at a point.
  Vec2 tangent(const State& state, const Point& point) const;

  /// Returns the state as one before which nothing has been dissipated.
  State without_dissipation(const State& state) const;

  /// What friction has dissipated on a contact, as committed [force·length].
  double dissipated(const State& state, std::size_t contact) const;

 private:
  struct Local;
  struct Held;
  struct Rates {
    double place = 0.0, most = 0.0, slip = 0.0;
  };
  Rates rates(const Pressed& pressed, const WallPressure::Rubbed& at, int sense, const Direction& direction) const;
  class PastBound;
  template <class Visit>
  void for_each_pressed(const State& state, const Visit& visit) const;
  Local local(const State& state, const Pressed& pressed) const;
  Held held(const Pressed& pressed, const WallPressure::Rubbed& at, const SlipLayout::Point& before) const;
  const SlipLayout& history(const State& state) const;
  bool acts(const State& state, const Pressed& pressed) const;
  std::size_t first_point(const Pressed& pressed) const;
  double along(const Pressed& pressed, const double* by_unknowns, double rate, const Direction& direction) const;
  Row row(const State& state, const Pressed& pressed, const double* by_unknowns, double rate) const;
  State with(const State& state, std::vector<SlipLayout::Point> points, std::vector<double> dissipated) const;

  const Structure& structure_;
  std::vector<Pressed> pressed_;
  std::shared_ptr<const SlipLayout> rest_;
};

}  // namespace arcwall
