// Members whose sections taper, against own shooting of the elastica.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <tuple>
#include <vector>

#include "answers/event_curve.hpp"
#include "model/deck/reader.hpp"
#include "tests/apps/traced_deck.hpp"
#include "tests/apps/verify/expect_whole.hpp"

namespace arcwall::tapered_members_test {
namespace {

using test::TracedDeck;

// A clamped member along which a dead force F at its tip acts: x′ = (1 + N/EA) t + (Q/GA) n, θ′ = M/EI, M′ = −r′ × F.
struct Shot {
  std::function<double(double)> A, I, half_height;  // at an arc length
  double E = 0.0, G = 0.0, length = 0.0, angle = 0.0;
  Vec2 F = Vec2::Zero();

  struct Place {
    double s = 0.0;
    std::array<double, 4> y{};  // x, z, θ, M
  };

  std::array<double, 4> rate(double s, const std::array<double, 4>& y) const {
    const Vec2 t(std::cos(y[2]), std::sin(y[2])), n = perp(t);
    const double shear = G > 0.0 ? F.dot(n) / (G * 5.0 / 6.0 * A(s)) : 0.0;
    const Vec2 r = (1.0 + F.dot(t) / (E * A(s))) * t + shear * n;
    return {r.x(), r.y(), y[3] / (E * I(s)), -(r.x() * F.y() - r.y() * F.x())};
  }

  // Runge and Kutta's method, whose steps end at the places of tables.
  std::vector<Place> from(double moment) const {
    constexpr int steps = 2000;
    const double h = length / steps;
    std::vector<Place> places{{.s = 0.0, .y = {0.0, 0.0, angle, moment}}};
    for (int i = 0; i < steps; ++i) {
      const double s = i * h, inside = 1e-12 * length;
      const auto& y = places.back().y;
      const auto moved = [&](double by, const std::array<double, 4>& k) {
        std::array<double, 4> to = y;
        for (std::size_t j = 0; j < 4; ++j) to[j] += by * k[j];
        return to;
      };
      const auto a = rate(s + inside, y), b = rate(s + 0.5 * h, moved(0.5 * h, a)),
                 c = rate(s + 0.5 * h, moved(0.5 * h, b)), d = rate(s + h - inside, moved(h, c));
      std::array<double, 4> next = y;
      for (std::size_t j = 0; j < 4; ++j) next[j] += h / 6.0 * (a[j] + 2.0 * b[j] + 2.0 * c[j] + d[j]);
      places.push_back({.s = s + h, .y = next});
    }
    return places;
  }

  // With no moment at the tip, by the secant method.
  std::vector<Place> solve() const {
    double a = 0.0, b = -0.5 * length * F.norm(), of_a = from(a).back().y[3];
    std::vector<Place> places = from(b);
    for (int i = 0; i < 50 && std::abs(b - a) > 1e-13 * std::abs(b); ++i) {
      const double of_b = places.back().y[3], next = b - of_b * (b - a) / (of_b - of_a);
      a = b;
      of_a = of_b;
      b = next;
      places = from(b);
    }
    return places;
  }

