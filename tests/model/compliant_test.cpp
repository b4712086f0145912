#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "answers/sessions.hpp"
#include "core/derivative_check.hpp"
#include "core/error.hpp"
#include "model/deck/reader.hpp"
#include "model/deck/writer.hpp"
#include "tests/model/traced_session.hpp"
#include "tests/support/deck_tables.hpp"
#include "tests/support/dense.hpp"

// Compliant walls: pressure by penetration, integrated along members.
namespace arcwall::compliant_test {

using namespace test::tables;

namespace {

using test::event_of;
using test::events_of;
using test::traced;

double last(const Session& run, std::size_t monitor) { return run.points().back().monitors[monitor]; }

const Record& record(const Session& run) { return run.record(); }

// --- derivatives ----------------------------------------------------------------------------------------------------

// A bent strip of two elements, free at its right end, among walls that λ moves and turns.
std::string among_walls(const std::string& theory, const std::string& surface, const std::string& law) {
  const std::string touches = fmt::format("contact_surface = \"{}\"; ", surface);
  const bool has_no_faces = surface == "face" && theory.find("essenburg") != std::string::npos;
  return title("Among walls") + units("m", "N") + material("m", 100.0, "nu = 0.3") + rectangle("s", 1.0, 0.3) +
         points({{"left", 0.0, 0.0}, {"right", 2.0, 0.2}}) +
         member("strip", "left", "right", theory, 2, imperfection({{2, 0.05}})) + supports({{"left", "x z rotation"}}) +
         force("right", 0.0, -1.0) +
         wall("bed", touches +
                         "side = \"below\"; "
                         "profile = { type = \"parabola\", apex = [1.0, -0.16], curvature = -0.05 }; "
                         "motion = { x = 0.2, z = 0.3, rotation = 0.1, about = [1.0, 0.0] }") +
         wall("peg", (has_no_faces ? on_axis + "; " : touches) +
                         "outline = { type = \"circle\", centre = [1.3, 1.9], radius = 1.5 }; motion = { z = -0.2 }") +
         contact("method = \"compliant\"; law = " + law);
}

const std::vector<std::string> theories{"euler-bernoulli",     "elastica; order = 6",  "reissner; order = 1",
                                        "reissner; order = 2", "essenburg; order = 1", "essenburg; order = 2"};

std::string pushed_strip(const std::string& radius) {
  return R"toml(
title = "Strip pushed by a compliant roller"
material.steel = { E = 2.1e5 }
section.s = { shape = "rectangle", width = 10.0, height = 1.0 }
contact = { method = "compliant", law = { stiffness = 50.0 } }
point = { a = [0.0, 0.0], b = [200.0, 0.0] }
support = { a = ["x", "z", "rotation"], b = ["z", "rotation"] }
path = { step = 0.1, stop = { lambda = [-1.0, 40.0] } }
monitor = [{ name = "mid", at = "c:0.5", component = "z" }, { name = "f", wall = "peg", component = "force-z" }]
member.c = { from = "a", to = "b", theory = "elastica", material = "steel", section = "s", elements = 20 }
[[wall]]
name = "peg"
motion = { z = 1.0 }
outline = { type = "circle", centre = [120.0, -10.0], radius = )toml" +
         radius + " }\n";
}

}  // namespace

// Differences of fourth order over 5e-5, at random states. The least gap of two elements or faces has a kink where both
// are equal: there differences are wrong. K leaves out how edges move Gauss's points, an error of the quadrature: 3e-7
// with a depth of 0.1 on these two elements.
TEST(CompliantWalls, HaveRightDerivatives) {
  const std::vector<std::string> laws{
      "{ stiffness = 50.0 }", "{ stiffness = 50.0, depth = 0.3 }",
      "{ penetration = [0.0, 0.05, 0.2, 0.5], pressure = [0.0, 2.0, 20.0, 90.0], interpolation = \"smooth\" }",
      "{ penetration = [0.0, 0.1, 0.2], pressure = [0.0, 2.0, 20.0] }"};
  test::Numbers numbers(17);
  int pressed = 0, states = 0, smooth = 0;
  for (const std::string& theory : theories)
    for (const std::string surface : {"axis", "face"})
      for (const std::string& law : laws) {
        SCOPED_TRACE(theory + ", " + surface + ", " + law);
        const Session session = make_session({.deck = "walls.toml", .deck_text = among_walls(theory, surface, law)});
        const System& system = session.model().system();
        for (int i = 0; i < 6; ++i) {
          State state{
              .x = 0.15 * numbers.vector(system.size({})), .lambda = numbers(), .active_set = system.open_active_set()};
          for (std::size_t j = 0; j < state.active_set.size(); ++j) state.active_set[j] = i % 4 == 3 ? 0 : 1;
          const CompliantContact& contact = *session.model().compliant();
          pressed += contact.force(state, 0) + contact.force(state, 1) > 0.0 ? 1 : 0;
          const DerivativeReport report = check_derivatives(system, state, 5e-5);
          EXPECT_LE(report.K, 1e-7);
          EXPECT_LE(report.F_lambda, 1e-7);
          EXPECT_LE(report.energy, 1e-7);
          EXPECT_LE(report.consistency, 1e-13);
          ++states;
          smooth += report.guard_gradient <= 1e-9 ? 1 : 0;
        }
      }
  EXPECT_GT(pressed, states / 7);
  EXPECT_GT(smooth, 9 * states / 10);
}

// --- small slopes ---------------------------------------------------------------------------------------------------

namespace {

// A beam on two rollers, 2L between them, δ above a bed of stiffness k, under P in its middle: the part |x| < a is
// pressed, where EI w⁗ = −k (w − δ), and free beyond it. For a given a all is linear (Hetényi, Beams on Elastic
// Foundation, 1946, on lift-off).
struct Bed {
  double load, reaction, deflection;  // P, of the bed, in the middle
};

Bed bed_with_edge_at(double a, double L, double EI, double k, double gap) {
  const double b = std::pow(k / (4.0 * EI), 0.25);
  // v = w − δ: products of cos, sin and exponentials, f_i and derivatives by x; beyond a Σ d_i (x − a)^i.
  const auto pressed = [&](double x, int derivative, int which) {
    // exp(s b x) times cos or sin of b x: derivatives of exp(z x), z = b (s + i)
    const double s = which < 2 ? 1.0 : -1.0;
    const std::complex<double> z(b * s, b);
    const std::complex<double> value = std::pow(z, derivative) * std::exp(z * x);
    return which % 2 == 0 ? value.real() : value.imag();
  };
  const auto free = [&](double x, int derivative, int which) {
    double factor = 1.0;
    for (int i = 0; i < derivative; ++i) factor *= which - i;
    return which < derivative ? 0.0 : factor * std::pow(x - a, which - derivative);
  };
  Matrix A = Matrix::Zero(9, 9);  // c0 … c3, d0 … d3, P
  Vector right = Vector::Zero(9);
  for (int i = 0; i < 4; ++i) {
    A(0, i) = pressed(0.0, 1, i);
    A(1, i) = EI * pressed(0.0, 3, i);
    A(2, i) = pressed(a, 0, i);
    A(3, 4 + i) = free(a, 0, i);
    for (int d = 1; d < 4; ++d) {
      A(3 + d, i) = pressed(a, d, i);
      A(3 + d, 4 + i) = -free(a, d, i);
    }
    A(7, 4 + i) = free(L, 0, i);
    A(8, 4 + i) = free(L, 2, i);
  }
  A(1, 8) = -0.5;  // EI w‴(0+) = P/2
  right[3] = gap;
  const Vector c = A.fullPivLu().solve(right);
  double v = 0.0, shear = 0.0;
  for (int i = 0; i < 4; ++i) {
    v += c[i] * pressed(0.0, 0, i);
    shear += c[i] * EI * (pressed(a, 3, i));
  }
  return {.load = c[8], .reaction = c[8] - 2.0 * shear, .deflection = gap + v};
}

// The same as a deck of `elements` elements: slopes of 1e-4.
std::string beam_over_bed(const std::string& theory, int elements, double load, const std::string& more = "") {
  return title("Beam over a bed") + units("m", "N") + material("m", 1.0e7) + general_section("s", 1.0, 1.0e-5, more) +
         points({{"left", -1.0, 0.0}, {"right", 1.0, 0.0}}) + member("beam", "left", "right", theory, elements) +
         supports({{"left", "x z"}, {"right", "z"}}) + force("beam:0.5", 0.0, -load) +
         flat_wall("bed", "below", -1e-4, on_axis) + contact("method = \"compliant\"; law = { stiffness = 1e5 }") +
         path("step = 0.1; stop = { lambda = [-0.5, 1.0] }") + monitor("middle", "beam:0.5", "z") +
         wall_monitor("bed", "bed", "force-z") + wall_monitor("edge", "bed", "contact-start", "member = \"beam\"");
}

}  // namespace

TEST(CompliantWalls, LiftABeamOffABedWhereHetenyiDoes) {
  constexpr double L = 1.0, EI = 100.0, k = 1e5, gap = 1e-4, a = 0.31;
  const Bed exact = bed_with_edge_at(a, L, EI, k, gap);
  const Session run = traced(beam_over_bed("euler-bernoulli", 80, exact.load));
  ASSERT_EQ(run.points().back().lambda, 1.0);
  EXPECT_NEAR(last(run, 0), -exact.deflection, 1e-6 * exact.deflection);
  EXPECT_NEAR(last(run, 1), exact.reaction, 1e-6 * exact.reaction);
  EXPECT_NEAR(last(run, 2), L - a, 1e-5);
  // First contact: P L³/(6 EI) = δ of the beam of length 2 L.
  const RecordEvent& touch = event_of(record(run), EventKind::contact_closes);
  EXPECT_NEAR(touch.lambda * exact.load, 6.0 * EI * gap / (L * L * L), 1e-6 * 6.0 * EI * gap);
  ASSERT_EQ(touch.contacts.size(), 1U);
  EXPECT_EQ(touch.contacts.front().label.wall, "bed");
  EXPECT_NEAR(touch.contacts.front().label.fraction, 0.5, 1e-9);
}

// --- the elastica, shot ---------------------------------------------------------------------------------------------

namespace {

// Half of a pinned column of length 2 with a stress-free shape (S, d(S)), symmetric about its middle, under an end load
// P below a bed −k max(0, z − h) per stress-free length. F is the force on the left part, M its moment:
//
//     φ′ = φ₀′ + s₀′ M/EI,   r′ = s₀′ (1 + F·t/EA) t,   F_z′ = s₀′ k max(0, z − h),   M′ = −r′ × F
//
// with z(0) = M(0) = 0 and F_x = −P; at the middle φ = 0 and F_z = 0. Unknowns: φ and F_z at the end, and P.
class ShotColumn {
 public:
  static constexpr double EA = 210.0, EI = 0.175, height = 0.15, length = 2.0;
  using Unknowns = Eigen::Vector3d;
  using Values = std::array<double, 5>;  // x, z, φ, M, F_z

