#include "tests/support/essenburg_models.hpp"

namespace arcwall::test {

Section essenburg_section(double E, double nu, double width, double height, double shear_correction) {
  const double A = width * height;
  return {.E = E,
          .A = A,
          .I = A * height * height / 12.0,
          .height = height,
          .G = 0.5 * E / (1.0 + nu),
          .shear_area = shear_correction * A,
          .points = rectangle_points(width, height)};
}

namespace {

MemberDescription beam_along(std::unique_ptr<Axis> axis, const EssenburgBeams& beams, double width, double height,
                             int elements) {
  return {.name = "beam",
          .from = 0,
          .to = 1,
          .axis = std::move(axis),
          .theory = Theory::essenburg,
          .order = beams.order,
          .quadratic = beams.quadratic,
          .section = essenburg_section(21000.0, 0.29, width, height, beams.shear_correction),
          .elements = elements};
}

constexpr double foundation_height = 0.2, channel_clearance = 0.15;

}  // namespace

std::unique_ptr<Structure> EssenburgFoundation::structure() const {
  StructureBuilder builder;
  const Vec2 middle(0.0, 0.0), end(1.0, 0.0);
  builder.add_joint(middle);
  builder.add_joint(end);
  builder.add_member(beam_along(straight_axis(middle, end), beams, foundation_height, foundation_height, elements));
  builder.fix(builder.dof(0, Dof::x));
  builder.fix(builder.shared_rotation(0).value());
  builder.fix(builder.dof(1, Dof::z));
  builder.add_load(builder.shared_rotation(1).value(), scale, LoadKind::proportional);
  return builder.build();
}

std::vector<TestWall> EssenburgFoundation::walls() const {
  const double z = -0.5 * foundation_height - scale * 0.08;
  return {{.name = "foundation", .side = Side::below, .profile = flat_profile(z)}};
}

std::unique_ptr<Structure> EssenburgChannel::structure() const {
  StructureBuilder builder;
  const Vec2 left(0.0, 0.0), right(2.0, 0.0);
  builder.add_joint(left);
  builder.add_joint(right);
  MemberDescription column = beam_along(straight_axis(left, right), beams, 0.1, height, elements);
  column.imperfection = imperfection;
  builder.add_member(std::move(column));
  builder.fix(builder.dof(0, Dof::x));
  builder.fix(builder.dof(0, Dof::z));
  builder.fix(builder.dof(1, Dof::z));
  builder.add_load(builder.dof(1, Dof::x), -1.0, LoadKind::proportional);
  return builder.build();
}

std::vector<TestWall> EssenburgChannel::walls() const {
  const double z = 0.5 * height + channel_clearance;
  return {{.name = "upper", .side = Side::above, .profile = flat_profile(z)},
          {.name = "lower", .side = Side::below, .profile = flat_profile(-z)}};
}

}  // namespace arcwall::test