  double greatest_stress(const std::vector<Place>& places) const {
    double most = 0.0;
    for (const Place& place : places) {
      const Vec2 t(std::cos(place.y[2]), std::sin(place.y[2]));
      most = std::max(most, std::abs(F.dot(t)) / A(place.s) + std::abs(place.y[3]) * half_height(place.s) / I(place.s));
    }
    return most;
  }
};

double last(const TracedDeck& run, const std::string& monitor) {
  const Record& record = run.record();
  for (std::size_t i = 0; i < record.columns.size(); ++i)
    if (record.columns[i].name == monitor) return record.points.back().monitors[i];
  ADD_FAILURE() << monitor;
  return 0.0;
}

// Two limbs of a bow, which taper in width and height from the grip.
std::string bow(const std::string& theory, int elements) {
  return fmt::format(R"toml(
title = "A bow's tapered limbs"
material.glass = {{ E = 4.0e4, nu = 0.3, allowable = 400.0 }}
section.limb = {{ shape = "rectangle", width = 40.0, width_to = 20.0, height = 12.0, height_to = 7.0 }}
point = {{ grip = [0.0, 0.0], top = [0.0, 700.0], bottom = [0.0, -700.0] }}
support = {{ grip = ["x", "z", "rotation"] }}
load = [{{ at = "top", force = [200.0, -100.0] }}, {{ at = "bottom", force = [200.0, 100.0] }}]
path = {{ step = 0.2, stop = {{ lambda = [-0.1, 1.0] }} }}
monitor = [{{ name = "x", at = "top", component = "x" }}, {{ name = "z", at = "top", component = "z" }}, {{ name = "turn", at = "top", component = "rotation" }}, {{ name = "stress", member = "upper", component = "max-stress" }}, {{ name = "use", component = "utilisation" }}]
member.upper = {{ from = "grip", to = "top", {0}, elements = {1}, material = "glass", section = "limb" }}
member.lower = {{ from = "grip", to = "bottom", {0}, elements = {1}, material = "glass", section = "limb" }}
)toml",
                     theory, elements);
}

Shot limb(double G) {
  const auto b = [](double s) { return 40.0 - 20.0 * s / 700.0; };
  const auto h = [](double s) { return 12.0 - 5.0 * s / 700.0; };
  return {.A = [=](double s) { return b(s) * h(s); },
          .I = [=](double s) { return b(s) * h(s) * h(s) * h(s) / 12.0; },
          .half_height = [=](double s) { return 0.5 * h(s); },
          .E = 4.0e4,
          .G = G,
          .length = 700.0,
          .angle = 0.5 * pi,
          .F = {200.0, -100.0}};
}

}  // namespace

TEST(TaperedMembers, BendABowsLimbsAsShootingHasIt) {
  for (const auto& [theory, G] : {std::pair("theory = \"elastica\"", 0.0),
                                  {"theory = \"euler-bernoulli\"", 0.0},
                                  {"theory = \"reissner\"", 4.0e4 / 2.6}}) {
    SCOPED_TRACE(theory);
    const Shot shot = limb(G);
    const std::vector<Shot::Place> places = shot.solve();
    const auto& tip = places.back().y;
    const TracedDeck run(bow(theory, 20));
    EXPECT_NEAR(last(run, "x"), tip[0], 1e-6 * tip[0]);
    EXPECT_NEAR(last(run, "z"), tip[1] - 700.0, 1e-6 * tip[0]);
    EXPECT_NEAR(last(run, "turn"), tip[2] - 0.5 * pi, 1e-6);
    const double stress = shot.greatest_stress(places);
    EXPECT_NEAR(last(run, "stress"), stress, 1e-6 * stress);
    EXPECT_NEAR(last(run, "use"), stress / 400.0, 1e-6 * stress / 400.0);
    test::expect_whole(run);
  }
}

TEST(TaperedMembers, ConvergeWithTheOrderOfTheElement) {
  const double x = limb(0.0).solve().back().y[0];
  const auto error = [&](const std::string& theory, int elements) {
    return std::abs(last(TracedDeck(bow(theory, elements)), "x") - x);
  };
  EXPECT_NEAR(std::log2(error("theory = \"euler-bernoulli\"", 8) / error("theory = \"euler-bernoulli\"", 16)), 4.0,
              0.2);
  EXPECT_NEAR(std::log2(error("theory = \"elastica\"", 5) / error("theory = \"elastica\"", 10)), 6.0, 0.4);
}

// A table is linear between its places, which are nodes.
TEST(TaperedMembers, OfATableBendAsShootingHasIt) {
  const std::array<double, 4> at{0.0, 0.25, 0.5, 1.0};
  const auto linear = [at](std::array<double, 4> values) {
    return [at, values](double s) {
      const double t = s / 200.0;
      const std::size_t k = t <= at[1] ? 1 : t <= at[2] ? 2 : 3;
      return values[k - 1] + (t - at[k - 1]) / (at[k] - at[k - 1]) * (values[k] - values[k - 1]);
    };
  };
  const auto height = linear({2.0, 1.8, 1.4, 1.0});
  const Shot shot{.A = linear({40.0, 30.0, 20.0, 8.0}),
                  .I = linear({14.0, 7.0, 3.0, 0.7}),
                  .half_height = [=](double s) { return 0.5 * height(s); },
                  .E = 2.0e5,
                  .length = 200.0,
                  .F = {0.0, -20.0}};
  const std::vector<Shot::Place> places = shot.solve();
  const TracedDeck run(R"toml(
title = "A strip by a table"
material.m = { E = 2.0e5 }
section.s = { shape = "table", at = [0.0, 0.25, 0.5, 1.0], A = [40.0, 30.0, 20.0, 8.0], I = [14.0, 7.0, 3.0, 0.7], height = [2.0, 1.8, 1.4, 1.0] }
point = { a = [0.0, 0.0], b = [200.0, 0.0] }
support = { a = ["x", "z", "rotation"] }
load = [{ at = "b", force = [0.0, -20.0] }]
path = { step = 0.1, stop = { lambda = [-0.1, 1.0] } }
monitor = [{ name = "z", at = "b", component = "z" }, { name = "stress", member = "s", component = "max-stress" }]
member.s = { from = "a", to = "b", theory = "elastica", elements = 16, material = "m", section = "s" }
)toml");
  EXPECT_NEAR(last(run, "z"), places.back().y[1], 1e-7 * std::abs(places.back().y[1]));
  const double stress = shot.greatest_stress(places);
  EXPECT_NEAR(last(run, "stress"), stress, 1e-7 * stress);
  test::expect_whole(run);
}