  explicit ShotColumn(double stiffness) : k_(stiffness) {}

  // At the middle, by Runge and Kutta's rule.
  Values run(const Unknowns& of) const {
    constexpr int steps = 1000;
    constexpr double h = 0.5 * length / steps;
    Values y{0.0, 0.0, of[0], 0.0, of[1]};
    for (int i = 0; i < steps; ++i) {
      const double S = i * h;
      const Values k1 = rate(S, y, of[2]), k2 = rate(S + 0.5 * h, plus(y, k1, 0.5 * h), of[2]),
                   k3 = rate(S + 0.5 * h, plus(y, k2, 0.5 * h), of[2]), k4 = rate(S + h, plus(y, k3, h), of[2]);
      for (std::size_t j = 0; j < y.size(); ++j) y[j] += h / 6.0 * (k1[j] + 2.0 * k2[j] + 2.0 * k3[j] + k4[j]);
    }
    return y;
  }

  double bed(const Unknowns& of) const { return 2.0 * (run(of)[4] - of[1]); }

  // The tangent of the solutions, in which they go on from `forward`.
  Unknowns tangent(const Unknowns& at, const Unknowns& forward) const {
    const Eigen::Matrix<double, 2, 3> J = jacobian(at);
    const Unknowns t = Unknowns(J.row(0)).cross(Unknowns(J.row(1))).normalized();
    return t.dot(forward) < 0.0 ? Unknowns(-t) : t;
  }

