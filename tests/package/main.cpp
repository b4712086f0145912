// The limit load of a shallow truss of two bars, from the installed libraries alone. With Green's strain the load is
// EA w (w − h) (w − 2h) / L³, so its first maximum is 2 EA h³ / (3√3 L³).
#include <arcwall/continuation/tracer.hpp>
#include <arcwall/elements/structure.hpp>
#include <cmath>
#include <cstdio>

int main() {
  using namespace arcwall;
  const double EA = 1e5, half_span = 5.0, rise = 0.5;
  StructureBuilder builder;
  const Index left = builder.add_joint({-half_span, 0.0}), top = builder.add_joint({0.0, rise}),
              right = builder.add_joint({half_span, 0.0});
  for (const Index foot : {left, right}) {
    const Vec2 from = foot == left ? Vec2(-half_span, 0.0) : Vec2(half_span, 0.0);
    builder.add_member({.name = foot == left ? "left" : "right",
                        .from = foot,
                        .to = top,
                        .axis = straight_axis(from, {0.0, rise}),
                        .theory = Theory::truss,
                        .section = {.E = EA, .A = 1.0}});
    for (const Dof which : {Dof::x, Dof::z}) builder.fix(builder.dof(foot, which));
  }
  builder.add_load(builder.dof(top, Dof::z), -1.0, LoadKind::proportional);
  const auto structure = builder.build();

  Tracer tracer(*structure, {.x = Vector::Zero(structure->size({}))}, {.step = {.first = 5.0}, .max_points = 40});
  while (const auto arc = tracer.next())
    for (const Event& event : arc->events) {
      if (event.kind != EventKind::limit_point) continue;
      const double exact =
          2.0 * EA * std::pow(rise, 3) / (3.0 * std::sqrt(3.0) * std::pow(std::hypot(half_span, rise), 3));
      std::printf("limit load %.12g, in closed form %.12g\n", event.state.lambda, exact);
      return std::abs(event.state.lambda - exact) <= 1e-10 * exact ? 0 : 1;
    }
  std::puts("no limit point was found");
  return 1;
}
