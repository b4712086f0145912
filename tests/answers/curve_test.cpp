// Curves of events in two parameters, against closed forms and against decks that are run again.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "answers/event_curve.hpp"
#include "apps/output/curve_files.hpp"
#include "core/error.hpp"
#include "model/deck/reader.hpp"
#include "model/deck/writer.hpp"
#include "model/event_names.hpp"
#include "tests/apps/deck_texts.hpp"
#include "tests/apps/traced_deck.hpp"
#include "tests/support/deck_tables.hpp"

namespace arcwall::curve_test {

using namespace test::tables;
namespace {

using test::TracedDeck;

EventCurve curve_of(const std::string& deck, const std::vector<std::string>& assignments = {}) {
  EventCurve curve = trace_event_curve(deck::read_deck_text(deck, "deck.toml", assignments), {});
  EXPECT_EQ(curve.problem, "");
  return curve;
}

const CurvePoint& at(const EventCurve& curve, double key) {
  for (const CurvePoint& point : curve.points)
    if (point.key == key) return point;
  throw std::runtime_error(fmt::format("no point at {}", key));
}

std::vector<CurvePoint> specials(const EventCurve& curve, CurveSpecialKind kind) {
  std::vector<CurvePoint> points;
  for (const CurveSpecial& special : curve.specials)
    if (special.kind == kind) points.push_back(curve.points[special.point]);
  return points;
}

// λ of the curve at `places` of its points against runs of the deck with the key's value there.
void expect_runs(const std::string& deck, const EventCurve& curve, std::size_t places, double tolerance) {
  for (std::size_t i = 0; i < places; ++i) {
    const CurvePoint& point = curve.points[i * (curve.points.size() - 1) / (places - 1)];
    SCOPED_TRACE(fmt::format("{} = {}", curve.key, point.key));
    const TracedDeck traced(deck, {fmt::format("{}={:.17g}", curve.key, point.key)});
    const double run = event_of(traced, curve.event, curve.number).lambda;
    EXPECT_NEAR(point.lambda, run, tolerance * std::abs(run));
  }
}

std::string truss(const std::string& curve) { return test::truss_on_spring + "[curve]\n" + curve; }

// Roorda's frame of EI = 1 and L = 1, over the moment at its corner.
std::string roorda(const std::string& EA) {
  std::string deck = R"toml(
title = "Roorda's frame"
material.m = { E = 1.0 }
section.s = { shape = "general", A = %EA, I = 1.0 }
point = { foot = [0.0, 0.0], corner = [0.0, 1.0], end = [1.0, 1.0] }
support = { foot = ["x", "z"], end = ["x", "z"] }
load = [{ at = "corner", force = [0.0, -1.0] }, { at = "corner", moment = 1e-3 }]
path = { step = 1.0, branches = "primary", stop = { event = "limit-point", turn = [-0.8, 0.8] } }
monitor = [{ name = "turn", at = "corner", component = "rotation" }]
member.column = { from = "foot", to = "corner", theory = "elastica", elements = 8, material = "m", section = "s" }
member.beam = { from = "corner", to = "end", theory = "elastica", elements = 8, material = "m", section = "s" }
curve = { event = { kind = "limit-point" }, parameter = "load.1.moment", range = [-1e-3, 1e-3] }
)toml";
  return deck.replace(deck.find("%EA"), 3, EA);
}

}  // namespace

