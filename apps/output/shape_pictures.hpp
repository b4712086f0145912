#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "model/record.hpp"
#include "model/shape.hpp"

namespace arcwall {

/// A load, on a point or as a part of what is spread over a member.
struct AppliedLoad {
  Vec2 at = Vec2::Zero();     ///< [length]
  Vec2 force = Vec2::Zero();  ///< [force]
  double moment = 0.0;        ///< positive anticlockwise [force·length]
};

/// A supported point.
struct HeldPoint {
  Vec2 at = Vec2::Zero();  ///< [length]
  bool x = false, z = false, rotation = false;
};

/// A spring from a point to the ground, or to another point.
struct DrawnSpring {
  Vec2 at = Vec2::Zero();    ///< [length]
  std::optional<Vec2> to{};  ///< empty: the ground
  bool x = false, z = false, rotation = false;
};

/// A structure in a state, with what acts on it from outside.
struct Scene {
  Shape shape{};
  std::vector<AppliedLoad> loads{};
  std::vector<HeldPoint> supports{};
  std::vector<DrawnSpring> springs{};  ///< of a foundation a few
  std::vector<WallShape> walls{};      ///< those that λ moves
};

Scene scene_of(const Model& model, const State& state);

/// What is drawn of a run.
struct DrawnScenes {
  std::vector<std::size_t> points{};  ///< of the record, ascending
  std::vector<Scene> scenes{};        ///< at them, and then those after the jumps of the record in the order of jumps()

  /// The shape at a point; null if it is not drawn.
  const Shape* shape_at(std::size_t point) const;
};

/// All points of a run, or fewer where all would need more than some megabytes.
DrawnScenes scenes_to_draw(const Model& model, const Record& record);

/// What stresses and curvatures follow from.
struct DrawnSection {
  double A = 0.0, I = 0.0, EI = 0.0;  ///< EI and I of bars are 0
  double half_height = 0.0;           ///< 0 if unknown [length]
};
struct DrawnMember {
  std::string name{};
  std::string from{}, to{};  ///< points of the deck
  double allowable = 0.0;    ///< stress of its material; 0 if none is given [force/length²]
  DrawnSection section{};
  std::function<DrawnSection(double)> section_at{};  ///< at a fraction of the member's length; empty: uniform
};

/// What a wall is called, and which members it concerns.
struct DrawnWall {
  std::string name{};
  std::vector<std::string> members{};  ///< empty: all
};

/// What is the same in all scenes.
struct Setting {
  std::vector<WallShape> walls{};  ///< those that stand still
  std::vector<double> heights{};   ///< of the members' sections; 0 if unknown [length]
  std::vector<DrawnMember> members{};
};

Setting setting_of(const Model& model);

/// What a member carries at some of the points of its path.
struct ForceSample {
  std::size_t at = 0;     ///< which point of the path
  double fraction = 0.0;  ///< of the member's length
  double axial_force = 0.0, shear_force = 0.0, moment = 0.0;
};

/// A scene as the data of SVG paths.
struct ShapePicture {
  std::size_t point = 0;                           ///< of the record
  std::vector<std::string> paths{};                ///< as many as the pictures have classes
  std::vector<std::string> moves{};                ///< of the points of each member's path, from rest; see `move_unit`
  std::vector<ContactMark> contacts{};             ///< closed
  std::vector<std::vector<ForceSample>> forces{};  ///< of each member; empty where they would be too much for a page
};

/// All pictures of a record, to one scale. Lengths are in parts of 10⁻⁵ of the longer side, y points down.
struct ShapePictures {
  double width = 0.0, height = 0.0;
  double stretch = 1.0;                 ///< heights are drawn so many times as large as lengths along x
  double greatest_force = 0.0;          ///< of a wall: that of the longest arrow [force]
  double greatest_move = 0.0;           ///< of a point of a member, from rest
  double move_unit = 0.0;               ///< of `moves`; 0: there are none, as deflections fill the picture as they are
  std::vector<std::string> surfaces{};  ///< of the walls: an open path each, under the bodies
  std::vector<std::string> bodies{};    ///< what is solid of them: a closed path each
  std::vector<double> thickness{};      ///< of the paths; 0: a mere line
  std::vector<std::string> classes{};   ///< of a picture's paths: `member` for each, `moving-surface`, `moving`,
                                        ///< `springs`, `supports`, `loads`, `forces`, `touches`,
                                        ///< `friction`
  std::vector<ShapePicture> pictures{};
  std::vector<ShapePicture> after_jumps{};  ///< `point` is not used
  std::vector<DrawnMember> members{};
  std::vector<DrawnWall> walls{};  ///< whose surfaces are there
};

/// Points of a record that get a picture: all if they are at most `most`, else every n-th of a branch with its ends,
/// and those with events where these are not the most themselves. Ascending.
std::vector<std::size_t> points_to_draw(const Record& record, std::size_t most);

ShapePictures draw(const DrawnScenes& drawn, const Setting& setting);

}  // namespace arcwall