// A strip that a force presses on a drum below it, which its axis touches where the path says so.
namespace {

std::string drum(int elements, const std::string& wall, const std::string& more = "") {
  return fmt::format(R"toml(
title = "A tapered strip pressed on a drum"
material.steel = {{ E = 2.0e5 }}
section.strip = {{ shape = "rectangle", width = 20.0, width_to = 8.0, height = 2.0, height_to = 1.0 }}
point = {{ clamp = [0.0, 0.0], tip = [200.0, 0.0] }}
support = {{ clamp = ["x", "z", "rotation"] }}
load = [{{ at = "tip", force = [0.0, -200.0] }}]
path = {{ step = 0.1, stop = {{ lambda = [-0.1, 0.8] }} }}
monitor = [{{ name = "z", at = "tip", component = "z" }}]
member.strip = {{ from = "clamp", to = "tip", theory = "elastica", elements = {}, material = "steel", section = "strip" }}
[[wall]]
name = "drum"
outline = {{ type = "circle", centre = [80.0, -152.0], radius = 150.0 }}
{}
{})toml",
                     elements, wall, more);
}

}  // namespace

TEST(TaperedMembers, TouchADrumWhereShootingComesToIt) {
  const TracedDeck run(drum(20, "contact_surface = \"axis\""));
  const double F = 200.0 * test::event_of(run, EventKind::contact_closes).lambda;
  const auto b = [](double s) { return 20.0 - 12.0 * s / 200.0; };
  const auto h = [](double s) { return 2.0 - s / 200.0; };
  const Shot shot{.A = [=](double s) { return b(s) * h(s); },
                  .I = [=](double s) { return b(s) * h(s) * h(s) * h(s) / 12.0; },
                  .half_height = h,
                  .E = 2.0e5,
                  .length = 200.0,
                  .F = {0.0, -F}};
  double least = infinity;
  for (const Shot::Place& place : shot.solve())
    least = std::min(least, std::hypot(place.y[0] - 80.0, place.y[1] + 152.0) - 150.0);
  EXPECT_NEAR(least, 0.0, 1e-5);  // between the steps of shooting, of 0.1
  test::expect_whole(run);
}

// Contact that spreads along the drum: finer meshes change it by their order.
TEST(TaperedMembers, LieOnADrumAlike) {
  const TracedDeck coarse(drum(20, "contact_surface = \"axis\"")), fine(drum(40, "contact_surface = \"axis\""));
  EXPECT_NEAR(test::event_of(coarse, EventKind::contact_spreads).lambda,
              test::event_of(fine, EventKind::contact_spreads).lambda, 1e-8);
  EXPECT_NEAR(last(coarse, "z"), last(fine, "z"), 1e-5);
}

