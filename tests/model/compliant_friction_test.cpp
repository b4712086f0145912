#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "core/algebra/bordered_solver.hpp"
#include "core/error.hpp"
#include "model/deck/reader.hpp"
#include "tests/model/friction_decks.hpp"
#include "tests/support/deck_tables.hpp"

// Friction of compliant walls: an elastic slip, and return mapping at material points.
namespace arcwall::compliant_friction_test {

using namespace test::tables;

namespace {

using friction_test::expect_resumed;
using friction_test::monitor_at_end;
using friction_test::run_of;
using friction_test::session_of;
using friction_test::stage;

double dissipated(const Session& run) { return run.points().back().dissipation.front(); }

// A bar of EA = 210 that an end at A pulls along, and at its other end a block of length 1 that weighs 1 and is pressed
// on a floor by that alone: μ = 0.3, T ≤ 0.3.
std::string block(double tangential, double step, const std::string& stages) {
  return material("m", 210.0) + material("stiff", 1e9) + general_section("s", 1.0, 1.0) +
         points({{"A", 0.0, 0.0}, {"B", 10.0, 0.0}, {"C", 11.0, 0.0}}) + member("bar", "A", "B", "euler-bernoulli", 1) +
         member("block", "B", "C", "euler-bernoulli", 2, "", "stiff") + supports({{"A", "rotation"}}) +
         prescribed("A", "x = 1.0") + distributed("block", 0.0, -1.0, constant) +
         contact(fmt::format(R"(method = "compliant"; law = {{ stiffness = 100.0, tangential_stiffness = {} }})",
                             tangential)) +
         path(fmt::format("step = {}", step)) +
         flat_wall("floor", "below", 0.0, R"(members = ["block"]; contact_surface = "axis"; friction = 0.3)") +
         monitor("F", "A", "reaction-x") + wall_monitor("T", "floor", "friction-force") +
         wall_monitor("use", "floor", "friction-use") +
         table("[[monitor]]", R"(name = "w"; wall = "floor"; at = "block:0.5"; component = "slip")") + stages;
}

std::string cycle(double step) {
  return stage("out", "prescribed.0", step, -1.0, 0.05) + stage("back", "prescribed.0", -step, -0.1, 1.0) +
         stage("again", "prescribed.0", step, -1.0, 0.1);
}

// A bar of EA = 210 and length 10 that lies on a floor with a weight of 0.05 by length, pushed at its left end; the
// friction is 0.02 by length at most.
std::string heavy_bar(int elements, double tangential, double step, double far) {
  return material("m", 210.0) + general_section("s", 1.0, 1.0) + points({{"A", 0.0, 0.0}, {"B", 10.0, 0.0}}) +
         member("bar", "A", "B", "euler-bernoulli", elements) + supports({{"A", "rotation"}}) +
         prescribed("A", "x = 1.0") + distributed("bar", 0.0, -0.05, constant) +
         contact(fmt::format(R"(method = "compliant"; law = {{ stiffness = 100.0, tangential_stiffness = {} }})",
                             tangential)) +
         flat_wall("floor", "below", 0.0, rough(0.4)) + monitor("F", "A", "reaction-x") +
         stage("push", "prescribed.0", step, -1.0, far);
}

// What pushes that bar's end by u where its friction is elastic with k by length up to q: a front at a, beyond which
// u = u_f cosh β (L − x)/cosh β (L − a), u_f = q/k.
double force_on_heavy_bar(double k, double u) {
  constexpr double EA = 210.0, L = 10.0, q = 0.02;
  const double beta = std::sqrt(k / EA), u_f = q / k;
  const auto at_front = [&](double a) { return EA * beta * u_f * std::tanh(beta * (L - a)); };
  if (u < u_f) return EA * beta * u * std::tanh(beta * L);
  double low = 0.0, high = L;
  for (int i = 0; i < 200; ++i) {
    const double a = 0.5 * (low + high);
    (u_f + (at_front(a) * a + 0.5 * q * a * a) / EA < u ? low : high) = a;
  }
  return at_front(low) + q * low;
}

}  // namespace

// Jenkins' element: a bar of stiffness 21 in series with an elastic slip of stiffness 50 slips at F = 0.3, and a cycle
// of amplitude U dissipates 4 · 0.3 · (U − 0.3/k).
TEST(CompliantFriction, IsJenkinsElement) {
  const Session run = run_of(block(50.0, 0.005, cycle(0.005)));
  const double k = 1.0 / (1.0 / 21.0 + 1.0 / 50.0), F = 0.3, U = 0.05;
  EXPECT_EQ(run.record().stages.size(), 3u);
  for (const RecordPoint& point : run.points()) {
    EXPECT_LE(std::abs(point.monitors[1]), F * (1.0 + 1e-9));
    EXPECT_NEAR(point.monitors[0], -point.monitors[1], 1e-9);
    if (point.branch == 0) {
      EXPECT_NEAR(point.monitors[0], std::min(k * point.lambda, F), 5e-9) << point.lambda;
    }
    if (point.branch == 1) {
      EXPECT_NEAR(point.monitors[0], std::max(F + k * point.lambda, -F), 5e-9) << point.lambda;
    }
  }
  std::vector<double> at_ends;
  for (std::size_t i = 0; i + 1 < run.points().size(); ++i)
    if (run.points()[i].branch != run.points()[i + 1].branch) at_ends.push_back(run.points()[i].dissipation.front());
  ASSERT_EQ(at_ends.size(), 2u);
  EXPECT_NEAR(at_ends[0], F * (U - F / k), 1e-9);
  EXPECT_NEAR(dissipated(run) - at_ends[0], 4.0 * F * (U - F / k), 1e-9);
}

// Nothing of it depends on steps: the sense of slip turns at ends of stages alone.
TEST(CompliantFriction, KnowsNoStepsWhereSlipTurnsAtReversals) {
  const Session run = run_of(block(50.0, 0.005, cycle(0.005)));
  for (const double step : {0.00125, 0.02}) {
    const Session other = run_of(block(50.0, step, cycle(step)));
    EXPECT_NEAR(monitor_at_end(other, 0), monitor_at_end(run, 0), 1e-12);
    EXPECT_NEAR(monitor_at_end(other, 3), monitor_at_end(run, 3), 1e-12);
    EXPECT_NEAR(dissipated(other), dissipated(run), 1e-12);
  }
}

TEST(CompliantFriction, ResumesToTheLastBit) {
  const std::string text = block(50.0, 0.005, cycle(0.005));
  const Session run = run_of(text);
  for (const std::size_t killed : {3u, 9u, static_cast<unsigned>(run.points().size() / 2)})
    expect_resumed(text, run, killed);
}

// The front of slip runs in; its place is known to a part of an element, and forces have an error of its square.
TEST(CompliantFriction, PushesAHeavyBar) {
  constexpr double k = 40.0, far = 0.003;
  std::vector<double> errors;
  for (const int elements : {8, 16, 32}) {
    const Session run = run_of(heavy_bar(elements, k, 0.0003, far));
    double worst = 0.0;
    for (const RecordPoint& point : run.points())
      worst = std::max(worst, std::abs(point.monitors[0] - force_on_heavy_bar(k, point.lambda)));
    errors.push_back(worst);
  }
  EXPECT_LT(errors[2], 2e-4 * force_on_heavy_bar(k, far));
  EXPECT_LT(errors[1], errors[0] / 3.0);
  EXPECT_LT(errors[2], errors[1] / 3.0);
}

// F and its derivatives by differences, at states in which points stick, slip and are not pressed.
TEST(CompliantFriction, HasRightDerivatives) {
  const std::string text = R"(
title = "On a bed that λ moves and turns"
[material.m]
E = 100.0
nu = 0.3
[section.s]
shape = "rectangle"
width = 1.0
height = 0.3
[point]
left = [0.0, 0.0]
right = [2.0, 0.2]
[support]
left = ["z"]
[[prescribed]]
at = "left"
x = 0.1
[[load]]
at = "right"
force = [0.0, -1.0]
[contact]
method = "compliant"
law = { stiffness = 50.0, tangential_stiffness = 20.0 }
[[wall]]
name = "bed"
side = "below"
profile = { type = "parabola", apex = [1.0, -0.16], curvature = -0.05 }
motion = { x = 0.2, z = 0.3, rotation = 0.1, about = [1.0, 0.0] }
friction = 0.4
[member.strip]
from = "left"
to = "right"
material = "m"
section = "s"
elements = 2
theory = )";
  for (const std::string theory :
       {"\"euler-bernoulli\"", "\"elastica\"\norder = 6", "\"reissner\"\norder = 2", "\"essenburg\"\norder = 1\n"}) {
    SCOPED_TRACE(theory);
    const Model model(deck::read_deck_text(text + theory, "bed.toml"));
    const System& system = model.system();
    ASSERT_NE(system.history(), nullptr);
    State rest{.x = Vector::Zero(system.size(system.open_active_set())), .active_set = system.open_active_set()};
    rest.active_set[0] = 1;
    rest.lambda = 0.4;
    const State begun = system.history()->committed(rest, {.dx = Vector::Zero(rest.x.size()), .dlambda = 0.0}, 0.0);
    int slipping = 0, sticking = 0;
    unsigned seed = 1;
    const auto random = [&] {
      seed = seed * 1103515245u + 12345u;
      return double((seed >> 8) % 20001u) / 10000.0 - 1.0;
    };
    for (int i = 0; i < 12; ++i) {
      State state = begun;
      for (Index k = 0; k < state.x.size(); ++k) state.x[k] = 0.03 * random();
      for (const auto& point : model.compliant()->elastic_friction()->points(state))
        ++(point.sense != 0 ? slipping : sticking);
      Linearization now;
      system.linearize(state, now);
      Vector F(state.x.size());
      system.residual(state, F);
      EXPECT_LT((F - now.F).norm(), 1e-12 * (1.0 + F.norm()));
      const Matrix J = product(now, Matrix::Identity(state.x.size(), state.x.size()));
      const double h = 1e-6;
      const auto difference = [&](const std::function<void(State&, double)>& move) {
        Vector more(state.x.size()), less(state.x.size());
        State at = state;
        move(at, h);
        system.residual(at, more);
        at = state;
        move(at, -h);
        system.residual(at, less);
        return Vector((more - less) / (2.0 * h));
      };
      for (Index k = 0; k < state.x.size(); ++k)
        EXPECT_LT((difference([k](State& at, double s) { at.x[k] += s; }) - J.col(k)).norm(), 1e-5 * J.norm()) << k;
      EXPECT_LT((difference([](State& at, double s) { at.lambda += s; }) - now.F_lambda).norm(), 1e-5 * J.norm());
    }
    EXPECT_GT(slipping, 5);
    EXPECT_GT(sticking, 3);
  }
}

