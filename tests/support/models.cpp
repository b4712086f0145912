#include "tests/support/models.hpp"

#include <algorithm>
#include <cmath>

namespace arcwall::test {

namespace {

void fix(StructureBuilder& builder, Index joint, bool rotation = false) {
  builder.fix(builder.dof(joint, Dof::x));
  builder.fix(builder.dof(joint, Dof::z));
  if (rotation) builder.fix(builder.shared_rotation(joint).value());
}

void push_down(StructureBuilder& builder, Index joint) {
  builder.add_load(builder.dof(joint, Dof::z), -1.0, LoadKind::proportional);
}

// Joints in a row and the beams between them: member i from joint i to i + 1.
std::vector<Vec2> add_joints(StructureBuilder& builder, std::vector<Vec2> at) {
  for (const Vec2& position : at) builder.add_joint(position);
  return at;
}

MemberDescription beam_between(Index from, Index to, std::unique_ptr<Axis> axis, const Section& section,
                               const BeamTheory& theory, int elements) {
  return {.name = "member " + std::to_string(from),
          .from = from,
          .to = to,
          .axis = std::move(axis),
          .theory = theory.theory,
          .order = theory.order,
          .section = section,
          .elements = theory.finer * elements};
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
  if (!sways) builder.fix(builder.dof(apex, Dof::x));
  push_down(builder, apex);
  return builder.build();
}

std::unique_ptr<Structure> Cantilever::structure() const {
  StructureBuilder builder;
  const auto at = add_joints(builder, {{0.0, 0.0}, {length, 0.0}});
  builder.add_member(beam_between(0, 1, straight_axis(at[0], at[1]), section_of(EA, EI, GA), beam, elements));
  fix(builder, 0, true);
  if (tip_force != 0.0) builder.add_load(builder.dof(1, Dof::z), tip_force, LoadKind::proportional);
  if (tip_push != 0.0) builder.add_load(builder.dof(1, Dof::x), -tip_push, LoadKind::proportional);
  if (tip_moment != 0.0) builder.add_load(builder.shared_rotation(1).value(), tip_moment, LoadKind::proportional);
  return builder.build();
}

ClampedMember clamped_member(const Vec2& clamp, const Vec2& tip, bool reversed, MemberDescription described,
                             const std::optional<Vec2>& middle) {
  ClampedMember member{.clamped = reversed ? 1 : 0, .free = reversed ? 0 : 1};
  const Vec2 &from = reversed ? tip : clamp, &to = reversed ? clamp : tip;
  member.builder.add_joint(from);
  member.builder.add_joint(to);
  described.from = 0;
  described.to = 1;
  described.axis = middle ? arc_axis(from, *middle, to) : straight_axis(from, to);
  member.builder.add_member(std::move(described));
  for (const Dof which : {Dof::x, Dof::z}) member.builder.fix(member.builder.dof(member.clamped, which));
  member.builder.fix(member.builder.shared_rotation(member.clamped).value());
  return member;
}

std::unique_ptr<Structure> Column::structure() const {
  StructureBuilder builder;
  const auto at = add_joints(builder, {{0.0, 0.0}, {length, 0.0}});
  builder.add_member(beam_between(0, 1, straight_axis(at[0], at[1]), section_of(EA, EI, GA), beam, elements));
  fix(builder, 0, clamped);
  builder.fix(builder.dof(1, Dof::z));
  if (clamped) builder.fix(builder.shared_rotation(1).value());
  builder.add_load(builder.dof(1, Dof::x), -1.0, LoadKind::proportional);
  return builder.build();
}

std::unique_ptr<Structure> lee_frame(int elements, const BeamTheory& beam) {
  StructureBuilder builder;
  const auto at = add_joints(builder, {{0.0, 0.0}, {0.0, 120.0}, {24.0, 120.0}, {120.0, 120.0}});
  const Section section{.E = 720.0, .A = 6.0, .I = 2.0, .G = 720.0 / 2.6, .shear_area = 6.0};
  const int count[] = {elements, elements / 5, elements * 4 / 5};
  for (Index i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    builder.add_member(beam_between(i, i + 1, straight_axis(at[k], at[k + 1]), section, beam, count[k]));
  }
  fix(builder, 0);
  fix(builder, 3);
  push_down(builder, 2);
  return builder.build();
}

std::unique_ptr<Structure> williams_toggle(int elements, const BeamTheory& beam) {
  StructureBuilder builder;
  constexpr double b = 0.753, h = 0.243;
  const Section section{.E = 1.03e7, .A = b * h, .I = b * h * h * h / 12.0};
  const auto at = add_joints(builder, {{-12.943, 0.0}, {0.0, 0.386}, {12.943, 0.0}});
  for (const Index i : {0, 1}) {
    const auto k = static_cast<std::size_t>(i);
    builder.add_member(beam_between(i, i + 1, straight_axis(at[k], at[k + 1]), section, beam, elements));
  }
  fix(builder, 0, true);
  fix(builder, 2, true);
  push_down(builder, 1);
  return builder.build();
}

std::unique_ptr<Structure> RoordaFrame::structure() const {
  StructureBuilder builder;
  const auto at = add_joints(builder, {{0.0, 0.0}, {0.0, 1.0}, {1.0, 1.0}});
  for (const Index i : {0, 1}) {
    const auto k = static_cast<std::size_t>(i);
    builder.add_member(beam_between(i, i + 1, straight_axis(at[k], at[k + 1]), section_of(EA, 1.0), beam, elements));
  }
  fix(builder, 0);
  fix(builder, 2);
  push_down(builder, 1);
  if (eccentricity != 0.0) builder.add_load(builder.shared_rotation(1).value(), -eccentricity, LoadKind::proportional);
  return builder.build();
}

std::unique_ptr<Structure> DiamondFrame::structure() const {
  StructureBuilder builder;
  const double c = std::sqrt(0.5);
  const auto at = add_joints(builder, {{0.0, -c}, {c, 0.0}, {0.0, c}, {-c, 0.0}});
  for (const Index i : {0, 1, 2, 3}) {
    const Index next = (i + 1) % 4;
    auto bar = beam_between(i, next, straight_axis(at[static_cast<std::size_t>(i)], at[static_cast<std::size_t>(next)]),
                            section_of(EA, 1.0), beam, elements);
    bar.hinge_from = i % 2 == 0;
    bar.hinge_to = next % 2 == 0;
    builder.add_member(std::move(bar));
  }
  fix(builder, 0);
  builder.fix(builder.dof(2, Dof::x));
  builder.add_load(builder.dof(2, Dof::z), 2.0, LoadKind::proportional);
  return builder.build();
}

std::unique_ptr<Structure> CircularArch::structure() const {
  StructureBuilder builder;
  const auto on_circle = [&](double angle) { return Vec2(radius * std::sin(angle), radius * std::cos(angle)); };
  const auto at = add_joints(builder, {on_circle(-half_angle), {0.0, radius}, on_circle(half_angle)});
  for (const Index i : {0, 1}) {
    const auto k = static_cast<std::size_t>(i);
    builder.add_member(beam_between(i, i + 1, arc_axis(at[k], on_circle((double(i) - 0.5) * half_angle), at[k + 1]),
                                    section_of(EA, EI, GA), beam, elements));
  }
  fix(builder, 0, clamped_left);
  fix(builder, 2, clamped_right);
  push_down(builder, 1);
  return builder.build();
}

std::unique_ptr<Structure> deep_arch(int elements, const BeamTheory& beam, double GA) {
  return CircularArch{.radius = 100.0,
                      .half_angle = 107.5 * pi / 180.0,
                      .EA = 1e8,
                      .EI = 1e6,
                      .clamped_right = true,
                      .elements = elements,
                      .GA = GA,
                      .beam = beam}
      .structure();
}

std::unique_ptr<Structure> pinned_semicircle(int elements, const BeamTheory& beam) {
  return CircularArch{.radius = 127.0, .EA = 1378.0 * 64.52, .EI = 1378.0 * 41.62, .elements = elements, .beam = beam}
      .structure();
}

std::unique_ptr<Structure> shallow_arch(int elements, const BeamTheory& beam) {
  constexpr double half_chord = 5000.0, rise = 500.0;
  constexpr double radius = (half_chord * half_chord + rise * rise) / (2.0 * rise);
  return CircularArch{.radius = radius,
                      .half_angle = std::asin(half_chord / radius),
                      .EA = 2e6,
                      .EI = 2e10,
                      .elements = elements,
                      .beam = beam}
      .structure();
}

std::shared_ptr<const Observable> displacement(const Structure& structure, Index node, Dof which) {
  return std::make_shared<DofObservable>(structure, structure.dof(node, which));
}

std::shared_ptr<const Observable> joint_rotation(const Structure& structure, Index joint) {
  for (const MemberMesh& mesh : structure.members()) {
    if (mesh.nodes.front() == joint) return std::make_shared<DofObservable>(structure, mesh.rotations.front().value());
    if (mesh.nodes.back() == joint) return std::make_shared<DofObservable>(structure, mesh.rotations.back().value());
  }
  return nullptr;
}

Vec2 displacement_of(const Structure& structure, const State& state, Index node) {
  return structure.current(state, node) - structure.position(node);
}

TargetValue stop_at(const Structure& structure, Index node, Dof which, double value) {
  return {.quantity = displacement(structure, node, which), .value = value, .stops = true, .label = "displacement"};
}

TraceOptions PathModel::options() const {
  TraceOptions options;
  options.step.first = first_step;
  options.target_values = target_values;
  return options;
}

std::vector<Watch> PathModel::watched() const {
  if (!watch) return {};
  return {{.quantity = displacement(*structure, loaded, Dof::z), .label = "z"}};
}

std::shared_ptr<const Obstacle> TestWall::obstacle() const {
  auto at_rest = arcwall::obstacle(profile, side);
  if (motion.is_none()) return at_rest;
  return std::make_shared<MovingObstacle>(std::move(at_rest), motion);
}

std::vector<Candidate> candidates(const Structure& structure, const std::vector<TestWall>& walls) {
  std::vector<Candidate> all;
  for (const TestWall& wall : walls)
    for (const MemberMesh& mesh : structure.members())
      for (const MemberSection& section : mesh.contact_sections()) {
        const double looks_up = wall.side == Side::above ? 1.0 : -1.0;
        const double offset =
            wall.on_axis ? 0.0 : std::copysign(0.5 * mesh.height.value(), looks_up * std::cos(section.shape.angle));
        auto point = std::make_unique<MemberPoint>(structure, section, offset);
        if (point->unknowns().empty()) continue;
        all.emplace_back(
            std::move(point), wall.obstacle(),
            ContactLabel{
                .wall = wall.name, .member = mesh.name, .fraction = section.fraction, .tributary = section.tributary});
      }
  return all;
}

ContactModel::ContactModel(std::unique_ptr<Structure> structure, const std::vector<TestWall>& walls, double first_step,
                           const ContactLaw& law)
    : structure_(std::move(structure)) {
  // Forces below the guard tolerance times this scale are zero: ten first steps, but above the mesh's round-off.
  const double force = std::max(10.0 * structure_->force_scale() * std::abs(first_step),
                                structure_->force_roundoff() / TraceOptions{}.guard_tolerance);
  contact_ =
      std::make_unique<MultiplierContact>(*structure_, candidates(*structure_, walls),
                                          ContactScales{.length = structure_->length_scale(), .force = force}, law);
}

std::unique_ptr<Structure> foundation_structure(int elements) {
  StructureBuilder builder;
  const auto at = add_joints(builder, {{0.0, 0.0}, {2.0, 0.0}});
  constexpr double h = 0.2;
  const Section section{.E = 21000.0, .A = h * h, .I = h * h * h * h / 12.0, .height = h};
  builder.add_member(beam_between(0, 1, straight_axis(at[0], at[1]), section, {}, elements));
  fix(builder, 0);
  builder.fix(builder.dof(1, Dof::z));
  builder.add_load(builder.shared_rotation(0).value(), -1.0, LoadKind::proportional);
  builder.add_load(builder.shared_rotation(1).value(), 1.0, LoadKind::proportional);
  return builder.build();
}

std::vector<TestWall> foundation_wall() {
  return {{.name = "foundation", .side = Side::below, .profile = flat_profile(-0.18)}};
}

ContactModel foundation_beam(int elements, const ContactLaw& law) {
  return {foundation_structure(elements), foundation_wall(), 0.05, law};
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
  builder.fix(builder.dof(right, Dof::z));
  builder.add_load(builder.dof(right, Dof::x), -kN, LoadKind::proportional);
  std::vector<TestWall> both;
  if (walls)
    both = {{.name = "upper", .side = Side::above, .profile = flat_profile(0.2 * cm)},
            {.name = "lower", .side = Side::below, .profile = flat_profile(-0.2 * cm)}};
  return {builder.build(), both, first_step, law};
}

std::vector<SineDeviation> snapping_imperfection(double cm) {
  return {{.amplitude = 0.00176 * cm, .waves = 1}, {.amplitude = 1e-4 * cm, .waves = 3}};
}

}  // namespace arcwall::test
