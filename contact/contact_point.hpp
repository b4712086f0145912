#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "core/contact_mode.hpp"
#include "core/state.hpp"

namespace arcwall {

/// Where a contact is, in the user's words.
struct ContactLabel {
  std::string wall{};
  std::string member{};
  double fraction = 0.0;   ///< of the member's arc length
  double tributary = 0.0;  ///< part of the axis whose pressure the contact stands for; 0 if not given [length]

  bool operator==(const ContactLabel&) const = default;
};

/// As messages say it: "roof at column:0.25", to four digits of the member; the member alone where there is no wall.
std::string words_of(const ContactLabel& label);

/// What friction does at a closed contact.
struct FrictionOfContact {
  ContactMode mode = ContactMode::sticks;
  double force = 0.0;              ///< T, along the obstacle's tangent, on the body [force]
  double coefficient = 0.0;        ///< μ [-]
  double slip = 0.0;               ///< along the tangent since the contact closed [length]
  Vec2 tangent = Vec2::UnitX();    ///< in the direction in which the obstacle's surface runs
  std::optional<double> anchor{};  ///< x of the place of the obstacle where it sticks [length]
};

/// A contact of one state, as events, tables and pictures tell it.
struct ContactPoint {
  ContactLabel label{};
  Vec2 place = Vec2::Zero();                    ///< of the point of the body that touches [length]
  double force = 0.0;                           ///< compression is positive; 0 where the contact is open [force]
  Vec2 force_vector = Vec2::Zero();             ///< of the obstacle on the body [force]
  std::optional<FrictionOfContact> friction{};  ///< of a closed contact with friction

  /// The force over the length of axis that it stands for [force/length]; empty where it is a point force.
  std::optional<double> pressure() const {
    return label.tributary > 0.0 ? std::optional(force / label.tributary) : std::nullopt;
  }
};

/// The contacts of a wall or of all, or those of them with one member or with one place of it.
struct ContactsOfWall {
  std::string wall{};                ///< empty: of all
  std::string member{};              ///< likewise
  std::optional<double> fraction{};  ///< of the member's arc length

  bool includes_wall(const std::string& name) const { return wall.empty() || name == wall; }
  bool includes(const ContactLabel& contact) const {
    constexpr double same = 1e-9;
    return includes_wall(contact.wall) &&
           (member.empty() ||
            (contact.member == member && (!fraction || std::abs(contact.fraction - *fraction) <= same)));
  }
};

/// What an obstacle exerts on the body in sum: its force along x and along z [force] and its moment about a point
/// [force·length], with their derivatives.
struct WallAction {
  std::array<double, 3> value{};
  std::array<Row, 3> gradient{};

  /// No contact yet.
  explicit WallAction(Index unknowns) {
    for (Row& row : gradient) row = {.dx = Vector::Zero(unknowns), .dlambda = 0.0};
  }
};

/// Tells the contacts of a state. Contact at nodes and contact that slides do so alike.
class ContactQuery {
 public:
  virtual ~ContactQuery() = default;

  /// Contact j of the state's active set, open or closed. The number of a validity bound stands for the place that it
  /// watches: where the pressure of a part on an obstacle is least, or an end.
  virtual ContactPoint contact(const State& state, Index j) const = 0;

  /// The force of contact j alone, 0 where it is open [force].
  virtual double force(const State& state, Index j) const = 0;

  /// The closed contacts of the state's active set, in their order. At the end of a part that is pressed on an obstacle
  /// the force is that of the end alone, without the pressure beside it.
  virtual std::vector<ContactPoint> closed_contacts(const State& state) const = 0;

  /// Where parts are pressed on an obstacle: first their nodes between two closed contacts, as the layout of the active
  /// set has them, then the half elements at closed contacts.
  virtual std::vector<ContactPoint> pressed_nodes(const State&) const { return {}; }

  /// The sum of what contacts of a wall contribute to the equations of equilibrium, so that it is in balance with loads
  /// and reactions: of parts that are pressed on curved walls that is more than the forces along the normals.
  virtual WallAction wall_action(const State& state, const ContactsOfWall& of, const Vec2& about) const = 0;
};

}  // namespace arcwall
