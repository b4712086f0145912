// What walls exert on a structure is in balance with its supports and loads.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/derivative_check.hpp"
#include "tests/model/traced_session.hpp"

namespace arcwall::wall_balance_test {

namespace {

constexpr const char* leaf_on_a_former = R"toml(
title = "A leaf clamped tangentially on a former and bent over it"
material.m = { E = 1.0, nu = 0.3 }
section.s = { shape = "general", A = 1e5, I = 1.0 }
point = { A = [0.0, 0.0], B = [1.0, 0.0] }
support.A = ["x", "z", "rotation"]
load = [{ at = "B", force = [0.0, -1.0] }]
path = { step = 0.1, stop.lambda = [-0.1, 10.0] }
monitor = [{ name = "x", at = "A", component = "reaction-x" }, { name = "z", at = "A", component = "reaction-z" },
           { name = "m", at = "A", component = "reaction-moment" },
           { name = "wall-x", wall = "former", component = "force-x" },
           { name = "wall-z", wall = "former", component = "force-z" },
           { name = "wall-m", wall = "former", component = "moment" },
           { name = "tip-x", at = "B", component = "x" }]
[[wall]]
name = "former"
contact_surface = "axis"
outline = { type = "circle", centre = [0.0, -1.0], radius = 1.0 }
[member.leaf]
from = "A"
to = "B"
theory = "elastica"
material = "m"
section = "s"
elements = 40
)toml";

// Sums at a point of the monitors of forces along x, along z and of moments about the origin, where A is, with those of
// the load (0, −λ) at B, which is at 1 + tip-x; the greatest of these forces and moments.
struct Sums {
  std::array<double, 3> sum{};
  double greatest = 0.0;
};

Sums sums_at(const RecordPoint& point) {
  const auto& m = point.monitors;
  const double load = -point.lambda;
  Sums sums{.sum = {m[0] + m[3], m[1] + m[4] + load, m[2] + m[5] + (1.0 + m[6]) * load}};
  for (std::size_t i = 0; i < 6; ++i) sums.greatest = std::max(sums.greatest, std::abs(m[i]));
  return sums;
}

bool is_wall(const MonitorColumn& column) { return column.name.starts_with("wall-"); }

}  // namespace

// Statics: the forces on the whole are zero in sum, and so are the moments. What remains is what Newton's method
// leaves, and the round-off of stiffness times length, EA L = 10⁵, on any mesh.
TEST(WallBalance, HoldsOnAFormerOnAnyMeshSlow) {
  constexpr double left = 1e5 * 1e-12;
  for (const char* const elements : {"10", "20", "40"})
    for (const char* const theory : {"elastica", "euler-bernoulli"}) {
      SCOPED_TRACE(std::string(theory) + ", elements " + elements);
      const Session run = test::traced(leaf_on_a_former, {std::string("member.leaf.elements=") + elements,
                                                          std::string("member.leaf.theory=\"") + theory + "\""});
      Index pressed = 0;
      for (const RecordPoint& point : run.points()) {
        const Sums sums = sums_at(point);
        pressed += point.contacts > 0 && std::abs(point.monitors[4]) > 0.1 ? 1 : 0;
        for (const double sum : sums.sum)
          EXPECT_LE(std::abs(sum), 1e-9 * sums.greatest + left) << "step " << point.step << ", " << sum;
      }
      EXPECT_GT(pressed, 10);
    }
}

// Of contact at nodes by all methods, springs on the wall among them.
TEST(WallBalance, HoldsForContactAtNodesSlow) {
  for (const char* const method : {"multiplier", "penalty", "augmented"}) {
    SCOPED_TRACE(method);
    std::vector<std::string> settings{"contact.points=\"nodes\"", std::string("contact.method=\"") + method + "\""};
    if (std::string(method) != "multiplier") settings.emplace_back("contact.penalty=1e4");
    const Session run = test::traced(leaf_on_a_former, settings);
    for (const RecordPoint& point : run.points()) {
      const Sums sums = sums_at(point);
      for (const double sum : sums.sum) EXPECT_LE(std::abs(sum), 1e-8 * sums.greatest + 1e-9) << "step " << point.step;
    }
  }
}