// P = EA w (w − h)(w − 2h)/L³ + k w in the depth w: limit points where P′ = 0. They end at a cusp where P′ and P″
// vanish at w = h, k = EA h²/L³ = 9.851853368415734 = P.
TEST(EventCurve, OfATrussOnASpringHasTheCuspOfTheClosedForm) {
  const EventCurve curve =
      curve_of(truss("event = { kind = \"limit-point\" }\nparameter = \"spring.0.stiffness.z\"\nrange = [0.5, "
                     "12.0]\noutput_at = [4.0]\n"));
  const double L3 = std::pow(101.0, 1.5), cusp = 1e4 / L3;
  for (const CurvePoint& point : curve.points) {
    const double w = -point.monitors.at(0);
    EXPECT_NEAR(1e4 * (3.0 * w * w - 6.0 * w + 2.0) / L3 + point.key, 0.0, 1e-8);
    EXPECT_NEAR(point.lambda, 1e4 * w * (w - 1.0) * (w - 2.0) / L3 + point.key * w, 1e-9 * cusp);
    EXPECT_NEAR(point.slope.value_or(w), w, 1e-7);  // dP/dk at fixed w
  }
  const auto cusps = specials(curve, CurveSpecialKind::cusp);
  ASSERT_EQ(cusps.size(), 1U);
  EXPECT_NEAR(cusps[0].key, cusp, 1e-10 * cusp);
  EXPECT_NEAR(cusps[0].lambda, cusp, 1e-7 * cusp);
  EXPECT_NO_THROW(at(curve, 4.0));
  EXPECT_EQ(at(curve, 4.0).unstable_before, 0);
  EXPECT_EQ(at(curve, 4.0).unstable_after, 1);
}

// A steep truss sways, and a side load H lowers its limit load from the perfect one's by 0.60678 H^(2/3), a value found
// by continuation of the closed form.
TEST(EventCurve, OfAnImperfectionFollowsTheTwoThirdsLaw) {
  const std::string deck =
      std::string(title("A steep truss with a side load") + material("m", 1.0) + general_section("s", 1.0, 1.0) +
                  points({{"left", -1.0, 0.0}, {"top", 0.0, 5.0}, {"right", 1.0, 0.0}}) +
                  supports({{"left", "x z"}, {"right", "x z"}}) + force("top", 0.0, -1.0) +
                  force("top", 1e-4, 0.0, constant) + path(R"(step = 0.005; stop = { event = "limit-point" })") +
                  monitor("w", "top", "z")) +
      test::two_bars + R"toml([curve]
event = { kind = "limit-point" }
parameter = "load.1.force.0"
range = [1e-9, 1e-4]
output_at = [1e-8, 1e-6]
)toml";
  const EventCurve curve = curve_of(deck);
  // Closed form of the perfect truss: at height z the sway begins where x² + z² = h² − 2b² has x = 0.
  const double h = 5.0, b = 1.0, z = std::sqrt(h * h - 2.0 * b * b), L = std::sqrt(h * h + b * b);
  const double perfect = z * (h * h - z * z) / (L * L * L);
  const auto fall = [&](double H) { return perfect - at(curve, H).lambda; };
  const double exponent = std::log(fall(1e-4) / fall(1e-8)) / std::log(1e4);
  EXPECT_NEAR(exponent, 2.0 / 3.0, 1e-3);
  EXPECT_NEAR(std::log(fall(1e-6) / fall(1e-8)) / std::log(1e2), 2.0 / 3.0, 1e-4);
  EXPECT_NEAR(fall(1e-8) / std::pow(1e-8, 2.0 / 3.0), 0.60678, 1e-3);
}

// A straight column between pins: P (1 − P/EA) = π² EI/L², a pitchfork for each L.
TEST(EventCurve, OfThePitchforkOfAColumnIsEulers) {
  const std::string deck = test::straight_column(16) + R"toml([curve]
event = { kind = "branch-point" }
parameter = "point.B.0"
range = [1.5, 3.0]
)toml";
  const EventCurve curve = curve_of(deck);
  ASSERT_GT(curve.points.size(), 10U);
  const double EI = 21000.0 * 8.333333333333333e-6, EA = 210.0;
  const double of_mesh = at(curve, 2.0).lambda * (1.0 - at(curve, 2.0).lambda / EA) * 4.0 / (pi * pi * EI);
  EXPECT_NEAR(of_mesh, 1.0, 1e-8);
  for (const CurvePoint& point : curve.points) {
    const double P = point.lambda, L = point.key;
    EXPECT_NEAR(P * (1.0 - P / EA), pi * pi * EI / (L * L), 2e-8 * P);
    EXPECT_NEAR(*point.slope, -2.0 * pi * pi * EI / (L * L * L) / (1.0 - 2.0 * P / EA), 1e-6 * std::abs(*point.slope));
    EXPECT_EQ(point.unstable_before, 0);
    EXPECT_EQ(point.unstable_after, 1);
  }
}