// A strip that widens and gets thinner lies on a drum: with κ = −1/R of its axis and M = EI κ the pressure is
// (N − EI″)/R, N = F·t at the end of the part and, towards the clamp, N′ = −κ² EI′. Up to half of it and more comes
// from EI″.
TEST(TaperedMembers, PressOnADrumByTheirMoments) {
  constexpr double E = 2.0e5, L = 200.0, R = 150.0, F = 400.0;
  const auto b = [](double s) { return 8.0 + 12.0 * s / L; };
  const auto h = [](double s) { return 2.0 - 0.8 * s / L; };
  const auto EI = [&](double s) { return E * b(s) * std::pow(h(s), 3) / 12.0; };
  const auto EI_second = [&](double s) {
    constexpr double by_b = 12.0 / L, by_h = -0.8 / L;
    return 0.5 * E * h(s) * by_h * (by_b * h(s) + b(s) * by_h);
  };
  std::string deck = drum(40, "contact_surface = \"axis\"");
  const auto replace = [&](const std::string& from, const std::string& to) {
    deck.replace(deck.find(from), from.size(), to);
  };
  replace("width = 20.0, width_to = 8.0, height = 2.0, height_to = 1.0",
          "width = 8.0, width_to = 20.0, height = 2.0, height_to = 1.2");
  replace("lambda = [-0.1, 0.8]", "lambda = [-0.1, 2.0]");
  const TracedDeck run(deck);
  const RecordPoint& point = run.record().points.back();
  ASSERT_EQ(point.lambda, 2.0);
  double end = 0.0, x_end = 0.0;  // of the part, towards the tip
  for (const RecordForce& force : point.forces)
    if (L * force.label.fraction > end) std::tie(end, x_end) = std::pair(L * force.label.fraction, force.x);
  const double N_end = F * (x_end - 80.0) / R;
  std::vector<ContactPoint> nodes = run.model().contacts()->pressed_nodes(run.last());
  const auto is_before = [](const ContactPoint& one, const ContactPoint& other) {
    return one.label.fraction < other.label.fraction;
  };
  std::sort(nodes.begin(), nodes.end(), is_before);
  ASSERT_GT(nodes.size(), 8U);
  double most_by_bending = 0.0;
  // Beside the ends nodes that turn freely share the pressure unevenly.
  for (std::size_t i = 3; i + 3 < nodes.size(); ++i) {
    const double s = L * nodes[i].label.fraction, pressure = nodes[i].pressure().value();
    const double N = N_end + (EI(end) - EI(s)) / (R * R), expected = (N - EI_second(s)) / R;
    most_by_bending = std::max(most_by_bending, -EI_second(s) / R / expected);
    EXPECT_NEAR(pressure, expected, 2e-3 * expected) << s;
  }
  EXPECT_GT(most_by_bending, 0.05);
  test::expect_whole(run);
}

TEST(TaperedMembers, ThatFacesTouchHaveContactAtNodes) {
  const TracedDeck run(drum(20, ""));
  EXPECT_EQ(run.model().sliding(), nullptr);
  EXPECT_NE(
      test::said_of(drum(20, "", "[contact]\npoints = \"moving\"\n")).find("since its height tapers; use \"nodes\""),
      std::string::npos);
}

namespace {

// A cantilever of length 10 whose height stays 0.01 and whose width goes from the clamp to the tip, pressed at its tip.
std::string tapered_column(double width_to, const std::string& more = "") {
  return fmt::format(R"toml(
title = "A column that tapers"
material.m = {{ E = 1.0e9 }}
section.s = {{ shape = "rectangle", width = 0.12, width_to = {:.17g}, height = 0.01 }}
point = {{ clamp = [0.0, 0.0], tip = [10.0, 0.0] }}
support = {{ clamp = ["x", "z", "rotation"] }}
load = [{{ at = "tip", force = [-1.0, 0.0] }}]
path = {{ step = 0.02, branches = "primary", stop = {{ event = "branch-point", lambda = [-0.1, 1.0] }} }}
member.s = {{ from = "clamp", to = "tip", theory = "elastica", elements = 24, material = "m", section = "s" }}
{})toml",
                     width_to, more);
}

// In small slopes EI w″ + P w = 0, w from the tip: w = 0 there and w′ = 0 at the clamp. With EI = c y, y = g + s from
// the tip on, w is √y J₁(k √y) and √y Y₁(k √y), k = 2 √(P/c), whose derivatives are ½ k J₀ and ½ k Y₀.
double buckling_load(double width_to) {
  constexpr double E = 1.0e9, h = 0.01, L = 10.0, width = 0.12;
  const double c = E * h * h * h / 12.0 * (width - width_to) / L, g = width_to * L / (width - width_to);
  const auto condition = [&](double P) {
    const double k = 2.0 * std::sqrt(P / c), tip = k * std::sqrt(g), clamp = k * std::sqrt(g + L);
    return std::cyl_neumann(1.0, tip) * std::cyl_bessel_j(0.0, clamp) -
           std::cyl_bessel_j(1.0, tip) * std::cyl_neumann(0.0, clamp);
  };
  // Between the loads of a uniform column of the less and of the greater width.
  const auto uniform = [&](double b) { return pi * pi * E * b * h * h * h / 12.0 / (4.0 * L * L); };
  double low = uniform(width_to), high = uniform(width);
  const bool rises = condition(high) > 0.0;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    ((condition(middle) > 0.0) == rises ? high : low) = middle;
  }
  return low;
}

}  // namespace

