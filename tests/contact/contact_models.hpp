#pragma once

#include <memory>
#include <vector>

#include "tests/support/models.hpp"

namespace arcwall::test {

/// A clamped, slightly curved beam from (0, 0) to (2, 0.1), loaded across at its tip: the described member between
/// these.
inline std::unique_ptr<Structure> contact_beam(MemberDescription member) {
  StructureBuilder builder;
  const Vec2 a(0.0, 0.0), b(2.0, 0.1);
  member.name = "beam";
  member.from = builder.add_joint(a);
  member.to = builder.add_joint(b);
  member.axis = arc_axis(a, {1.0, 0.2}, b);
  builder.add_member(std::move(member));
  builder.fix(builder.dof(0, Dof::x));
  builder.fix(builder.dof(0, Dof::z));
  builder.fix(builder.shared_rotation(0).value());
  builder.add_load(builder.dof(1, Dof::z), 1.0, LoadKind::proportional);
  return builder.build();
}

/// The same, classic, of height 0.2, four elements.
inline std::unique_ptr<Structure> contact_beam() {
  return contact_beam({.section = {.E = 100.0, .A = 1.0, .I = 0.1, .height = 0.2}, .elements = 4});
}

/// All kinds of walls on both sides, over x from −0.5 to 3.5.
inline std::vector<TestWall> all_walls(bool on_axis) {
  std::vector<TestWall> walls;
  const auto add = [&](Side side, std::unique_ptr<Profile> profile) {
    walls.push_back({.name = "wall", .side = side, .profile = std::move(profile), .on_axis = on_axis});
  };
  for (const Side side : {Side::above, Side::below}) {
    const double sign = side == Side::above ? 1.0 : -1.0;
    add(side, flat_profile(sign));
    add(side, line_profile(sign, 0.2));
    add(side, parabola_profile({1.0, sign}, 0.3 * sign));
    add(side, circle_profile({1.5, 6.0 * sign}, 5.0, side));
    add(side, spline_profile({-0.5, 0.5, 1.5, 2.5, 3.5}, {sign, 1.1 * sign, 0.9 * sign, sign, 1.2 * sign}));
  }
  return walls;
}

}  // namespace arcwall::test