namespace {

// A column in a channel, whose imperfection has a third harmonic.
std::string channel(const std::string& curve) {
  return test::pressed_column_in_channel(20, "stop = { lambda = [-1.0, 10.0], event = \"limit-point\" }") +
         R"toml([curve]
)toml" + curve;
}

}  // namespace

// Touch, spreading and snap over the gap are those of other runs.
TEST(EventCurve, OfEachEventOfAColumnInAChannelIsThatOfOtherRunsSlow) {
  for (const char* kind : {"contact-closes", "contact-splits", "limit-point"}) {
    SCOPED_TRACE(kind);
    const std::string deck =
        channel(fmt::format("event = {{ kind = \"{}\" }}\nparameter = \"wall.upper.profile.z\"\nrange = [0.17, "
                            "0.25]\noutput_at = [0.175]\n",
                            kind));
    const EventCurve curve = curve_of(deck);
    ASSERT_GT(curve.points.size(), 5U);
    EXPECT_NO_THROW(at(curve, 0.175));
    expect_runs(deck, curve, std::string_view(kind) == "limit-point" ? 20 : 4, 1e-9);
  }
}

// Without a half sine the third harmonic e₃ lowers the limit load by 16.31306 √e₃, a value of the elastica by shooting:
// of e₃, 4 e₃ and 16 e₃ the second fall is twice the first, but for a part that goes with √e₃ itself and is taken out.
TEST(EventCurve, OfAThirdHarmonicFollowsTheSquareRootLawSlow) {
  const EventCurve curve = curve_of(
      channel("event = { kind = \"limit-point\" }\nparameter = \"member.column.imperfection.1.amplitude\"\n"
              "range = [1e-8, 1.7e-4]\noutput_at = [4e-8, 1.6e-7, 6.4e-7, 2.56e-6, 1.024e-5, 4.096e-5, 1.6384e-4]\n"),
      {"member.column.imperfection.0.amplitude=0.0"});
  std::vector<double> exponents;
  for (const double e : {1e-8, 4e-8, 1.6e-7, 6.4e-7, 2.56e-6, 1.024e-5}) {
    const double a = at(curve, e).lambda, b = at(curve, 4.0 * e).lambda, c = at(curve, 16.0 * e).lambda;
    exponents.push_back(std::log((b - c) / (a - b)) / std::log(4.0));
  }
  for (std::size_t i = 0; i + 1 < exponents.size(); ++i)
    EXPECT_NEAR(2.0 * exponents[i] - exponents[i + 1], 0.5, 1e-3) << i;
  EXPECT_NEAR(exponents.front(), 0.5, 1e-3);
  EXPECT_NEAR((at(curve, 1e-8).lambda - at(curve, 4e-8).lambda) / 1e-4, 16.31306, 2e-2);
}

