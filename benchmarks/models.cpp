#include "benchmarks/models.hpp"

#include <cmath>

#include "elements/member_point.hpp"

namespace arcwall::bench {

namespace {

constexpr double lopsided = 0.1;  // so that no other branch leaves on the way

void clamp(StructureBuilder& builder, Index joint) {
  builder.fix(builder.dof(joint, Dof::x));
  builder.fix(builder.dof(joint, Dof::z));
  if (const auto rotation = builder.shared_rotation(joint)) builder.fix(*rotation);
}

// The way down of a degree of freedom z.
std::shared_ptr<const Observable> way_down(const Structure& structure, Index vertical) {
  return std::make_shared<ScaledObservable>(std::make_shared<DofObservable>(structure, vertical), -1.0);
}

}  // namespace

Model lee_frame(int elements) {
  constexpr double side = 120.0;  // [cm]
  StructureBuilder builder;
  const Index foot = builder.add_joint({0.0, 0.0}), corner = builder.add_joint({0.0, side}),
              end = builder.add_joint({side, side});
  const Section section{.E = 720.0, .A = 6.0, .I = 2.0};
  const int in_column = elements / 2, in_beam = elements - in_column;
  builder.add_member({.name = "column",
                      .from = foot,
                      .to = corner,
                      .axis = straight_axis({0.0, 0.0}, {0.0, side}),
                      .section = section,
                      .elements = in_column});
  const Index beam = builder.add_member({.name = "beam",
                                         .from = corner,
                                         .to = end,
                                         .axis = straight_axis({0.0, side}, {side, side}),
                                         .section = section,
                                         .elements = in_beam});
  for (const Index pin : {foot, end})
    for (const Dof which : {Dof::x, Dof::z}) builder.fix(builder.dof(pin, which));
  const Index loaded = builder.mesh(beam).nodes[static_cast<std::size_t>(in_beam / 5)];
  const Index vertical = builder.dof(loaded, Dof::z);
  builder.add_load(vertical, -1.0, LoadKind::proportional);
  Model model{.structure = builder.build(), .end = 90.0, .first_step = 0.1, .elements = elements};
  model.down = way_down(*model.structure, vertical);
  return model;
}

Model star_of_arches(int arms, int elements) {
  constexpr double rise = 0.1, EA = 1e4, EI = 1.0;
  StructureBuilder builder;
  const Vec2 top(0.0, rise);
  const Index crown = builder.add_joint(top);
  const int pairs = arms / 2;
  for (int arm = 0; arm < 2 * pairs; ++arm) {
    const double span = 1.0 + double(arm / 2) / double(pairs), across = arm % 2 == 0 ? -span : span;
    const Vec2 foot(across, 0.0);
    const Index support = builder.add_joint(foot);
    builder.add_member({.name = "arm " + std::to_string(arm),
                        .from = support,
                        .to = crown,
                        .axis = straight_axis(foot, top),
                        .section = {.E = 1.0, .A = EA, .I = EI},
                        .elements = elements});
    clamp(builder, support);
  }
  const Index vertical = builder.dof(crown, Dof::z);
  const double load = EA * rise * rise * rise * pairs;
  builder.add_load(vertical, -load, LoadKind::proportional);
  builder.add_load(builder.dof(crown, Dof::x), lopsided * load, LoadKind::proportional);
  Model model{.structure = builder.build(), .end = 1.5 * rise, .first_step = 0.05, .elements = 2 * pairs * elements};
  model.down = way_down(*model.structure, vertical);
  return model;
}

Model square_frame(int side) {
  constexpr double rise = 0.08, EA = 1e4, EI = 1.0;
  const double bay = 1.0 / (side - 1);
  StructureBuilder builder;
  std::vector<Vec2> places;
  std::vector<Index> joints;
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column) {
      const double x = column * bay;
      places.emplace_back(x, row * bay + rise * std::sin(pi * x));
      joints.push_back(builder.add_joint(places.back()));
    }
  const auto add = [&](int from, int to, const Section& section) {
    const auto a = static_cast<std::size_t>(from), b = static_cast<std::size_t>(to);
    builder.add_member({.name = std::to_string(from) + "-" + std::to_string(to),
                        .from = joints[a],
                        .to = joints[b],
                        .axis = straight_axis(places[a], places[b]),
                        .section = section});
  };
  // The finer the lattice the thinner its posts, or they would hold the rows' slopes.
  const Section row_section{.E = 1.0, .A = EA, .I = EI}, post{.E = 1.0, .A = EA, .I = EI * bay * bay};
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column) {
      const int here = row * side + column;
      if (column + 1 < side) add(here, here + 1, row_section);
      if (row + 1 < side) add(here, here + side, post);
    }
  for (int row = 0; row < side; ++row)
    for (const int column : {0, side - 1}) clamp(builder, joints[static_cast<std::size_t>(row * side + column)]);
  const double load = EA * rise * rise * rise * bay;
  for (int row = 0; row < side; ++row)
    for (int column = 1; column + 1 < side; ++column)
      builder.add_load(builder.dof(joints[static_cast<std::size_t>(row * side + column)], Dof::z),
                       -(1.0 + lopsided * column * bay) * load, LoadKind::proportional);
  const Index vertical = builder.dof(joints[static_cast<std::size_t>(side / 2 * side + side / 2)], Dof::z);
  Model model{.structure = builder.build(),
              .end = 1.5 * rise,
              .first_step = 0.05,
              .elements = static_cast<Index>(2) * side * (side - 1)};
  model.down = way_down(*model.structure, vertical);
  return model;
}

int square_side(Index unknowns) { return static_cast<int>(std::lround(std::sqrt(double(unknowns) / 3.0))); }

State rest(const Structure& structure) { return {.x = Vector::Zero(structure.size({}))}; }

}  // namespace arcwall::bench