// The buckling load of a column of linear width is a zero of Bessel's functions: at one width, over all of them by
// `curve`, and its derivative.
TEST(TaperedMembers, BuckleOverTheirTaperAsBesselsFunctionsHaveIt) {
  const auto slope_at = [](double width_to) {
    const double step = 1e-3 * width_to;
    return (8.0 * (buckling_load(width_to + step) - buckling_load(width_to - step)) -
            (buckling_load(width_to + 2.0 * step) - buckling_load(width_to - 2.0 * step))) /
           (12.0 * step);
  };
  const TracedDeck run(tapered_column(0.06), {"path.sensitivity=['section.s.width_to']"});
  const RecordEvent& buckles = test::event_of(run, EventKind::branch_point);
  const double P = buckling_load(0.06);
  EXPECT_NEAR(buckles.lambda, P, 1e-6 * P);
  EXPECT_NEAR(buckles.sensitivity.at(0).slope.value(), slope_at(0.06), 3e-6 * slope_at(0.06));
  const EventCurve curve = trace_event_curve(
      deck::read_deck_text(tapered_column(0.06,
                                          "[curve]\nevent = { kind = \"branch-point\" }\nparameter = "
                                          "\"section.s.width_to\"\nrange = [0.03, 0.1]\noutput_at = [0.08]\n"),
                           "deck.toml"),
      {});
  ASSERT_EQ(curve.problem, "");
  ASSERT_GT(curve.points.size(), 3U);
  for (const CurvePoint& point : curve.points) {
    EXPECT_NEAR(point.lambda, buckling_load(point.key), 1e-6 * point.lambda) << point.key;
    EXPECT_NEAR(point.slope.value(), slope_at(point.key), 3e-6 * slope_at(point.key)) << point.key;
  }
  const TracedDeck there(tapered_column(curve.points.back().key));
  const double lambda = curve.points.back().lambda;
  EXPECT_NEAR(test::event_of(there, EventKind::branch_point).lambda, lambda, 1e-9 * lambda);
}

TEST(TaperedMembers, AreRefusedWithACure) {
  const auto said = [](const std::string& from, const std::string& to) {
    std::string deck = bow("theory = \"elastica\"", 20);
    for (std::size_t at = deck.find(from); at != std::string::npos; at = deck.find(from, at + to.size()))
      deck.replace(at, from.size(), to);
    return test::said_of(deck);
  };
  EXPECT_NE(said("height_to = 7.0", "height_to = 0.0").find("section.limb.height_to: 0 is out of range"),
            std::string::npos);
  EXPECT_NE(said("theory = \"elastica\", elements = 20", "theory = \"truss\", elements = 1")
                .find("section limb tapers, and theory truss has members of one section; take a section without …_to"),
            std::string::npos);
  EXPECT_NE(said("theory = \"elastica\"", "theory = \"essenburg\"")
                .find("section limb tapers, and theory essenburg has members of one section"),
            std::string::npos);
  const std::string limb = R"(shape = "rectangle", width = 40.0, width_to = 20.0, height = 12.0, height_to = 7.0)";
  EXPECT_NE(said(limb, R"(shape = "tube", radius = 9.0, radius_to = 2.0, thickness = 3.0)")
                .find("section.limb.radius_to: 3 is more than the outer radius 2 at the member's end"),
            std::string::npos);
  EXPECT_NE(said(limb, R"(shape = "table", at = [0.0, 0.9], A = [1.0, 1.0], I = [1.0, 1.0])")
                .find("section.limb.at: the places do not ascend from 0 to 1"),
            std::string::npos);
  EXPECT_NE(said(limb, R"(shape = "table", at = [0.0, 1.0], A = [1.0, 1.0, 1.0], I = [1.0, 1.0])")
                .find("section.limb.A: 3 values and 2 places do not go together; give one value for each place in at"),
            std::string::npos);
}

}  // namespace arcwall::tapered_members_test