// Roorda's frame under a load and a moment e at its corner: to first order the limit load is P_c (1 − 1.15139 √e), P_c
// = 13.885942905964721 (3 (1 − k cot k) + k² = 0, P = k²; the factor by Koiter's slope, shooting of the inextensible
// elastica). A column that shortens acts like a moment of about 3/EA: the curve turns where e makes up for that, at a
// cusp, beyond which it is that of the least loads of the branch on the other side. Half the distance of the two goes
// with the root of e counted from there, and has no part that goes with e itself.
TEST(EventCurve, OfRoordasFrameFollowsTheSquareRootLawSlow) {
  const std::string deck = roorda("1e6");
  constexpr double critical = 13.885942905964721;
  const auto cusps = specials(curve_of(deck), CurveSpecialKind::cusp);
  ASSERT_EQ(cusps.size(), 1U);
  EXPECT_NEAR(cusps[0].key, -3e-6, 1e-9);
  EXPECT_NEAR(cusps[0].lambda, critical, 2e-5 * critical);

  const std::vector<double> distances{1e-8, 1e-7, 1e-6, 1e-5, 1e-4};
  std::string land;
  for (const double distance : distances) land += fmt::format("{:.17g}, ", cusps[0].key + distance);
  const EventCurve curve = curve_of(deck, {"curve.output_at=[" + land + "]"});
  std::vector<double> halves;
  for (const double distance : distances) {
    std::vector<double> loads;
    for (const CurvePoint& point : curve.points)
      if (point.key == cusps[0].key + distance) loads.push_back(point.lambda);
    ASSERT_EQ(loads.size(), 2U) << distance;
    halves.push_back(0.5 * std::abs(loads[1] - loads[0]));
  }
  for (std::size_t i = 0; i + 1 < halves.size(); ++i)
    EXPECT_NEAR(std::log(halves[i + 1] / halves[i]) / std::log(10.0), 0.5, 1e-3) << distances[i];
  EXPECT_NEAR(halves.front() / (critical * 1e-4), 1.15139, 1e-3);
}

// The steps of a curve are those of its own bend, however stiff the members are beside it: some sixty points, with EA =
// 1e7 as with 1e5. At the cusp, where the column's shortening acts like a moment of 3/EA, two branches cross; the curve
// comes through that point, landed on to the last digit, as well.
TEST(EventCurve, TakesStepsThatDoNotHangOnAxialStiffnessSlow) {
  for (const double EA : {1e5, 1e6, 1e7}) {
    SCOPED_TRACE(EA);
    const EventCurve curve = curve_of(roorda(fmt::format("{:.1f}", EA)));
    const auto cusps = specials(curve, CurveSpecialKind::cusp);
    ASSERT_EQ(cusps.size(), 1U);
    EXPECT_NEAR(cusps[0].key * EA, -3.0, 1e-3);
    EXPECT_EQ(curve.points.front().key, 1e-3);
    EXPECT_EQ(curve.points.back().key, 1e-3);
    EXPECT_LE(curve.points.size(), 100U);
  }
}

// λ is the end shortening, and the reaction turns before it does.
TEST(EventCurve, OfAMonitorThatTurnsIsThatOfOtherRunsSlow) {
  std::string deck =
      channel("event = { kind = \"turning-point\" }\nparameter = \"wall.upper.profile.z\"\nrange = [0.18, 0.22]\n");
  const auto put = [&](const std::string& from, const std::string& to) {
    deck.replace(deck.find(from), from.size(), to);
  };
  put("load = [{ at = \"B\", force = [-1.0, 0.0] }]", "prescribed = [{ at = \"B\", x = -1.0 }]");
  put("step = 0.05, stop = { lambda = [-1.0, 10.0], event = \"limit-point\" }",
      "step = 0.004, watch = [\"P\"], stop = { event = \"limit-point\" }");
  put("[[monitor]]", "[[monitor]]\nname = \"P\"\nat = \"B\"\ncomponent = \"reaction-x\"\n[[monitor]]");
  const EventCurve curve = curve_of(deck);
  ASSERT_GT(curve.points.size(), 3U);
  expect_runs(deck, curve, 3, 1e-9);
}

