#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/member_stretch.hpp"
#include "model/model.hpp"

/// What a structure looks like in a state, and what it carries: for pictures and diagrams.
namespace arcwall {

struct MemberShape {
  std::string member{};
  std::vector<ShapePoint> points{};  ///< from end to end, at fixed fractions and where contacts are
};

/// A closed contact. Of a part that is pressed on a wall by contact that slides, every node.
struct ContactMark {
  ContactLabel label{};
  Vec2 position = Vec2::Zero();      ///< of the point that touches [length]
  Vec2 force = Vec2::Zero();         ///< of the wall on the structure [force]
  std::optional<double> pressure{};  ///< force over the length of axis it stands for; empty of a point force
};

struct Shape {
  std::vector<MemberShape> members{};  ///< in the deck's order
  std::vector<ContactMark> contacts{};
};

/// The structure in a state of the model. Forces are those with which its elements resist that shape; a run in
/// increments carries others along.
Shape shape_of(const Model& model, const State& state);

/// The surface of a wall where the structure may come.
struct WallShape {
  std::string name{};
  Side side = Side::above;
  bool is_outline = false;   ///< the body is to the left of its line, whatever its side
  std::vector<Vec2> line{};  ///< x of a profile ascends, unless λ has turned the wall upright
  bool moves = false;        ///< λ moves it
};

/// The heights of the members' sections, in the deck's order; 0 of bars, which are drawn as lines, and where it is
/// unknown [length].
std::vector<double> section_heights(const deck::Deck& deck);

/// The walls where they are at λ.
std::vector<WallShape> wall_shapes(const Model& model, double lambda = 0.0);

}  // namespace arcwall
