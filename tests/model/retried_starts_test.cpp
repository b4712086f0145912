// Decks of a survey in which a step is tried again from its start on another mesh, with one contact point more. The
// path must go on from there as it came: in its direction, with the count of unstable directions just behind the start.
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "continuation/tracer.hpp"
#include "model/deck/reader.hpp"
#include "model/model.hpp"
#include "tests/support/deck_tables.hpp"

namespace arcwall::retried_starts_test {

using namespace test::tables;
namespace {

// Behind a limit point the other wall comes near.
const std::string behind_a_limit_point =
    title("mixed column, L/h 134, elastica, imperfections [2]") + material("steel", 2.1e+04, "nu = 0.3") +
    rectangle("s", 0.83, 0.21) +
    member("column", "left", "right", "elastica", 56, imperfection({{2, -0.19}}), "steel") +
    points({{"left", 0.0, 0.0}, {"right", 29.0, 0.0}}) + supports({{"left", "x z rotation"}, {"right", "z"}}) +
    force("right", -0.35, 0.0) + flat_wall("upper0", "above", 1.3) +
    wall("lower1", R"(side = "below"; profile = { type = "line", z = -1.3, slope = -0.012 })") +
    monitor("mid", "column:0.5", "z") + monitor("shortening", "right", "x", flipped) +
    path("step = 0.013; stop = { lambda = [-1.0, 11.0], shortening = [-5.8, 20.0] }");

// A contact point is inserted where the body is nearly parallel to the wall: the least gap, and all nodes of the mesh
// with it, move along the member much faster than the body moves.
const std::string along_the_wall =
    title("pinned column, L/h 41, classic, imperfections [1, 2]") + material("steel", 2.1e+04, "nu = 0.3") +
    rectangle("s", 0.575, 0.366) +
    member("column", "left", "right", "euler-bernoulli", 68, imperfection({{1, 0.00139}, {2, 0.004}}), "steel") +
    points({{"left", 0.0, 0.0}, {"right", 14.9, 0.0}}) + supports({{"left", "x z"}, {"right", "z"}}) +
    force("right", -2.21, 0.0) +
    wall("upper0", R"(side = "above"; profile = { type = "circle", centre = [8.82, 12.2], radius = 11.7 })") +
    wall("lower1", R"(side = "below"; profile = { type = "circle", centre = [5.82, -37.7], radius = 37.2 })") +
    monitor("mid", "column:0.5", "z") + monitor("shortening", "right", "x", flipped) +
    path("step = 0.05; stop = { lambda = [-1.0, 11.3], shortening = [-2.97, 10.4] }");

// On its way back from the wall the path passes by the straight column of the second buckling load, within some 1e-5 of
// it: a step may end on a branch that passes by, where lambda rises.
const std::string past_the_second_load =
    title("A nearly perfect clamped column on its way back from a wall") + material("steel", 2.1e4) +
    rectangle("s", 0.22, 0.048) + points({{"left", 0.0, 0.0}, {"right", 1.2, 0.0}}) +
    supports({{"left", "x z rotation"}, {"right", "z rotation"}}) + force("right", -1.2, 0.0) +
    flat_wall("lower", "below", -0.042) + monitor("mid", "column:0.5", "z") +
    path("step = 0.05; stop = { mid = [-1.0, 0.03], lambda = [-1.0, 11.0] }") +
    member("column", "left", "right", "elastica", 12, imperfection({{2, -6.4e-5}, {3, 8.8e-5}}), "steel");

std::vector<EventKind> kinds_of(const std::string& deck, const std::vector<std::string>& assignments) {
  const Model model(deck::read_deck_text(deck, "deck.toml", assignments));
  std::string reason;
  Tracer tracer(model.system(), model.start(reason).value(), model.options());
  std::vector<EventKind> kinds;
  while (const auto arc = tracer.next())
    for (const Event& event : arc->events) kinds.push_back(event.kind);
  EXPECT_EQ(tracer.end().value().reason, EndReason::stop) << tracer.end().value().detail;
  return kinds;
}

}  // namespace

// As with a first step of 0.05, with which no step is tried again at the limit point: no branch point there.
TEST(RetriedStarts, ALimitPointIsNoBranchPoint) {
  using enum EventKind;
  const std::vector<EventKind> expected{start,          contact_closes,      limit_point,
                                        contact_closes, contact_limit_point, contact_spreads};
  for (const char* step : {"path.step=0.013", "path.step=0.05"})
    EXPECT_EQ(kinds_of(behind_a_limit_point, {step}), expected) << step;
}

// lambda falls on, with every step, down to the bound; in the place of the second contact a limit point was found, and
// the path ran back to where it came from.
TEST(RetriedStarts, ThePathDoesNotTurnRound) {
  using enum EventKind;
  const std::vector<EventKind> expected{start,       contact_closes, limit_point,   contact_closes, contact_limit_point,
                                        limit_point, contact_opens,  contact_closes};
  for (const char* longest : {"path.max_step=0.2", "path.max_step=0.05"})
    EXPECT_EQ(kinds_of(along_the_wall, {longest, "path.stop.shortening=[-2.97, 4.6]"}), expected) << longest;
}

// A limit point and a unconfirmed branch point were found between the two branches, on neither, and the path ended
// there.
TEST(RetriedStarts, ABranchThatPassesByIsNotEntered) {
  using enum EventKind;
  const std::vector<EventKind> expected{start, contact_closes, limit_point, contact_opens};
  for (const char* longest : {"path.max_step=0.2", "path.max_step=0.02", "path.max_step=0.01"})
    EXPECT_EQ(kinds_of(past_the_second_load, {"path.step=0.005", longest}), expected) << longest;
}

}  // namespace arcwall::retried_starts_test
