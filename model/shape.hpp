#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/member_stretch.hpp"
#include "model/model.hpp"

/// Deformed shapes and section forces, for pictures and diagrams.
namespace arcwall {

struct MemberShape {
  std::string member{};
  std::vector<ShapePoint> points{};  ///< from end to end, at fixed fractions and where contacts are
};

/// Stores a closed contact; of a pressed contact zone with moving points, one a node.
struct ContactMark {
  ContactLabel label{};
  Vec2 position = Vec2::Zero();      ///< of the contact point [length]
  Vec2 force = Vec2::Zero();         ///< of the wall on the structure [force]
  std::optional<double> pressure{};  ///< force over tributary length [force/length]; empty for a point force
  std::optional<FrictionOfContact> friction{};
};

struct Shape {
  std::vector<MemberShape> members{};  ///< in the deck's order
  std::vector<ContactMark> contacts{};
};

/// Returns the shape of the structure in a state of the model. Forces are the element forces of that shape; a run in
/// load increments has others.
Shape shape_of(const Model& model, const State& state);

/// Stores the contact surface of a wall.
struct WallShape {
  std::string name{};
  Side side = Side::above;
  bool is_outline = false;       ///< the body is to the left of its line, whatever its side
  std::vector<Vec2> line{};      ///< x of a profile ascends, unless λ has turned the wall upright
  std::vector<Vec2> whole{};     ///< the line together with its parts beyond the structure's reach
  bool closed = false;           ///< the last point of `whole` is joined to the first
  std::optional<Vec2> behind{};  ///< unit vector into the solid of a profile or half-plane; empty: the solid is on
                                 ///< the right of the line
  std::vector<std::string> members{};  ///< that the wall concerns; empty: all
  bool moves = false;                  ///< λ moves it
};

/// Returns the section heights of the members, in the deck's order; 0 for bars and heights that are unknown
/// or taper [length].
std::vector<double> section_heights(const deck::Deck& deck);

/// Returns the walls at their positions at λ.
std::vector<WallShape> wall_shapes(const Model& model, double lambda = 0.0);

}  // namespace arcwall