// Limit points of a pinned sine arch appear at a cusp, and the branch point overtakes them. Rise and load by shooting:
// 0.057825384052 and 0.061386356, 0.138553363544 and 0.371987159883; at rise 0.12 the limit load is 0.262293877613.
TEST(EventCurve, OfAPinnedArchHasItsCuspAndItsCrossingSlow) {
  const std::string deck =
      title("Sine arch, central load") + material("m", 21000.0) + rectangle("s", 0.1, 0.1) +
      points({{"l", 0.0, 0.0}, {"r", 2.0, 0.0}}) + supports({{"l", "x z"}, {"r", "x z"}}) +
      force("arch:0.5", 0.0, -1.0) + path(R"(step = 0.01; branches = "primary"; stop = { crown = [-0.19, 0.01] })") +
      monitor("crown", "arch:0.5", "z") + member("arch", "l", "r", "elastica", 20, "sine = { rise = 0.1, waves = 1 }") +
      table(
          "[curve]",
          R"(event = { kind = "limit-point" }; parameter = "member.arch.sine.rise"; range = [0.05, 0.15]; output_at = [0.12])");
  const EventCurve curve = curve_of(deck);
  const auto cusps = specials(curve, CurveSpecialKind::cusp), crossings = specials(curve, CurveSpecialKind::crossing);
  ASSERT_EQ(cusps.size(), 1U);
  EXPECT_NEAR(cusps[0].key, 0.057825384052, 1e-6);
  EXPECT_NEAR(cusps[0].lambda, 0.061386356, 1e-6);
  ASSERT_FALSE(crossings.empty());
  EXPECT_NEAR(crossings.back().key, 0.138553363544, 2e-6);
  EXPECT_NEAR(crossings.back().lambda, 0.371987159883, 5e-6);
  EXPECT_EQ(curve.points.back().unstable_before, 1);
  EXPECT_NEAR(std::max_element(curve.points.begin(), curve.points.end(),
                               [](const CurvePoint& a, const CurvePoint& b) {
                                 return (a.key == 0.12 ? a.lambda : -1.0) < (b.key == 0.12 ? b.lambda : -1.0);
                               })
                  ->lambda,
              0.262293877613, 1e-7);
}

// A column in a channel has a
// snap that a larger half sine raises and a larger third harmonic lowers, so that the worst change goes against the one
// and with the other.
TEST(WorstCombination, GoesAgainstTheSlopesAndLowersTheSnap) {
  std::string text = channel(
      "event = { kind = \"limit-point\" }\nworst = [\"member.column.imperfection.0.amplitude\", "
      "\"member.column.imperfection.1.amplitude\"]\nradius = 2e-5\n");
  const WorstCombination worst = worst_combination(deck::read_deck_text(text, "deck.toml"), {});
  EXPECT_EQ(worst.problem, "");
  EXPECT_TRUE(worst.settled);
  EXPECT_LT(worst.values.at(0), worst.own.at(0));
  EXPECT_GT(worst.values.at(1), worst.own.at(1));
  const Vec2 change(worst.values[0] - worst.own[0], worst.values[1] - worst.own[1]);
  const Vec2 slopes(worst.slopes.at(0), worst.slopes.at(1));
  EXPECT_NEAR(change.norm(), 2e-5, 1e-12);
  EXPECT_NEAR(change.normalized().dot(slopes.normalized()), -1.0, 1e-10);
  // Others of the same norm are higher.
  for (const double turn : {-0.3, 0.3}) {
    const Vec2 other = std::cos(turn) * change + std::sin(turn) * perp(change);
    const TracedDeck traced(text,
                            {fmt::format("member.column.imperfection.0.amplitude={:.17g}", worst.own[0] + other.x()),
                             fmt::format("member.column.imperfection.1.amplitude={:.17g}", worst.own[1] + other.y())});
    for (const RecordEvent& event : traced.record().events)
      EXPECT_TRUE(event.kind != EventKind::limit_point || event.lambda > worst.lambda);
  }
}

TEST(EventCurve, IsRefusedWithASentence) {
  const auto problem = [](const std::string& curve, const std::vector<std::string>& set = {}) {
    try {
      return trace_event_curve(deck::read_deck_text(channel(curve), "deck.toml", set), {}).problem;
    } catch (const InputError& error) {
      return error.diagnostics().front().message;
    }
  };
  const std::string over = "parameter = \"wall.upper.profile.z\"\n", range = "range = [0.17, 0.25]\n";
  const std::string limit = "event = { kind = \"limit-point\" }\n";
  EXPECT_NE(problem(limit + over + "range = [0.3, 0.4]\n").find("is outside"), std::string::npos);
  EXPECT_NE(problem(limit + over).find("is missing"), std::string::npos);
  EXPECT_NE(problem(limit + over + "range = [0.3, 0.1]\n").find("no interval"), std::string::npos);
  EXPECT_NE(problem(limit).find("nothing varies"), std::string::npos);
  EXPECT_NE(problem(limit + "parameter = \"wall.upper.side\"\n" + range).find("is no number"), std::string::npos);
  EXPECT_NE(problem("event = { kind = \"limit-point\", number = 7 }\n" + over + range).find("only 1"),
            std::string::npos);
  EXPECT_NE(problem("event = { kind = \"branch-point\" }\n" + over + range).find("none of kind branch-point"),
            std::string::npos);
}

