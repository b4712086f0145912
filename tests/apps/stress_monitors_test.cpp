// Monitors of stresses in outer fibres and of the use of an allowable stress, against hand formulas.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "core/derivative_check.hpp"
#include "core/error.hpp"
#include "tests/apps/loading/loading_decks.hpp"
#include "tests/model/deck/sample_decks.hpp"

namespace arcwall::stress_monitors_test {

namespace {

using loading_test::expect_confirmed;
using test::said_of;
using test::TracedDeck;

constexpr double pi = std::numbers::pi;

struct Shape {
  std::string keys;
  double A, W;  // area and section modulus
};

const Shape rectangle{"shape = \"rectangle\", width = 2.0, height = 0.3", 0.6, 2.0 * 0.09 / 6.0};
const Shape tube{"shape = \"tube\", radius = 0.5, thickness = 0.1", pi*(0.25 - 0.16),
                 pi*(0.0625 - 0.0256) / (4.0 * 0.5)};
const Shape circle{"shape = \"circle\", radius = 0.4", pi * 0.16, pi * 0.064 / 4.0};
const Shape general{"shape = \"general\", A = 0.5, I = 0.02, height = 0.8", 0.5, 0.05};

std::string monitor(const std::string& name, const std::string& of, const std::string& component) {
  return fmt::format("[[monitor]]\nname = \"{}\"\n{}\ncomponent = \"{}\"\n", name, of, component);
}

const std::string all_of_them = monitor("s", "member = \"beam\"", "max-stress") +
                                monitor("use", "member = \"beam\"", "utilisation") + monitor("all", "", "max-stress");

// A member from A to B of length 10.
std::string member(const Shape& shape, const std::string& theory, const std::string& more) {
  return fmt::format(R"toml(
title = "Stress"
material.m = {{ E = 2e4, nu = 0.3, allowable = 8.0 }}
section.s = {{ {} }}
point = {{ A = [0.0, 0.0], B = [10.0, 0.0] }}
member.beam = {{ from = "A", to = "B", {}, elements = 6, material = "m", section = "s" }}
)toml",
                     shape.keys, theory) +
         more;
}

double last(const TracedDeck& run, const std::string& name) {
  const auto& columns = run.record().columns;
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (columns[i].name == name) return run.record().points.back().monitors[i];
  ADD_FAILURE() << "no monitor is called " << name;
  return 0.0;
}

void expect_gradients(const TracedDeck& run) {
  for (const MonitorColumn& column : run.model().monitors())
    if (!column.is_place) {
      EXPECT_LE(check_gradient(*column.quantity, run.last(), 1e-7), 2e-6) << column.name;
    }
}

void expect_in(const std::string& said, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) EXPECT_NE(said.find(part), std::string::npos) << said << "\n: " << part;
}

const std::string far_wall = "[[wall]]\nname = \"w\"\nside = \"below\"\nprofile = { type = \"flat\", z = -50.0 }\n";

}  // namespace

// A cantilever that bends much: σ = |N|/A + |M|/W in its clamp, where N is the load along it and M the load times its
// arm, by the places of the run.
TEST(StressMonitor, OfACantileverIsThatOfItsClamp) {
  for (const Shape& shape : {rectangle, tube, circle, general})
    for (const std::string& theory : {std::string("theory = \"euler-bernoulli\""), std::string("theory = \"elastica\""),
                                      std::string("theory = \"reissner\"")})
      for (const std::string& walls : {std::string(), theory.find("reissner") == std::string::npos ? far_wall : ""}) {
        SCOPED_TRACE(shape.keys + ", " + theory + walls);
        const double P = 0.05 * 2e4 * shape.W / 10.0;
        const TracedDeck run(member(shape, theory,
                                    fmt::format(R"toml(
support = {{ A = ["x", "z", "rotation"] }}
load = [{{ at = "B", force = [{:.17g}, {:.17g}] }}]
path = {{ step = 0.1, stop = {{ lambda = [-1.0, 1.0] }} }}
)toml",
                                                -0.2 * P, -P) +
                                        walls + all_of_them + monitor("x", "at = \"B\"", "x") +
                                        monitor("z", "at = \"B\"", "z")));
        const double M = P * (10.0 + last(run, "x")) - 0.2 * P * last(run, "z");
        const double expected = 0.2 * P / shape.A + M / shape.W;
        EXPECT_NEAR(last(run, "s"), expected, 1e-8 * expected);
        EXPECT_NEAR(last(run, "use"), expected / 8.0, 1e-8 * expected);
        EXPECT_NEAR(last(run, "all"), expected, 1e-8 * expected);
        EXPECT_EQ(last(run, "s-place"), 0.0);
        EXPECT_EQ(last(run, "all-place"), 0.0);
        EXPECT_EQ(last(run, "all-member"), 0.0);
        expect_gradients(run);
        expect_confirmed(run);
      }
}

