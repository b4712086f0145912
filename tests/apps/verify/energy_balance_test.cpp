#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>

#include "tests/apps/traced_deck.hpp"
#include "tests/apps/verify/expect_whole.hpp"
#include "tests/model/friction_decks.hpp"

// What `verify` says of what friction dissipates.
namespace arcwall::verify::energy_balance_test {

namespace {

using namespace friction_test;
using test::TracedDeck;

const std::string dragged = "title = \"Dragged\"\n" + strip(0.3,
                                                            stage("press", "prescribed.0", 0.0005, -1.0, 0.4) +
                                                                stage("drag", "prescribed.1", 0.01, -1.0, 0.1) +
                                                                stage("back", "prescribed.1", -0.001, -0.2, 1.0),
                                                            "[[prescribed]]\nat = \"clamp\"\nx = 1.0\n");

const CheckSummary* check_of(const Verdict& verdict, const std::string& name) {
  for (const CheckSummary& check : verdict.findings.checks())
    if (check.name == name) return &check;
  return nullptr;
}

std::string first_failure(const TracedDeck& traced, const std::function<void(Record&)>& change) {
  Record record = traced.record();
  change(record);
  const Verdict verdict = verify(traced.model(), record, stored_files_of(record), "checkpoint");
  EXPECT_TRUE(verdict.findings.first().has_value()) << "not caught";
  return verdict.findings.first() ? verdict.findings.first()->what : "";
}

}  // namespace

TEST(EnergyBalance, RunsWithFrictionAreConfirmed) {
  for (const std::string& text :
       {"title = \"Block\"\n" + block(0.3),
        "title = \"Block\"\n" + block_on_spring + "[path]\nvisit = [0.05, -0.05, 0.05]\n",
        "title = \"Node\"\n" + incline(0.3), "title = \"Node\"\n" + incline(1.25), dragged,
        "title = \"Pressed\"\n" + strip(0.8, stage("press", "prescribed.0", 0.0005, -1.0, 0.08))})
    test::expect_whole(TracedDeck(text));
}

// A strip that is hardly heated lies on its floor. Its energies are sums of great parts that cancel, of which those of
// friction are small: round-off of 9e-13 is no finding. At 0.4 degrees differences of rounded energies agree by chance.
TEST(EnergyBalance, RoundOffOfLargePartsIsNoFindingSlow) {
  const std::string strip = R"toml(
title = "strip"
material.m = { E = 70000000000.0, nu = 0.3, expansion = 1e-5 }
section.s = { shape = "rectangle", width = 0.031125399347804984, height = 0.031125399347804984 }
point = { a = [0.0, 0.0], b = [6.225079869560997, 0.0] }
member.l = { from = "a", to = "b", theory = "elastica", material = "m", section = "s", elements = 20 }
wall = [{ name = "floor", side = "below", contact_surface = "axis", profile = { type = "flat", z = 0.0 }, friction = 0.1 }]
contact.points = "nodes"
monitor = [{ name = "xb", at = "b", component = "x" }]
load = [{ on = "l", distributed = [0.0, -7.433434294451756], constant = true }, { on = "l", temperature = 0.020011177938102802 }]
path = { step = 0.05, stop = { lambda = [-9.0, 1.0] } }
)toml";
  for (const std::string heat : {"0.020011177938102802", "0.4", "0.9"})
    test::expect_whole(TracedDeck(strip, {"load.1.temperature=" + heat}));
}

// A thin wire is pushed without contact, and into the first bend. Within a thousandth of its path the hub alone would
// press its element to many times its buckling load.
TEST(EnergyBalance, ThinWiresAreConfirmedSlow) {
  const auto& devices = example_devices();
  const auto wire = std::find_if(devices.begin(), devices.end(),
                                 [](const ExampleDeck& device) { return device.name == "guidewire-friction"; });
  ASSERT_NE(wire, devices.end());
  for (const std::string range : {"[-1.0, 10.0]", "[-1.0, 82.0]", "[-1.0, 90.0]"})
    test::expect_whole(TracedDeck(wire->text, {"path.stop.lambda=" + range}));
}

// The bound is the error of the quadrature: far below what is dissipated.
TEST(EnergyBalance, ItsBoundIsTold) {
  const TracedDeck traced(dragged);
  const Verdict verdict = verify(traced.model(), traced.record(), stored_files_of(traced.record()), "checkpoint");
  const CheckSummary* const balance = check_of(verdict, "work = energy stored + dissipated");
  ASSERT_NE(balance, nullptr);
  EXPECT_EQ(balance->count, 3);
  EXPECT_LT(balance->value, balance->bound);
  EXPECT_LT(balance->bound, 1e-2 * traced.record().points.back().dissipation.front());
  EXPECT_NE(check_of(verdict, "dissipation never falls"), nullptr);
}

TEST(EnergyBalance, WrongDissipationIsCaught) {
  const TracedDeck traced(dragged);
  const auto scaled = [](Record& record) {
    for (RecordPoint& point : record.points) point.dissipation.front() *= 1.01;
  };
  EXPECT_NE(first_failure(traced, scaled).find("friction dissipates −∫ T dw"), std::string::npos);
  const auto fallen = [](Record& record) { record.points.back().dissipation.front() *= 0.9; };
  EXPECT_NE(first_failure(traced, fallen).find("dissipation never falls"), std::string::npos);
}

// The stretch of a beam over a round prop falls while its contact goes on slipping, far from where it stuck.
TEST(EnergyBalance, FrictionOpposesSlipWhileTheStretchChanges) {
  const TracedDeck traced(
      title("A propped beam") + material("m", 1e4) + rectangle("s", 0.1, 0.05) +
      points({{"a", 0.0, 0.0}, {"b", 1.0, 0.0}}) + member("m", "a", "b", "elastica", 20) +
      supports({{"a", "x z rotation"}, {"b", "z"}}) + moving_contact +
      wall("prop",
           R"(side = "below"; profile = { type = "circle", centre = [0.45, -0.42], radius = 0.4 }; )" + rough(0.3)) +
      force("m:0.5", 0.2, -1.0) + force("b", -1.0, 0.0) + path(R"(branches = "primary")") +
      stage("press", "load.0", 0.02, -1.0, 0.5) + stage("push", "load.1", 0.02, -1.0, 0.6) +
      stage("pull", "load.1", -0.02, -1.2, 1.0) + stage("lift", "load.0", -0.02, -0.3, 1.0));
  test::expect_whole(traced);
}

}  // namespace arcwall::verify::energy_balance_test