  // The solution on the plane across `forward` through a guess.
  Unknowns corrected(Unknowns at, const Unknowns& forward) const {
    const Unknowns guess = at;
    for (int i = 0; i < 20; ++i) {
      const Eigen::Vector2d off = residual(at);
      if (off.norm() < 1e-13) break;
      Eigen::Matrix3d A;
      A << jacobian(at), forward.transpose();
      at += A.fullPivLu().solve(Unknowns(-off[0], -off[1], forward.dot(guess - at)));
    }
    return at;
  }

 private:
  static Values plus(const Values& y, const Values& rate, double h) {
    Values sum = y;
    for (std::size_t i = 0; i < y.size(); ++i) sum[i] += h * rate[i];
    return sum;
  }

  Values rate(double S, const Values& y, double P) const {
    constexpr double a1 = 2e-3, a3 = 3e-4, w = std::numbers::pi / length;
    const double slope = a1 * w * std::cos(w * S) + 3.0 * a3 * w * std::cos(3.0 * w * S);
    const double bend = -a1 * w * w * std::sin(w * S) - 9.0 * a3 * w * w * std::sin(3.0 * w * S);
    const double speed = std::sqrt(1.0 + slope * slope);
    const double c = std::cos(y[2]), s = std::sin(y[2]);
    const double stretched = speed * (1.0 + (-P * c + y[4] * s) / EA);
    return {stretched * c, stretched * s, bend / (speed * speed) + speed * y[3] / EI,
            -(stretched * c * y[4] + stretched * s * P), speed * k_ * std::max(0.0, y[1] - height)};
  }