// Over a gap of less than 0.1997 a contact at five sixths of the length opens before the second touch.
TEST(EventCurve, NamesWallAndPlaceWhereItEnds) {
  const EventCurve curve =
      curve_of(test::pressed_column_in_channel(20, "stop = { lambda = [-1.0, 10.0] }") +
               "[curve]\nevent = { kind = \"contact-closes\", number = 2 }\nparameter = \"wall.upper.profile.z\"\n"
               "range = [0.18, 0.22]\n");
  const auto begins = std::find_if(curve.specials.begin(), curve.specials.end(),
                                   [](const CurveSpecial& one) { return one.kind == CurveSpecialKind::begins; });
  ASSERT_NE(begins, curve.specials.end());
  EXPECT_NE(begins->why.find("opens there: upper at column:0."), std::string::npos) << begins->why;
}

TEST(EventCurve, IsWrittenAsATableAPageAndSpecialPoints) {
  const std::string text =
      channel("event = { kind = \"contact-closes\" }\nparameter = \"wall.upper.profile.z\"\nrange = [0.19, 0.21]\n");
  const deck::Deck deck = deck::read_deck_text(text, "deck.toml");
  EXPECT_EQ(deck::read_deck_text(deck::to_toml(deck), "deck.toml"), deck);
  const EventCurve curve = curve_of(text);
  const std::string csv = curve_csv(curve, UnitLabels::left_out);
  EXPECT_TRUE(
      csv.starts_with("point,arc,key,lambda,mid,slope,unstable_before,unstable_after,contacts,slope-mid\n0,0,0.19,"));
  const auto json = curve_json(curve, {.deck_text = text});
  EXPECT_EQ(json["specials"].front()["kind"], "begins");
  EXPECT_EQ(json["specials"].back()["kind"], "ends");
  EXPECT_EQ(json["specials"].back()["reason"], "stop");
  EXPECT_DOUBLE_EQ(json["specials"].back()["key"].get<double>(), 0.21);
  // Shapes had no walls, and their contacts stood outside of them.
  EXPECT_NE(curve_html(curve, {}).find("<path class=\"moving\" data-path=\"2\" d=\"M"), std::string::npos);
  EXPECT_EQ(curve_status(curve), ExitStatus::success);
}

// As the page of a run has it; along a curve over the load itself there is no one size of what λ multiplies.
TEST(EventCurve, SaysOnItsPageWhatLambdaMultiplies) {
  const deck::Deck deck = deck::read_deck_text(
      channel("event = { kind = \"contact-closes\" }\nparameter = \"wall.upper.profile.z\"\nrange = [0.19, 0.21]\n"),
      "deck.toml", {"units.length='cm'", "units.force='kN'", "load.0.force=[-2.0, 0.0]"});
  const std::vector<LoadText> loads = driven_by_lambda(deck);
  EventCurve curve{.key = deck.curve->parameter, .key_unit = "cm"};
  const std::string with_size = "load factor λ, times 2 kN</text>", without = "load factor λ</text>";
  EXPECT_NE(curve_html(curve, loads).find(with_size), std::string::npos);
  EXPECT_NE(curve_picture(curve, loads).find(with_size), std::string::npos);
  curve.key = "load.0.force.0";
  EXPECT_NE(curve_html(curve, loads).find(without), std::string::npos);
}

}  // namespace arcwall::curve_test
