#include "tests/support/models.hpp"

#include <algorithm>
#include <cmath>

#include "continuation/tracer.hpp"

namespace arcwall::test {

namespace {

void fix(StructureBuilder& builder, Index node, bool rotation = false) {
  builder.fix(builder.freedom(node, Freedom::x));
  builder.fix(builder.freedom(node, Freedom::z));
  if (rotation) builder.fix(builder.shared_rotation(node).value());
}

Index straight_member(StructureBuilder& builder, Index from, Index to, const Vec2& a, const Vec2& b,
                      const Section& section, int elements, const BeamTheory& beam) {
  return builder.add_member({.name = "member",
                             .from = from,
                             .to = to,
                             .axis = straight_axis(a, b),
                             .theory = beam.theory,
                             .order = beam.order,
                             .section = section,
                             .elements = elements});
}

}  // namespace

std::unique_ptr<Structure> VonMisesTruss::structure() const {
  StructureBuilder builder;
  const Vec2 a(-half_span, 0.0), top(0.0, rise), b(half_span, 0.0);
  const Index left = builder.add_joint(a), apex = builder.add_joint(top), right = builder.add_joint(b);
  const auto bar = [&](Index from, Index to, const Vec2& at, const Vec2& end) {
    builder.add_member({.name = "bar",
                        .from = from,
                        .to = to,
                        .axis = straight_axis(at, end),
                        .theory = Theory::truss,
                        .strain = strain,
                        .section = {.E = EA, .A = 1.0}});
  };
  bar(left, apex, a, top);
  bar(apex, right, top, b);
  fix(builder, left);
  fix(builder, right);
  if (!sways) builder.fix(builder.freedom(apex, Freedom::x));
  builder.add_load(builder.freedom(apex, Freedom::z), -1.0, LoadKind::proportional);
  return builder.build();
}

std::unique_ptr<Structure> Cantilever::structure() const {
  StructureBuilder builder;
  const Vec2 a(0.0, 0.0), b(length, 0.0);
  const Index root = builder.add_joint(a), tip = builder.add_joint(b);
  straight_member(builder, root, tip, a, b, {.E = 1.0, .A = EA, .I = EI}, elements, beam);
  fix(builder, root, true);
  if (tip_force != 0.0) builder.add_load(builder.freedom(tip, Freedom::z), tip_force, LoadKind::proportional);
  if (tip_moment != 0.0) builder.add_load(builder.shared_rotation(tip).value(), tip_moment, LoadKind::proportional);
  return builder.build();
}

std::unique_ptr<Structure> lee_frame(int elements, const BeamTheory& beam) {
  StructureBuilder builder;
  const Vec2 at[] = {{0.0, 0.0}, {0.0, 120.0}, {24.0, 120.0}, {120.0, 120.0}};
  Index joints[4];
  for (int i = 0; i < 4; ++i) joints[i] = builder.add_joint(at[i]);
  const int count[] = {elements, elements / 5, elements * 4 / 5};
  for (int i = 0; i < 3; ++i)
    straight_member(builder, joints[i], joints[i + 1], at[i], at[i + 1], {.E = 720.0, .A = 6.0, .I = 2.0}, count[i],
                    beam);
  fix(builder, joints[0]);
  fix(builder, joints[3]);
  builder.add_load(builder.freedom(joints[2], Freedom::z), -1.0, LoadKind::proportional);
  return builder.build();
}

std::unique_ptr<Structure> deep_arch(int elements, const BeamTheory& beam) {
  StructureBuilder builder;
  constexpr double R = 100.0, half = 107.5 * pi / 180.0;
  const auto on_circle = [](double angle) { return Vec2(R * std::sin(angle), R * std::cos(angle)); };
  const Vec2 at[] = {on_circle(-half), on_circle(0.0), on_circle(half)};
  Index joints[3];
  for (int i = 0; i < 3; ++i) joints[i] = builder.add_joint(at[i]);
  for (int i = 0; i < 2; ++i)
    builder.add_member({.name = i == 0 ? "west" : "east",
                        .from = joints[i],
                        .to = joints[i + 1],
                        .axis = arc_axis(at[i], on_circle((i - 0.5) * half), at[i + 1]),
                        .theory = beam.theory,
                        .order = beam.order,
                        .section = {.E = 1.0, .A = 1e8, .I = 1e6},
                        .elements = elements});
  fix(builder, joints[0]);
  fix(builder, joints[2], true);
  builder.add_load(builder.freedom(joints[1], Freedom::z), -1.0, LoadKind::proportional);
  return builder.build();
}

std::unique_ptr<Structure> williams_toggle(int elements, const BeamTheory& beam) {
  StructureBuilder builder;
  constexpr double b = 0.753, h = 0.243;
  const Section section{.E = 1.03e7, .A = b * h, .I = b * h * h * h / 12.0};
  const Vec2 at[] = {{-12.943, 0.0}, {0.0, 0.386}, {12.943, 0.0}};
  Index joints[3];
  for (int i = 0; i < 3; ++i) joints[i] = builder.add_joint(at[i]);
  for (int i = 0; i < 2; ++i)
    straight_member(builder, joints[i], joints[i + 1], at[i], at[i + 1], section, elements, beam);
  fix(builder, joints[0], true);
  fix(builder, joints[2], true);
  builder.add_load(builder.freedom(joints[1], Freedom::z), -1.0, LoadKind::proportional);
  return builder.build();
}

std::shared_ptr<const Observable> displacement(const Structure& structure, Index node, Freedom which) {
  return std::make_shared<FreedomObservable>(structure, structure.freedom(node, which));
}

ContactModel::ContactModel(std::unique_ptr<Structure> structure, const std::vector<TestWall>& walls, double first_step)
    : structure_(std::move(structure)) {
  std::vector<Candidate> candidates;
  for (const TestWall& wall : walls)
    for (const MemberMesh& mesh : structure_->members())
      for (std::size_t k = 0; k < mesh.nodes.size(); ++k) {
        const double looks_up = wall.side == Side::above ? 1.0 : -1.0;
        const double offset =
            wall.on_axis ? 0.0 : std::copysign(0.5 * mesh.height.value(), looks_up * std::cos(mesh.shape[k].angle));
        auto point = std::make_unique<MemberPoint>(*structure_, mesh, k, offset);
        if (point->unknowns().empty()) continue;
        candidates.emplace_back(std::move(point), wall.profile, wall.side,
                                ContactLabel{.wall = wall.name, .member = mesh.name, .fraction = mesh.fraction(k)});
      }
  // Forces below the guard tolerance times this scale are zero: ten first steps, but above the mesh's round-off.
  const double force = std::max(10.0 * structure_->force_scale() * std::abs(first_step),
                                structure_->force_roundoff() / TraceOptions{}.guard_tolerance);
  contact_ = std::make_unique<MultiplierContact>(*structure_, std::move(candidates),
                                                 ContactScales{.length = structure_->length_scale(), .force = force});
}

ContactModel Channel::model() const {
  StructureBuilder builder;
  const double h = 0.1 * cm;
  const Vec2 a(0.0, 0.0), b(2.0 * cm, 0.0);
  const Index left = builder.add_joint(a), right = builder.add_joint(b);
  builder.add_member({.name = "column",
                      .from = left,
                      .to = right,
                      .axis = straight_axis(a, b),
                      .imperfection = imperfection,
                      .section = {.E = 2.1e4 * kN / (cm * cm), .A = h * h, .I = h * h * h * h / 12.0, .height = h},
                      .elements = elements});
  fix(builder, left);
  builder.fix(builder.freedom(right, Freedom::z));
  builder.add_load(builder.freedom(right, Freedom::x), -kN, LoadKind::proportional);
  std::vector<TestWall> both;
  if (walls)
    both = {{.name = "upper", .side = Side::above, .profile = flat_profile(0.2 * cm)},
            {.name = "lower", .side = Side::below, .profile = flat_profile(-0.2 * cm)}};
  return {builder.build(), both, first_step};
}

std::vector<SineDeviation> snapping_imperfection(double cm) {
  return {{.amplitude = 0.00176 * cm, .waves = 1}, {.amplitude = 1e-4 * cm, .waves = 3}};
}

}  // namespace arcwall::test