  Eigen::Vector2d residual(const Unknowns& of) const {
    const Values end = run(of);
    return {end[2], end[4]};
  }

  Eigen::Matrix<double, 2, 3> jacobian(const Unknowns& at) const {
    constexpr double step = 1e-6;
    Eigen::Matrix<double, 2, 3> J;
    for (int i = 0; i < 3; ++i)
      J.col(i) = (residual(at + step * Unknowns::Unit(i)) - residual(at - step * Unknowns::Unit(i))) / (2.0 * step);
    return J;
  }

  double k_;
};

// The end load at which the middle reaches the bed, and its first maximum.
struct ShotEvents {
  double touch = 0.0, snap = 0.0, bed = 0.0;
};

ShotEvents events_of_shot(const ShotColumn& pressed) {
  using Unknowns = ShotColumn::Unknowns;
  const ShotColumn free(0.0);
  Unknowns at = free.corrected({0.02, 0.0, 0.35}, Unknowns::UnitX());
  Unknowns t = free.tangent(at, Unknowns::UnitX());
  ShotEvents events;
  // Steps, shorter where the path turns, and halved onto the place where a value changes its sign.
  const auto go_on_to_zero = [&](const ShotColumn& column, auto&& value) {
    constexpr double longest = 0.02, straight = 0.998;  // cosine
    double step = longest;
    bool is_near = false;
    for (int i = 0; i < 4000 && step > 1e-10; ++i) {
      const Unknowns ahead = column.corrected(at + step * t, t), there = column.tangent(ahead, t);
      const bool follows = (ahead - at).norm() < 1.2 * step && there.dot(t) > straight;
      const bool passed = follows && value(ahead, there) < 0.0;
      is_near = is_near || passed;
      if (!follows || passed) {
        step *= 0.5;
        continue;
      }
      at = ahead;
      t = there;
      if (!is_near) step = std::min(longest, 1.1 * step);
    }
  };
  go_on_to_zero(free, [&](const Unknowns& y, const Unknowns&) { return ShotColumn::height - free.run(y)[1]; });
  events.touch = at[2];
  at = pressed.corrected(at + 1e-4 * t, t);
  t = pressed.tangent(at, t);
  go_on_to_zero(pressed, [](const Unknowns&, const Unknowns& tangent) { return tangent[2]; });
  events.snap = at[2];
  events.bed = pressed.bed(at);
  return events;
}

std::string column_in_channel(const std::string& theory, int elements, double stiffness) {
  return title("Column in a compliant channel") + units("cm", "kN") + material("steel", 2.1e4, "nu = 0.3") +
         rectangle("square", 0.1, 0.1) + points({{"left", 0.0, 0.0}, {"right", 2.0, 0.0}}) +
         member("column", "left", "right", theory, elements, imperfection({{1, 2.0e-3}, {3, 3.0e-4}}), "steel",
                "square") +
         supports({{"left", "x z"}, {"right", "z"}}) + force("right", -1.0, 0.0) +
         flat_wall("upper", "above", 0.15, on_axis) +
         contact(fmt::format(R"(method = "compliant"; law = {{ stiffness = {} }})", stiffness)) +
         path(R"(step = 0.05; stop = { lambda = [-1.0, 9.0], event = "limit-point" })") +
         monitor("mid", "column:0.5", "z") + wall_monitor("bed", "upper", "force-z");
}

}  // namespace

// A touch, a spread, and a snap. On a softer bed the column buckles sideways before that.
TEST(CompliantWalls, PressAnElasticaAsShootingSaysSlow) {
  for (const double stiffness : {500.0, 2000.0}) {
    SCOPED_TRACE(stiffness);
    const ShotEvents shot = events_of_shot(ShotColumn(stiffness));
    const Session run = traced(column_in_channel("elastica; order = 6", 64, stiffness));
    EXPECT_NEAR(event_of(record(run), EventKind::contact_closes).lambda, shot.touch, 1e-8 * shot.touch);
    const RecordEvent& snap = event_of(record(run), EventKind::limit_point);
    EXPECT_NEAR(snap.lambda, shot.snap, 1e-5 * shot.snap);
    EXPECT_NEAR(-snap.monitors[1], shot.bed, 1e-4 * shot.bed);
  }
}

// --- convergence ----------------------------------------------------------------------------------------------------

namespace {

// The force of the bed at λ = 1.
double force_of_bed(const std::string& theory, const std::string& surface, int elements) {
  std::string deck = beam_over_bed(theory, elements, 0.4, "height = 1e-5; shear_area = 1.0");
  for (const auto& [from, to] : {std::pair<std::string, std::string>{"E = 10000000.0", "E = 1e7\nnu = 0.3"},
                                 {"contact_surface = \"axis\"", "contact_surface = \"" + surface + "\""}})
    deck.replace(deck.find(from), from.size(), to);
  return last(traced(deck), 1);
}

}  // namespace

// The edges of contact are inside elements. Differences from a mesh of 96: those of slender beams are at once beside
// what the ends of contact in this or that element make.
TEST(CompliantWalls, HaveForcesOfOrderTwoInTheMeshSlow) {
  for (const std::string theory :
       {"euler-bernoulli", "elastica; order = 4", "elastica; order = 6", "reissner; order = 1", "reissner; order = 2"})
    for (const std::string surface : {"axis", "face"}) {
      const double finest = force_of_bed(theory, surface, 96);
      const double coarse = std::abs(force_of_bed(theory, surface, 12) - finest);
      const double finer = std::abs(force_of_bed(theory, surface, 24) - finest);
      EXPECT_LE(finer, std::max(coarse / 3.7, 1e-6 * finest)) << theory << surface;
    }
}

// --- the rigid limit ------------------------------------------------------------------------------------------------

// The load of a snap on walls that are ten times as stiff, twice: how far it is from that of rigid walls falls as the
// root of the compliance, as the length does in which contact turns the column. Forces on a rigid floor at the ends of
// a zone have a lever of that length alone: k^(−3/4).
TEST(CompliantWalls, TendToRigidOnesSlow) {
  const auto run_of = [](const std::string& file, std::vector<std::string> assignments) {
    assignments.insert(assignments.end(), {"path.jumps=false", "path.stop.event=\"limit-point\""});
    Session run = open_session(std::string(EXAMPLES) + "/" + file, assignments);
    while (run.next() != nullptr) {
    }
    return run;
  };
  const auto off = [&](const std::string& file, const std::string& mesh, std::size_t monitor) {
    const auto value = [&](const std::vector<std::string>& law) {
      std::vector<std::string> assignments = law;
      assignments.push_back(mesh);
      const Session run = run_of(file, assignments);
      const auto snaps = events_of(run.record(), EventKind::limit_point);
      return snaps.empty() ? last(run, monitor) : snaps.front().lambda;
    };
    const double rigid = value({});
    std::vector<double> errors;
    for (const char* stiffness : {"1e5", "1e6", "1e7"})
      errors.push_back(std::abs(
          value({"contact.method=\"compliant\"", fmt::format("contact.law={{stiffness={}}}", stiffness)}) - rigid));
    return errors;
  };
  const std::vector<double> snap = off("channel.toml", "member.column.elements=160", 0);
  EXPECT_NEAR(std::log10(snap[1] / snap[2]), 0.5, 0.06);
  const std::vector<double> reaction = off("foundation.toml", "member.beam.elements=160", 1);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(std::log10(reaction[i] / reaction[i + 1]), 0.75, 0.03);
}

// --- invariances ----------------------------------------------------------------------------------------------------

// In other units, and upside down.
TEST(CompliantWalls, DoNotDependOnUnitsNorOnTheSide) {
  const std::string deck = column_in_channel("elastica", 16, 50.0);
  const Session run = traced(deck);
  std::string other = deck;
  const auto replace = [&](const std::string& from, const std::string& to) {
    ASSERT_NE(other.find(from), std::string::npos) << from;
    other.replace(other.find(from), from.size(), to);
  };
  // cm and kN → m and N: lengths by 1e-2, forces by 1e3, E by 1e7, the law by 1e7; loads by λ in kN stay.
  replace("length = \"cm\"", "length = \"m\"");
  replace("force = \"kN\"", "force = \"N\"");
  replace("E = 21000.0", "E = 2.1e11");
  replace("width = 0.1", "width = 0.001");
  replace("height = 0.1", "height = 0.001");
  replace("right = [2.0, 0.0]", "right = [0.02, 0.0]");
  replace("amplitude = 0.002", "amplitude = -2.0e-5");
  replace("amplitude = 0.0003", "amplitude = -3.0e-6");
  replace("force = [-1.0, 0.0]", "force = [-1000.0, 0.0]");
  replace("side = \"above\"", "side = \"below\"");
  replace("z = 0.15", "z = -0.0015");
  replace("stiffness = 50", "stiffness = 5e8");
  const Session mirrored = traced(other);
  ASSERT_EQ(run.events().size(), mirrored.events().size());
  for (std::size_t i = 0; i < run.events().size(); ++i) {
    EXPECT_EQ(run.events()[i].kind, mirrored.events()[i].kind);
    EXPECT_NEAR(run.events()[i].lambda, mirrored.events()[i].lambda, 1e-9);
    EXPECT_NEAR(run.events()[i].monitors[0], -100.0 * mirrored.events()[i].monitors[0], 1e-7);
    EXPECT_NEAR(run.events()[i].monitors[1], -1e-3 * mirrored.events()[i].monitors[1], 1e-7);
  }
}

// --- a wall that moves, and what is told ----------------------------------------------------------------------------

// A floor comes up under a beam and goes back down in a second stage.
TEST(CompliantWalls, AreTouchedAndLeftAsTheyMove) {
  std::string deck = beam_over_bed("euler-bernoulli", 20, 0.0);
  deck.replace(deck.find("[contact]"), 0, "motion = { z = 3e-4 }\n");
  deck.replace(deck.find("[[load]]"), deck.find("[[wall]]") - deck.find("[[load]]"), "");
  deck.replace(
      deck.find("[path]"), deck.find("[[monitor]]") - deck.find("[path]"),
      "[path]\n[[stage]]\nname = \"up\"\ndrives = [\"wall.bed\"]\nstep = 0.1\nstop = { lambda = [-0.1, 1.0] }\n"
      "[[stage]]\nname = \"down\"\ndrives = [\"wall.bed\"]\nstep = -0.1\nstop = { lambda = [-1.0, 0.1] }\n");
  const Session run = traced(deck);
  const auto closes = events_of(record(run), EventKind::contact_closes),
             opens = events_of(record(run), EventKind::contact_opens);
  ASSERT_EQ(closes.size(), 1U);
  ASSERT_EQ(opens.size(), 1U);
  EXPECT_NEAR(closes[0].lambda, 1.0 / 3.0, 1e-9);
  EXPECT_NEAR(opens[0].lambda, -2.0 / 3.0, 1e-9);
  double most = 0.0;
  for (const RecordPoint& point : run.points()) {
    double sum = 0.0;
    for (const RecordForce& contact : point.forces) sum += contact.force;
    EXPECT_NEAR(sum, point.monitors[1], 1e-9 * std::max(1.0, sum));
    EXPECT_TRUE(point.forces.empty() || point.contacts == 1);
    most = std::max(most, sum);
  }
  EXPECT_GT(most, 0.1);
  EXPECT_EQ(last(run, 1), 0.0);
}

// --- messages -------------------------------------------------------------------------------------------------------

TEST(CompliantWalls, RefuseWhatTheyAreNot) {
  const auto message = [](const std::string& text) -> std::string {
    try {
      const Session session = make_session({.deck = "deck.toml", .deck_text = text});
      return "";
    } catch (const InputError& error) {
      return error.what();
    }
  };
  const std::string good = beam_over_bed("euler-bernoulli", 4, 1.0);
  EXPECT_EQ(message(good), "");
  const auto expect_said = [&](const std::string& from, const std::string& to, const std::string& words) {
    std::string text = good;
    ASSERT_NE(text.find(from), std::string::npos) << from;
    text.replace(text.find(from), from.size(), to);
    EXPECT_NE(message(text).find(words), std::string::npos) << to << "\n" << message(text);
  };
  const std::string law = "law = { stiffness = 1e5 }";
  expect_said(law, "", "contact.law: is missing: wall \"bed\" has no law of its own");
  expect_said(law, "law = 3.0", "contact.law");
  expect_said(law, "law = {}", "the law has no stiffness");
  expect_said(law, "law = { stiffness = 0.0 }", "contact.law.stiffness");
  expect_said(law, "law = { stiffness = 1.0, depth = -1.0 }", "contact.law.depth");
  expect_said(law, "law = { stiffness = 1.0, penetration = [0.0, 1.0], pressure = [0.0, 1.0] }",
              "both a stiffness and a table");
  expect_said(law, "law = { stiffness = 1.0, interpolation = \"smooth\" }", "belongs to a table");
  expect_said(law, "law = { penetration = [0.0, 1.0], pressure = [0.0, 1.0], depth = 1.0 }",
              "belongs to a law with a stiffness");
  expect_said(law, "law = { penetration = [0.0, 1.0], pressure = [0.0] }", "2 penetrations and 1 pressures");
  expect_said(law, "law = { penetration = [0.1, 1.0], pressure = [0.0, 1.0] }", "does not begin without pressure");
  expect_said(law, "law = { penetration = [0.0, 1.0, 1.0], pressure = [0.0, 1.0, 2.0] }", "1 follows 1");
  expect_said(law, "law = { penetration = [0.0, 1.0], pressure = [0.0, -1.0] }", "walls push only");
  expect_said(law, "law = { penetration = [0.0, 1.0], pressure = [0.0, 0.0] }", "the wall has no pressure");
  expect_said(law, "law = { penetration = [0.0, 1.0], pressure = [0.0, 1.0], interpolation = \"cubic\" }",
              "interpolation");
  expect_said("method = \"compliant\"", "method = \"multiplier\"", "belongs to method \"compliant\"");
  expect_said(law, law + "\npoints = \"moving\"", "does not go with method \"compliant\"");
  expect_said(law, law + "\npenalty = 1.0", "does not go with method \"compliant\"");
  expect_said("[contact]", "interference = 0.3\n[contact]", "compliant walls have no interference");
  expect_said("z = -0.0001", "z = 0.0001", "is inside the wall at the start");
  expect_said("step = 0.1", "method = \"incremental\"\noutput_at = { lambda = [1.0] }",
              "does not support compliant walls");
  std::string truss = good;
  for (const auto& [from, to] : {std::pair<std::string, std::string>{"euler-bernoulli", "truss"},
                                 {"elements = 4", "elements = 1"},
                                 {"at = \"beam:0.5\"\nforce", "at = \"right\"\nforce"},
                                 {"at = \"beam:0.5\"", "at = \"right\""},
                                 {"[0.0, -1.0]", "[1.0, 0.0]"}})
    truss.replace(truss.find(from), from.size(), to);
  EXPECT_NE(message(truss).find("which cannot carry the pressure of a compliant wall"), std::string::npos)
      << message(truss);
  expect_said(
      "[contact]",
      "[[wall]]\nname = \"lid\"\nside = \"above\"\ncontact_surface = \"axis\"\nprofile = { type = \"flat\", z = 0.0 }\n"
      "[[wall]]\nname = \"base\"\nside = \"below\"\ncontact_surface = \"axis\"\nprofile = { type = \"flat\", z = 0.0 "
      "}\n[contact]",
      "touches walls \"lid\" and \"base\" from both sides at the start");
  expect_said("wall = \"bed\"\ncomponent", "wall = \"bed\"\nat = \"left\"\ncomponent", "it has no force at \"left\"");
}

// A run may write its deck, with other values, and read it again.
TEST(CompliantWalls, AreReadAsTheyAreWritten) {
  for (const std::string law :
       {"{ stiffness = 1e5 }", "{ stiffness = 1e5, depth = 0.5 }",
        "{ penetration = [0.0, 1.0, 2.0], pressure = [0.0, 1.0, 3.0], interpolation = \"smooth\" }"}) {
    std::string text = beam_over_bed("euler-bernoulli", 4, 1.0);
    text.replace(text.find("{ stiffness = 1e5 }"), 19, law);
    text.insert(text.find("[contact]"), "law = " + law + "\n");
    const deck::Deck deck = deck::read_deck_text(text, "deck.toml");
    const deck::Deck again = deck::read_deck_text(deck::to_toml(deck), "deck.toml");
    EXPECT_EQ(deck.contact, again.contact);
    EXPECT_EQ(deck.walls.front().law, again.walls.front().law);
  }
}

// The rates of a touch by the place of the wall, on which the stiffness has no influence, and of a snap by the
// stiffness, against runs beside.
TEST(CompliantWalls, KnowHowLoadsDependOnThem) {
  const std::string deck = column_in_channel("elastica", 24, 500.0);
  const auto load = [&](EventKind kind, const std::string& assignment) {
    return event_of(record(traced(deck, {assignment})), kind).lambda;
  };
  const Session run = traced(deck, {"path.sensitivity=[\"contact.law.stiffness\",\"wall.upper.profile.z\"]"});
  const auto rate = [&](EventKind kind, std::size_t key) {
    const RecordSensitivity& of = event_of(record(run), kind).sensitivity.at(key);
    EXPECT_TRUE(of.slope) << of.why_none;
    return of.slope.value_or(0.0);
  };
  const double snap = (load(EventKind::limit_point, "contact.law.stiffness=501") -
                       load(EventKind::limit_point, "contact.law.stiffness=499")) /
                      2.0;
  const double touch = (load(EventKind::contact_closes, "wall.upper.profile.z=0.1501") -
                        load(EventKind::contact_closes, "wall.upper.profile.z=0.1499")) /
                       2e-4;
  EXPECT_NEAR(rate(EventKind::limit_point, 0), snap, 1e-4 * std::abs(snap));
  EXPECT_NEAR(rate(EventKind::contact_closes, 0), 0.0, 1e-9);
  EXPECT_NEAR(rate(EventKind::contact_closes, 1), touch, 1e-4 * std::abs(touch));
}

// A wall of its own law, and laws of walls that are rigid.
TEST(CompliantWalls, MayHaveLawsOfTheirOwn) {
  const std::string deck = beam_over_bed("euler-bernoulli", 20, 0.4);
  std::string own = deck;
  own.replace(own.find("law = { stiffness = 1e5 }"), 25, "");
  own.replace(own.find("[contact]"), 0, "law = { stiffness = 1e5 }\n");
  EXPECT_EQ(last(traced(deck), 1), last(traced(own), 1));
  EXPECT_EQ(last(traced(deck, {"contact.law.stiffness=2e5"}), 1), last(traced(own, {"wall.bed.law.stiffness=2e5"}), 1));
  EXPECT_GT(last(traced(deck, {"contact.law.stiffness=2e5"}), 1), last(traced(deck), 1));
}

// A roller that moves through a strip within one step would leave it without force. It pushes the strip by as much in
// short steps and long ones: at 40, 32.14 in the middle with 223.5, where a rigid roller pushes with 246.9. One of
// radius 1 cannot bear that, and a path on which its centre would pass the strip ends.
TEST(CompliantWalls, DoNotMoveThroughAMemberInOneStep) {
  for (const std::string step : {"0.1", "1.0", "5.0"}) {
    SCOPED_TRACE(step);
    const Session run = traced(pushed_strip("3.0"), {"path.step=" + step});
    EXPECT_EQ(run.points().back().lambda, 40.0);
    EXPECT_NEAR(last(run, 0), 32.14, 0.01);
    EXPECT_NEAR(last(run, 1), 223.5, 0.1);
    EXPECT_LT(traced(pushed_strip("1.0"), {"path.step=" + step}).points().back().lambda, 40.0);
  }
}

}  // namespace arcwall::compliant_test