// A beam of one element on a compliant floor, drawn along and then bent up by end moments until its middle is off. Each
// of the two parts that are left has its share of what the material point between them bears.
TEST(CompliantFriction, PartsOfOneElementShareAPoint) {
  const Session run =
      run_of(R"(
[material.m]
E = 1.0
[section.s]
shape = "general"
A = 1e4
I = 1.0
[point]
a = [0.0, 0.0]
b = [1.0, 0.0]
[member.beam]
from = "a"
to = "b"
theory = "euler-bernoulli"
material = "m"
section = "s"
elements = 1
[[prescribed]]
at = "a"
x = 1.0
[[load]]
at = "a"
force = [0.0, -1.0]
constant = true
[[load]]
at = "b"
force = [0.0, -1.0]
constant = true
[[load]]
at = "a"
moment = 1.0
[[load]]
at = "b"
moment = -1.0
[contact]
method = "compliant"
law = { stiffness = 100.0, tangential_stiffness = 1000.0 }
[[wall]]
name = "floor"
side = "below"
contact_surface = "axis"
profile = { type = "flat", z = 0.0 }
friction = 0.3
[[monitor]]
name = "T"
wall = "floor"
component = "friction-force"
)" + stage("pull", "prescribed.0", 0.001, -1.0, 0.01) +
             "[[stage]]\nname = \"bend\"\ndrives = [\"load.2\", \"load.3\"]\nstep = 0.02\nmax_step = 0.01\n"
             "stop = { lambda = [-1.0, 2.0] }\n");
  int shared = 0;
  for (const RecordPoint& point : run.points()) {
    double sum = 0.0;
    std::vector<double> edges;
    for (const RecordForce& row : point.forces) {
      if (!row.friction) {
        edges.push_back(row.label.fraction);
        continue;
      }
      sum += row.friction->force;
      EXPECT_LE(std::abs(row.friction->force), 0.3 * row.force * (1.0 + 1e-9));
    }
    EXPECT_NEAR(sum, point.monitors[0], 1e-12);
    if (edges.size() == 4 && edges[1] > 0.375 && edges[2] < 0.625) ++shared;
  }
  EXPECT_GT(shared, 0);
}