// The secant formula: a column pinned at both ends with the load P at an eccentricity e carries e P sec(L/2 √(P/EI)) in
// its middle. It belongs to small slopes and to a length that P leaves as it is: to P/EA, 5e-5 here.
TEST(StressMonitor, OfAnEccentricColumnFollowsTheSecantFormula) {
  const Shape thin_tube{"shape = \"tube\", radius = 0.05, thickness = 0.01", 1e-2 * tube.A, 1e-3 * tube.W};
  const Shape thin_bar{"shape = \"rectangle\", width = 2.0, height = 0.03", 0.06, 3e-4};
  for (const auto& [shape, h] : {std::pair(thin_bar, 0.03), std::pair(thin_tube, 0.1)}) {
    SCOPED_TRACE(shape.keys);
    const double EI = 2e4 * shape.W * h / 2.0, P = 0.5 * pi * pi * EI / 100.0, e = 1e-3 * h;
    const TracedDeck run(member(shape, "theory = \"elastica\"",
                                fmt::format(R"toml(
support = {{ A = ["x", "z"], B = ["z"] }}
load = [{{ at = "B", force = [{:.17g}, 0.0] }}, {{ at = "A", moment = {:.17g} }}, {{ at = "B", moment = {:.17g} }}]
path = {{ step = 0.1, output_at = {{ lambda = [0.2, 0.4, 0.6, 0.8] }}, stop = {{ lambda = [-1.0, 1.0] }} }}
)toml",
                                            -P, P * e, -P * e) +
                                    all_of_them));
    const double bending = P * e / (shape.W * std::cos(5.0 * std::sqrt(P / EI)));
    EXPECT_NEAR(last(run, "s"), P / shape.A + bending, 3e-4 * bending);
    EXPECT_NEAR(last(run, "s-place"), 0.5, 1e-6);
    expect_confirmed(run);
  }
}

// A tie and a strut of a toggle of bars, one thicker than the other: N by statics in the displaced shape, and the
// thinner one, the second member, is stressed most.
TEST(StressMonitor, OfTrussesNeedsNoHeight) {
  const TracedDeck run(R"toml(
title = "Two bars"
material.m = { E = 1e4, allowable = 10.0 }
material.weak = { E = 1e4, allowable = 1.0 }
section.thick = { shape = "general", A = 2.0, I = 0.1 }
section.thin = { shape = "general", A = 0.5, I = 0.1 }
point = { A = [0.0, 0.0], top = [3.0, 4.0], B = [6.0, 0.0] }
support = { A = ["x", "z"], B = ["x", "z"] }
load = [{ at = "top", force = [0.0, -1.0] }]
path = { step = 0.5, output_at = { lambda = [0.1, 0.3, 0.6, 0.8] }, stop = { lambda = [-1.0, 1.0] } }
[member]
left = { from = "A", to = "top", theory = "truss", material = "weak", section = "thick", elements = 1 }
right = { from = "top", to = "B", theory = "truss", material = "m", section = "thin", elements = 1 }
)toml" + monitor("s", "", "max-stress") +
                       monitor("left", "member = \"left\"", "max-stress") + monitor("use", "", "utilisation"));
  // By the undisplaced shape N = 5/8 of the load, which changes by strains of 10⁻⁴.
  EXPECT_NEAR(last(run, "s"), 0.625 / 0.5, 1e-3);
  EXPECT_EQ(last(run, "s-member"), 1.0);
  EXPECT_NEAR(last(run, "left"), 0.625 / 2.0, 1e-3);
  EXPECT_NEAR(last(run, "use"), 0.625 / 2.0, 1e-3);
  EXPECT_EQ(last(run, "use-member"), 0.0);
  expect_confirmed(run);
}

// A cantilever that is half as deep behind a step, which lies between two nodes: M h/2I is greatest just behind it.
TEST(StressMonitor, LooksAtStepsOfASectionBetweenNodes) {
  const TracedDeck run(R"toml(
title = "A stepped cantilever"
material.m = { E = 2.0e5 }
section.s = { shape = "table", at = [0.0, 0.25, 0.25001, 1.0], A = [200.0, 200.0, 100.0, 100.0], I = [2000.0, 2000.0, 500.0, 500.0], height = [10.0, 10.0, 10.0, 10.0] }
point = { a = [0.0, 0.0], b = [1000.0, 0.0] }
support = { a = ["x", "z", "rotation"] }
load = [{ at = "b", force = [0.0, -1.0] }]
member.c = { from = "a", to = "b", theory = "elastica", material = "m", section = "s", elements = 17 }
path = { step = 0.5, output_at = { lambda = [0.2, 0.4, 0.6, 0.8] }, stop = { lambda = [-1.0, 1.0] } }
)toml" + monitor("s", "", "max-stress"));
  EXPECT_NEAR(last(run, "s"), 0.74999 * 1000.0 * 5.0 / 500.0, 1e-4);
  EXPECT_NEAR(last(run, "s-place"), 0.25001, 1e-12);
  expect_confirmed(run);
}