TEST(WallBalance, RatesOfWallForcesAreTheirDerivatives) {
  const std::vector<std::vector<std::string>> settings{
      {"member.leaf.elements=10"},
      {"member.leaf.elements=10", "contact.points=\"nodes\"", "wall.former.motion={x=0.01,rotation=0.02}"}};
  for (const std::vector<std::string>& setting : settings) {
    SCOPED_TRACE(setting.back());
    const Session run = test::traced(leaf_on_a_former, setting);
    Index checked = 0;
    for (const RecordPoint& point : run.points()) {
      if (point.contacts == 0 || point.step % 5 != 0) continue;
      for (const MonitorColumn& column : run.model().monitors())
        if (is_wall(column)) {
          EXPECT_LE(check_gradient(*column.quantity, point.state), 1e-6) << column.name << ", step " << point.step;
          ++checked;
        }
    }
    EXPECT_GT(checked, 6);
  }
}

// A support bears what a wall exerts on the point that it holds: of a strip whose tip is driven along an inclined wall,
// rests on a roller on it, or is held in its rotation with a face on it. The sums of all forces and moments are zero,
// the derivatives are those of the values, and λ does the work of the driven tip's reaction.
TEST(WallBalance, HoldsWhereASupportHoldsThePointThatTouches) {
  const std::string strip = R"toml(
title = "A strip whose tip is on an inclined wall"
units = { length = "mm", force = "N" }
material.steel = { E = 210000.0 }
section.s = { shape = "rectangle", width = 10.0, height = 1.0 }
point = { A = [0.0, 5.0], B = [100.0, 0.0] }
member.c = { from = "A", to = "B", theory = "elastica", material = "steel", section = "s", elements = 20 }
monitor = [{ name = "x", at = "A", component = "reaction-x" }, { name = "z", at = "A", component = "reaction-z" },
           { name = "m", at = "A", component = "reaction-moment" },
           { name = "wall-x", wall = "w", component = "force-x" }, { name = "wall-z", wall = "w", component = "force-z" },
           { name = "wall-m", wall = "w", component = "moment" },
           { name = "tip-x", at = "B", component = "x" }, { name = "tip-z", at = "B", component = "z" },
           { name = "held-x", at = "B", component = "reaction-x" }, { name = "held-z", at = "B", component = "reaction-z" },
           { name = "held-m", at = "B", component = "reaction-moment" }]
support.A = ["x", "z", "rotation"]
)toml";
  const std::string driven = "path = { step = 0.1, stop.lambda = [-1.0, 3.0] }\n";
  const std::string wall =
      "[[wall]]\nname = \"w\"\noutline = { type = \"half-plane\", point = [100.0, -1.0], normal = ";
  const std::vector<std::string> held = {
      "prescribed = [{ at = \"B\", x = -1.0, rotation = -0.02 }]\nsupport.B = [\"rotation\"]\n" + driven + wall +
          "[-0.3, 1.0] }\n",
      "prescribed = [{ at = \"B\", z = -1.0 }]\nsupport.B = [\"rotation\"]\n" + driven + wall + "[-1.0, 1.0] }\n",
      "support.B = [\"z\", \"rotation\"]\n" + driven + wall + "[-1.0, 1.0] }\nmotion = { x = -1.0 }\n"};
  for (const std::string& support : held)
    for (const std::string contact :
         {"points = \"moving\"", "points = \"nodes\"", "method = \"penalty\"\npenalty = 1e4"})
      for (const std::string surface : {"axis", "face"}) {
        if (surface == "face" && contact == "points = \"moving\"") continue;
        SCOPED_TRACE(support + contact + surface);
        const Session run =
            test::traced(strip + support + "contact_surface = \"" + surface + "\"\n[contact]\n" + contact + "\n");
        bool touches = false;
        for (const RecordPoint& point : run.points()) {
          const auto& m = point.monitors;
          const double arm_x = 100.0 + m[6], arm_z = -5.0 + m[7];
          const std::array<double, 3> sums{m[0] + m[3] + m[8], m[1] + m[4] + m[9],
                                           m[2] + m[5] + 5.0 * m[3] + m[10] + arm_x * m[9] - arm_z * m[8]};
          for (const double sum : sums) EXPECT_NEAR(sum, 0.0, 1e-7 * (1.0 + std::abs(m[2]) + 100.0 * std::abs(m[0])));
          touches = touches || std::abs(m[4]) > 1.0;
        }
        EXPECT_TRUE(touches);
        const RecordPoint& last = run.points().back();
        for (const MonitorColumn& column : run.model().monitors()) {
          if (!column.name.starts_with("held-")) continue;
          EXPECT_LE(check_gradient(*column.quantity, last.state), 1e-5) << column.name;
        }
      }
}

}  // namespace arcwall::wall_balance_test
