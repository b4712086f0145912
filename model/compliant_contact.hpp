#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "contact/contact_point.hpp"
#include "contact/obstacle.hpp"
#include "core/system.hpp"
#include "elements/structure.hpp"
#include "model/compliant_friction.hpp"

namespace arcwall {

/// The gap of places to an obstacle.
std::shared_ptr<const WallGap> gap_to(std::shared_ptr<const Obstacle> obstacle);

/// A structure whose elements are pressed by compliant walls (WallPressure), with what a path and its user ask of
/// contact: the first penetration of a wall by a member and the last are contact changes, the pressed parts are its
/// contacts.
///
/// Contact j is a wall and a member, closed while the wall is penetrated. The equations are those of the structure, of
/// whose energy closed walls are part and open ones are not: both agree where a contact changes. Its guard is the least
/// gap along the member while it is open, and minus that while it is closed; it has no multiplier, and compliance 1.
///
/// With friction the equations have the history of material points (CompliantFriction) in their layout.
///
/// A stiff wall bears a force at penetrations that no step resolves: the path has a kink where it is touched and where
/// it is left (kink_between()).
class CompliantContact final : public System, public ContactQuery {
 public:
  /// A wall in the way of a member, in the order of StructureBuilder::add_wall().
  struct Wall {
    std::string name{};
    Index member = 0;
    std::shared_ptr<const Obstacle> obstacle{};
    double friction = 0.0;              ///< coefficient μ [-]
    double tangential_stiffness = 0.0;  ///< of what sticks, by length of the axis [force/length²]
  };

  /// `structure` must outlive this. `length`: scale of gaps.
  CompliantContact(const Structure& structure, std::vector<Wall> walls, double length);

  Dimensions dimensions(const ActiveSet&) const override { return structure_.dimensions({}); }
  void residual(const State& state, Eigen::Ref<Vector> F) const override {
    structure_.residual(state, F);
    if (friction_) friction_->add(state, F);
  }
  void linearize(const State& state, Linearization& out) const override {
    structure_.linearize(state, out);
    if (friction_) friction_->add(state, out);
  }
  double energy(const State& state) const override {
    return structure_.energy(state) + (friction_ ? friction_->energy(state) : 0.0);
  }
  StateMetric metric(const ActiveSet&) const override;

  ActiveSet open_active_set() const override {
    return ActiveSet(walls_.size(), std::uint8_t{0}, friction_ ? friction_->rest() : nullptr);
  }
  PathDependence path_dependence() const override { return {.history = friction_.get()}; }

  /// The friction of the walls; null if they have none.
  const CompliantFriction* elastic_friction() const { return friction_.get(); }
  Vector guards(const State& state) const override;
  double guard(const State& state, Index j) const override;
  Row guard_gradient(const State& state, Index j) const override;
  std::string watched_place(const State& state, Index j) const override;
  Enforcement enforcement(const ActiveSet&, Index) const override { return {.compliance = 1.0}; }
  StepVerdict check(const CheckedStep& step) const override;
  std::optional<PathKink> kink_between(const State& from, const State& to) const override;

  /// Returns the active set with the walls closed that a state touches or penetrates.
  ActiveSet touched_at(const State& state) const;

  Index contact_count() const { return static_cast<Index>(walls_.size()); }
  const Wall& wall(Index j) const { return walls_[static_cast<std::size_t>(j)]; }
  const std::string& member_of(Index j) const;

  /// The least gap between the wall and the member, and where it is [length]; infinite where they do not face.
  struct Nearest {
    double gap = infinity;
    double fraction = 0.0;      ///< of the member
    Vec2 place = Vec2::Zero();  ///< of the wall's surface that touches
  };
  Nearest nearest(const State& state, Index j) const;

  ContactPoint contact(const State& state, Index j) const override;
  double force(const State& state, Index j) const override;
  /// In order along each member: an edge of a pressed part, without a force, what each element bears between, and the
  /// other edge.
  std::vector<ContactPoint> closed_contacts(const State& state) const override;
  WallAction wall_action(const State& state, const ContactsOfWall& of, const Vec2& about) const override;

  /// A place of the member that may touch wall j, with a part of its stress-free axis.
  struct Place {
    double fraction = 0.0;  ///< of the member
    Vec2 at = Vec2::Zero();
    double length = 0.0;
  };
  /// The middles of equal parts of each element that the wall may press, `parts` an element.
  std::vector<Place> places(const State& state, Index j, int parts) const;

 private:
  void add_friction();
  // An element under the pressure of a wall.
  struct Pressed {
    const WallPressure* pressure;
    Index element;
    double from, to;  // fractions of the member
  };
  // Its unknowns at a state.
  struct Local {
    double u[Element::max_unknowns];
  };
  struct Least {
    const Pressed* at = nullptr;  // null: no element faces the wall
    double gap = infinity, fraction = 0.0;
  };

  Local local(const State& state, const Pressed& pressed) const;
  Least least(const State& state, std::size_t j) const;
  double guard_of(const State& state, std::size_t j, double gap) const;
  // Of a contact at a fraction of an element.
  ContactPoint at_fraction(const State& state, std::size_t j, const Pressed& pressed, double fraction) const;
  // Adds a row by an element's unknowns.
  void add(const Pressed& pressed, const double* by_unknowns, double factor, Row& row) const;
  const std::string& member_name(std::size_t j) const { return member_of(static_cast<Index>(j)); }
  bool acts(const State& state, std::size_t j) const {
    return j >= state.active_set.contacts() || state.active_set[j] != 0;
  }
  bool lies_along(const State& state, std::size_t j) const;
  double least_gap(const State& state, std::size_t j) const;
  Row least_gap_gradient(const State& state, std::size_t j) const;
  class Penetrated;

  const Structure& structure_;
  std::vector<Wall> walls_;
  std::vector<std::vector<Pressed>> pressed_;  // of each wall
  double length_;
  std::unique_ptr<CompliantFriction> friction_{};
};

}  // namespace arcwall