TEST(StressMonitor, StopsAPathAtTheAllowable) {
  const TracedDeck run(member(rectangle, "theory = \"elastica\"", R"toml(
support = { A = ["x", "z", "rotation"] }
load = [{ at = "B", force = [0.0, -0.1] }]
path = { step = 0.1, stop = { lambda = [-1.0, 10.0], use = [-1.0, 1.0] } }
)toml" + all_of_them));
  EXPECT_NEAR(last(run, "use"), 1.0, 1e-11);
  EXPECT_NEAR(last(run, "s"), 8.0, 1e-10);
}

TEST(StressMonitor, IsRefusedWhereWhatItNeedsIsMissing) {
  const std::string loaded = R"toml(
support = { A = ["x", "z", "rotation"] }
load = [{ at = "B", force = [0.0, -0.1] }]
path = { step = 0.1, stop = { lambda = [-1.0, 1.0] } }
)toml";
  const Shape flat{"shape = \"general\", A = 0.5, I = 0.02", 0.5, 0.0};
  const auto with = [&](const Shape& shape, const std::string& monitors) {
    return member(shape, "theory = \"elastica\"", loaded + monitors);
  };
  const std::string stress = monitor("s", "member = \"beam\"", "max-stress");
  expect_in(said_of(with(flat, stress)),
            {"monitor.0.component", "section s of member beam has no height", "add section.s.height"});
  expect_in(said_of(with(flat, monitor("s", "", "utilisation"))), {"monitor.0.component", "add section.s.height"});
  const std::string use = with(rectangle, monitor("u", "", "utilisation"));
  expect_in(said_of(deck::replaced(use, ", allowable = 8.0", "")),
            {"monitor.0.component", "material m of member beam has no allowable stress", "add material.m.allowable"});
  expect_in(said_of(deck::replaced(use, "allowable = 8.0", "allowable = -8.0")), {"material.m.allowable"});
  expect_in(said_of(with(rectangle, monitor("s", "at = \"B\"", "max-stress"))),
            {"monitor.0.component", "max-stress belongs to a member or the whole structure", "leave out `at`"});
  expect_in(said_of(with(rectangle, monitor("s", "", "max-moment"))), {"monitor.0", "none of `at`, `wall`"});
  const std::string watched =
      deck::replaced(with(rectangle, stress), "path = { step", "path = { watch = [\"s\"], step");
  expect_in(said_of(watched), {"path.watch", "may turn where its place jumps"});
}

// The greatest moment is that at the clamp, and so are its derivatives, also where the moment is so small and the mesh
// so fine that the steps of differences lead beyond zero.
TEST(StressMonitors, HaveTheDerivativesOfTheSection) {
  const TracedDeck run(R"(
title = "A frame that is hardly bent"
material.m = { E = 1.0, nu = 0.3 }
section.s = { shape = "general", A = 1e4, I = 1.0 }
point = { a = [0.0, 0.0], b = [1.0, 0.0], c = [1.0, -0.7] }
support = { a = ["x", "z"], c = ["x", "z", "rotation"] }
member.l = { from = "a", to = "b", theory = "elastica", material = "m", section = "s", elements = 20 }
member.r = { from = "b", to = "c", theory = "elastica", material = "m", section = "s", elements = 20 }
load = [{ at = "b", force = [-13.0, -1.0] }]
monitor = [{ name = "greatest", member = "r", component = "max-moment" }, { name = "clamp", at = "r:1", component = "moment" }]
path = { step = 0.1, stop = { lambda = [-0.1, 0.3] } }
)");
  const State& state = run.last();
  const auto of = [&](const std::string& name) { return run.model().quantity(name); };
  const double sign = of("clamp")->value(state) < 0.0 ? -1.0 : 1.0;
  EXPECT_NEAR(of("greatest")->value(state), sign * of("clamp")->value(state), 1e-12);
  const Row greatest = of("greatest")->gradient(state), clamp = of("clamp")->gradient(state);
  EXPECT_LE((greatest.dx - sign * clamp.dx).norm(), 1e-8 * clamp.dx.norm());
}

}  // namespace arcwall::stress_monitors_test
