// The examples of devices: each runs to its end, is confirmed, and has the number that its first lines give by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "answers/sessions.hpp"
#include "apps/cli/example_decks.hpp"
#include "tests/apps/traced_deck.hpp"
#include "tests/apps/verify/expect_whole.hpp"

namespace arcwall::devices_test {
namespace {

using std::numbers::pi;

double monitor(const Record& record, const std::vector<double>& values, const std::string& name) {
  for (std::size_t m = 0; m < record.columns.size(); ++m)
    if (record.columns[m].name == name) return values[m];
  ADD_FAILURE() << "no monitor " << name;
  return 0.0;
}

const RecordPoint& landed(const Record& record, double lambda) {
  return *std::min_element(record.points.begin(), record.points.end(), [&](const auto& a, const auto& b) {
    return std::abs(a.lambda - lambda) < std::abs(b.lambda - lambda);
  });
}

// A number of a run, what it is by hand, and how far the hand is off.
struct Number {
  double found, by_hand, relative;
};

Number of_bow(const Record& record) {  // EI/(R a), from a point to a stretch
  const double a = 100.0, sagitta = 4.5, R = (a * a + sagitta * sagitta) / (2.0 * sagitta);
  const RecordEvent& spreads = test::event_of(record, EventKind::contact_spreads);
  return {monitor(record, spreads.monitors, "press"), 2.0e5 * 20.0 / 12.0 / (R * a), 0.01};
}

// The pull at the pipe's removal: the tip, pushed out by r sin γ − a at the angle γ of the pipe, against the compliance
// of a circular arc for a force that friction turns by atan μ; the greatest over γ, small slopes.
Number of_clip(const Record& record) {
  const double R = 11.0, mouth = 0.9, r = 10.8, mu = 0.3, EI = 2400.0 * 10.0 * 8.0 / 12.0;
  double across = 0.0, both = 0.0, greatest = 0.0;
  const int pieces = 20000;
  for (int i = 0; i < pieces; ++i) {
    const double angle = mouth + (pi - mouth) * (i + 0.5) / pieces;
    const double z = R * (std::cos(mouth) - std::cos(angle)), x = R * (std::sin(angle) - std::sin(mouth));
    across += z * z * R * (pi - mouth) / pieces / EI;
    both += z * x * R * (pi - mouth) / pieces / EI;
  }
  const double first = std::asin(R * std::sin(mouth) / r);
  for (double angle = first; angle < pi - first; angle += 1e-3) {
    const double x = std::cos(angle) + mu * std::sin(angle), z = std::sin(angle) - mu * std::cos(angle);
    greatest = std::max(greatest, (r * std::sin(angle) - R * std::sin(mouth)) * x / (across * z + both * x));
  }
  const RecordEvent& pulled = test::event_of(record, EventKind::turning_point, 3);
  return {-monitor(record, pulled.monitors, "push"), greatest, 0.09};
}

Number of_drill_pipe(const Record& record) {  // F exp(−5/2 μ h L/a²)
  const double mu = 0.4, h = 32.0, L = 2000.0, a = 200.0;
  return {monitor(record, record.points.back().monitors, "bit"), 1000.0 * std::exp(-2.5 * mu * h * L / (a * a)), 0.06};
}

// The least eigenvalue of EI θ″ + (W − p x) θ = H with θ′ = 0 at both ends and ∫ θ dx = 0 at the length of 7.968
// (EI/p)^⅓, by Runge-Kutta's method of order 4.
Number of_drill_string(const Record& record) {
  const double EI = 2.1e8 * pi / 4.0 * (std::pow(0.08, 4.0) - std::pow(0.035, 4.0));
  return {test::event_of(record, EventKind::branch_point).lambda, 1.938332 * std::cbrt(EI * 1.2 * 1.2), 1e-4};
}

Number of_guidewire(const Record& record) {  // EI/(2 R²)
  const double EI = 6.0e4 * pi / 4.0 * std::pow(0.18, 4.0);
  return {monitor(record, landed(record, 60.0).monitors, "push"), EI / (2.0 * 58.0 * 58.0), 0.02};
}

// 2 μ F (1 + 2 √2 e^(−μθ) + e^(−2 μθ)): F = EI/(R √(48 c R)) where the wire crosses between straight and bend, 2 √2 F
// between bends, and the thrust relieves the inner wall of a bend of the angle θ.
Number of_guidewire_friction(const Record& record) {
  const double EI = 6.0e4 * pi / 4.0 * std::pow(0.18, 4.0), R = 60.0, c = 1.0, mu = 0.2;
  const double F = EI / (R * std::sqrt(48.0 * c * R)), relief = std::exp(-mu * pi / 3.0);
  return {monitor(record, landed(record, 165.0).monitors, "push"),
          2.0 * mu * F * (1.0 + std::sqrt(8.0) * relief + relief * relief), 0.04};
}

Number of_harvester(const Record& record) {  // 2 √(δ L)/π
  const RecordPoint* rests = nullptr;
  for (const RecordPoint& point : record.points)
    if (record.stage_of(point.branch) == "shorten") rests = &point;
  return {monitor(record, rests->monitors, "middle"), 2.0 * std::sqrt(0.5 * 100.0) / pi, 5e-3};
}

// Qiu, Lang and Slocum's force of a cosine beam without its second mode, (3π⁴Q²/2) Δ ((Δ − 3/2)² − ¼ + 4/(3 Q²)) EI
// h/ℓ³ with Q = h/t and the way Δ h; here the greatest, for small slopes.
Number of_lattice(const Record& record) {
  const double Q = 3.0 / 1.364, EI = 1600.0 * 10.0 * std::pow(1.364, 3.0) / 12.0;
  double greatest = 0.0;
  for (double d = 0.0; d < 1.0; d += 1e-3)
    greatest =
        std::max(greatest, 1.5 * std::pow(pi, 4.0) * Q * Q * d * ((d - 1.5) * (d - 1.5) - 0.25 + 4.0 / (3.0 * Q * Q)));
  const RecordEvent& peak = test::event_of(record, EventKind::turning_point);
  return {monitor(record, peak.monitors, "force"), 2.0 * greatest * EI * 3.0 / std::pow(40.0, 3.0), 0.06};
}

Number of_leaf_spring(const Record& record) {  // an arc of the former, and a cantilever on its end
  const double EI = 175000.0, R = 800.0, P = 4.0, free = EI / (P * R), c = 100.0 - free;
  return {monitor(record, landed(record, P).monitors, "tip"),
          c * c / (2.0 * R) + c / R * free + P * std::pow(free, 3.0) / (3.0 * EI), 0.01};
}

Number of_mems_switch(const Record& record) {  // 740 EI h/ℓ³
  const double EI = 1.6e5 * 100.0 * 125.0 / 12.0;
  return {test::event_of(record, EventKind::limit_point).lambda, 740.0 * EI * 40.0 / 1e9, 0.02};
}

// The greatest P for which EI w⁗ + P w″ = EI A k⁴ cos kx − q has a span from −c to c with w′ = w″ = 0 at its ends, x
// from the crest: w″ = B cos μx + C cos kx − q/P vanishes at c, and so does its integral.
Number of_pipeline(const Record& record) {
  const double ro = 0.162, ri = ro - 0.0127, EI = 2.1e8 * pi / 4.0 * (std::pow(ro, 4.0) - std::pow(ri, 4.0));
  const double k = pi / 30.0, A = 0.3, q = 1.0;
  const auto has_span = [&](double P) {
    const double mu = std::sqrt(P / EI), C = EI * A * std::pow(k, 4.0) / (P - EI * k * k);
    const auto left_over = [&](double c) {
      return (q / P - C * std::cos(k * c)) * std::sin(mu * c) / mu +
             (C * std::sin(k * c) / k - q * c / P) * std::cos(mu * c);
    };
    for (double c = 8.0; c < 15.0; c += 0.01)
      if (left_over(c) * left_over(c + 0.01) < 0.0) return true;
    return false;
  };
  double low = 1.5 * EI * k * k, high = 8.0 * EI * k * k;
  while (high - low > 1e-3) (has_span(0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
  return {test::event_of(record, EventKind::limit_point).lambda, low, 0.01};
}

Number of_portal(const Record& record) {  // k h tan k h = 6
  return {test::event_of(record, EventKind::branch_point).lambda, 1.34955 * 1.34955 * 2100.0 / 16.0, 2e-3};
}

Number of_rail(const Record& record) {  // EI q² + k/q² of three half waves
  const double q = 3.0 * pi / 12.0;
  return {monitor(record, test::event_of(record, EventKind::branch_point).monitors, "force"),
          2100.0 * q * q + 500.0 / (q * q), 2e-3};
}

// Hobbs (1984): a span L of thrust P = 80.76 EI/L² and height 2.408e-3 q L⁴/EI at EA α T = P + (q L/EI) √(1.597e-5 EA
// μ q L⁵ − ¼ (μ EI)²).
Number of_rail_lift(const Record& record) {
  const double EI = 12600.0, EA = 3.234e6, q = 4.0, mu = 0.6, thrust = EA * 1.15e-5 * 60.0;
  double low = 15.0, high = 30.0;
  while (high - low > 1e-9) {
    const double L = 0.5 * (low + high);
    const double feed = 1.597e-5 * EA * mu * q * std::pow(L, 5.0) - 0.25 * mu * mu * EI * EI;
    (80.76 * EI / (L * L) + q * L / EI * std::sqrt(feed) > thrust ? low : high) = L;
  }
  return {0.01 * test::event_of(record, EventKind::value_crossing).lambda, 2.408e-3 * q * std::pow(low, 4.0) / EI,
          5e-3};
}

Number of_ring(const Record& record) {  // at 1/100 of the radius
  const double EI = 5.0 * 20.0 * 8.0 / 12.0, R = 30.0;
  return {monitor(record, landed(record, 0.3).monitors, "force"), 0.3 * EI / (R * R * R) / (pi / 4.0 - 2.0 / pi), 0.02};
}

Number of_snap_fit(const Record& record) {  // P t with P = (3 EI y/ℓ³)/(1 − 3 a t/(2 ℓ)), at the greatest push
  const RecordEvent& greatest = test::event_of(record, EventKind::turning_point);
  const double EI = 2400.0 * 5.0 * std::pow(1.5, 3.0) / 12.0, y = monitor(record, greatest.monitors, "lift");
  return {monitor(record, greatest.monitors, "push"), 0.5 * 3.0 * EI * y / 8000.0 / (1.0 - 1.5 * 3.0 * 0.5 / 20.0),
          0.08};
}

// P (μ + t)/(1 − μ t) with P = 3 EI y/ℓ³, where the flank ends.
Number of_snap_fit_friction(const Record& record) {
  const RecordEvent& greatest = test::event_of(record, EventKind::turning_point);
  const double EI = 2400.0 * 5.0 * std::pow(1.5, 3.0) / 12.0, mu = 0.3, t = 0.5;
  const double P = 3.0 * EI * (1.2 - 0.3 * (1.0 - std::cos(std::atan(t)))) / 8000.0;
  return {monitor(record, greatest.monitors, "push"), P * (mu + t) / (1.0 - mu * t), 0.15};
}

const std::map<std::string_view, Number (*)(const Record&)> numbers{{"bow", of_bow},
                                                                    {"clip", of_clip},
                                                                    {"drill-pipe", of_drill_pipe},
                                                                    {"drill-string", of_drill_string},
                                                                    {"guidewire", of_guidewire},
                                                                    {"guidewire-friction", of_guidewire_friction},
                                                                    {"harvester", of_harvester},
                                                                    {"lattice", of_lattice},
                                                                    {"leaf-spring", of_leaf_spring},
                                                                    {"mems-switch", of_mems_switch},
                                                                    {"pipeline", of_pipeline},
                                                                    {"portal", of_portal},
                                                                    {"rail", of_rail},
                                                                    {"rail-lift", of_rail_lift},
                                                                    {"ring", of_ring},
                                                                    {"snap-fit", of_snap_fit},
                                                                    {"snap-fit-friction", of_snap_fit_friction}};

Record record_of(std::string_view name) {
  for (const ExampleDeck& device : example_devices())
    if (device.name == name) return test::TracedDeck(device.text).record();
  ADD_FAILURE() << "no device is called " << name;
  return {};
}

void expect_turns(const std::string& name, const std::vector<double>& pushes, double tolerance) {
  const std::vector<RecordEvent> turns = test::events_of(record_of(name), EventKind::turning_point);
  ASSERT_EQ(turns.size(), pushes.size()) << name;
  for (std::size_t i = 0; i < pushes.size(); ++i)
    EXPECT_NEAR(turns[i].monitors.at(0), pushes[i], tolerance * std::abs(pushes[i])) << name;
}

}  // namespace

TEST(ExampleDevices, HaveTheNumbersThatTheySaySlow) {
  EXPECT_EQ(example_devices().size(), numbers.size());
  for (const ExampleDeck& device : example_devices()) {
    SCOPED_TRACE(std::string(device.name));
    const test::TracedDeck traced(device.text);
    const Record& record = traced.record();
    for (const RecordBranch& branch : record.branches)
      EXPECT_TRUE(branch.end->reason == EndReason::stop || branch.end->reason == EndReason::switched_branch)
          << branch.end->detail;
    const Number number = numbers.at(device.name)(record);
    EXPECT_NEAR(number.found, number.by_hand, number.relative * number.by_hand);
    test::expect_verified(traced);
  }
}

// Extensible elastica by shooting with Runge-Kutta's method of order 4, the contact forces unknowns at the same nodes:
// the greatest and the least push on the way in and on the way out.
TEST(DevicesWithFriction, ArePushedInAndDrawnOutAsByShooting) {
  expect_turns("snap-fit-friction", {1.589465818552, -0.681118801627, -1.972334610946, 0.257485466813}, 1e-8);
  expect_turns("clip", {4.377915125774, -0.847011463939, -6.144239492927, 0.784376429366}, 1e-7);
}

// As above. The rail's elements are of order 4 under its weight: their error is 2e-5, and 1.5e-7 with twice as many.
TEST(DevicesWithFriction, PassOnThrustAsByShootingSlow) {
  const Record wire = record_of("guidewire-friction"), pipe = record_of("drill-pipe"), rail = record_of("rail-lift");
  EXPECT_NEAR(monitor(wire, landed(wire, 165.0).monitors, "push"), 0.024571967464, 1e-8 * 0.024571967464);
  EXPECT_NEAR(monitor(pipe, pipe.points.back().monitors, "bit"), 190.8664414, 2e-8 * 190.8664414);
  const RecordEvent& loose = test::event_of(rail, EventKind::value_crossing);
  EXPECT_NEAR(loose.lambda, 18.79786410, 3e-5 * 18.79786410);
  EXPECT_NEAR(monitor(rail, loose.monitors, "thrust"), 2049.448853, 2e-5 * 2049.448853);
}

// A branch comes back to the pitchfork from which it leaves on a mesh of its own: it is the same place all the same,
// and the path is not followed round and round.
TEST(Pipeline, LeavesAPitchforkOnceThoughItComesBackOnAnotherMesh) {
  const auto& devices = example_devices();
  const auto pipeline =
      std::find_if(devices.begin(), devices.end(), [](const ExampleDeck& device) { return device.name == "pipeline"; });
  ASSERT_NE(pipeline, devices.end());
  Session run = make_session({.deck = "pipeline.toml",
                              .deck_text = std::string(pipeline->text),
                              .assignments = {"path.branches=\"most-stable\"", "load.0.distributed=[0.0, -1.03]"}});
  ASSERT_TRUE(run.begin()) << run.problem();
  while (run.next() != nullptr) ASSERT_LT(run.points().size(), 300u);
  EXPECT_EQ(run.record().branches.size(), 2u);
}

}  // namespace arcwall::devices_test