namespace {

std::string with(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

// The strip of the friction of rigid walls (f04), which `stages` move down and along a compliant floor; `mirrored` is
// the mirror image.
std::string strip(double stiffness, double friction, const std::string& stages, bool mirrored = false) {
  std::string text = friction_test::strip(friction, stages, "[[prescribed]]\nat = \"clamp\"\nx = 1.0\n");
  if (mirrored) {
    text = with(text, "tip = [0.5,", "tip = [-0.5,");
    text = with(text, "\nx = 1.0\n", "\nx = -1.0\n");
    for (const std::string component : {"component = \"x\"\n", "component = \"force-x\"\n"})
      text = with(text, component, component + "sign = -1\n");
  }
  return text + fmt::format("[contact]\nmethod = \"compliant\"\nlaw = {{ stiffness = {} }}\n", stiffness);
}

const std::string down = stage("down", "prescribed.0", 0.02, -0.1, 0.4);
const std::string right = stage("right", "prescribed.1", 0.01, -1.0, 0.2);
const std::string left = stage("left", "prescribed.1", -0.01, -0.4, 1.0);

std::vector<double> ends_of_stages(const Session& run, std::size_t monitor) {
  std::vector<double> values;
  for (std::size_t i = 0; i < run.points().size(); ++i)
    if (i + 1 == run.points().size() || run.points()[i].branch != run.points()[i + 1].branch)
      values.push_back(run.points()[i].monitors[monitor]);
  return values;
}

// What two values that are off by a multiple of 1/√k tend to, k and 10 k.
double limit_of(double first, double second) { return second + (second - first) / (std::sqrt(10.0) - 1.0); }

}  // namespace

// An end is pressed into the wall by √(2 p/k): forces tend to those of a rigid wall, whose contact sticks and slips as
// such, with an error like that. Pressed down by 0.4 it has p = 2.043932631876 and T = −0.3 p; dragged on it slides,
// and back p = 1.597276181152.
TEST(CompliantFriction, TendsToRigidFriction) {
  std::vector<std::vector<double>> p;
  for (const double stiffness : {1e6, 1e7}) {
    const Session run = run_of(strip(stiffness, 0.3, down + right + left));
    p.push_back(ends_of_stages(run, 2));
    ASSERT_EQ(p.back().size(), 3u);
    const std::vector<double> T = ends_of_stages(run, 1);
    EXPECT_NEAR(T[0], -0.3 * p.back()[0], 1e-9);
    EXPECT_NEAR(T[2], 0.3 * p.back()[2], 1e-9);
    EXPECT_NEAR(p.back()[1], p.back()[0], 1e-8);
  }
  EXPECT_NEAR(limit_of(p[0][0], p[1][0]), 2.043932631876, 5e-4);
  EXPECT_NEAR(limit_of(p[0][2], p[1][2]), 1.597276181152, 5e-4);
  EXPECT_LT(std::abs(p[1][0] - 2.043932631876), 0.4 * std::abs(p[0][0] - 2.043932631876));
}

// The strip sticks, buckles and slips: λ turns where the last of its points begins to, and turns back on the slip.
TEST(CompliantFriction, TurnsTheLoadWhereSlipRunsAway) {
  const Session run = run_of(with(strip(1e5, 0.8, stage("down", "prescribed.0", 0.02, -0.1, 0.3)), "\nx = 1.0\n",
                                  "\nx = 0.0\nconstant = true\n"));
  EXPECT_EQ(friction_test::lambdas(run, EventKind::contact_limit_point, 0).size(), 1u);
  EXPECT_EQ(friction_test::lambdas(run, EventKind::limit_point, 0).size(), 1u);
  EXPECT_EQ(friction_test::reason(run), EndReason::stop);
  double before = 0.0;
  for (const RecordPoint& point : run.points()) {
    EXPECT_LE(std::abs(point.monitors[1]), 0.8 * point.monitors[2] * (1.0 + 1e-9) + 1e-12);
    EXPECT_GE(point.dissipation.front(), before);
    before = point.dissipation.front();
  }
}

TEST(CompliantFriction, IsTheSameInMirrorImages) {
  const Session run = run_of(strip(1e4, 0.3, down + right + left));
  const Session mirrored = run_of(strip(1e4, 0.3, down + right + left, true));
  for (std::size_t m = 0; m < 3; ++m) {
    const std::vector<double> here = ends_of_stages(run, m), there = ends_of_stages(mirrored, m);
    ASSERT_EQ(here.size(), 3u);
    ASSERT_EQ(there.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(there[i], here[i], 1e-8);
  }
}

// An end that slides dissipates what its drag does work; that is not so where slip turns.
TEST(CompliantFriction, BalancesWorkOfACycle) {
  const std::string again = stage("again", "prescribed.1", 0.01, -1.0, 0.4);
  const Session run = run_of(strip(1e5, 0.3, down + right + left + again));
  std::vector<double> at_ends;
  for (std::size_t i = 0; i < run.points().size(); ++i)
    if (i + 1 == run.points().size() || run.points()[i].branch != run.points()[i + 1].branch)
      at_ends.push_back(run.points()[i].dissipation.front());
  ASSERT_EQ(at_ends.size(), 4u);
  EXPECT_NEAR(at_ends[3] - at_ends[1], 0.4342639376193, 1e-3);  // of a rigid wall
}

namespace {

std::string refusal_of(const std::string& text) {
  try {
    session_of(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST(CompliantFriction, IsRefusedWithReasons) {
  const std::string good = strip(1e4, 0.3, stage("down", "prescribed.0", 0.02, -0.1, 0.4) + right);
  EXPECT_EQ(refusal_of(good), "");
  EXPECT_NE(refusal_of(good + "[[friction]]\npoint = \"tip\"\ncoefficient = 0.1\n").find("a point has none of its own"),
            std::string::npos);
  EXPECT_NE(refusal_of(with(good, "stiffness = 10000", "penetration = [0.0, 1.0, 2.0], pressure = [0.0, 0.0, 5.0]"))
                .find("no stiffness at penetration 0"),
            std::string::npos);
  EXPECT_NE(refusal_of(with(good, "stiffness = 10000", "stiffness = 10000, tangential_stiffness = 0.0"))
                .find("tangential_stiffness"),
            std::string::npos);
  EXPECT_NE(refusal_of(with(good, "friction = 0.3", "friction = -0.3")).find("must not be negative"),
            std::string::npos);
}

}  // namespace arcwall::compliant_friction_test
