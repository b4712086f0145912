// Where structures fall to, against a slow motion of another step rule among walls that are stiff springs; and what is
// lost in a loop, against the work of the load around it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "answers/sessions.hpp"
#include "core/algebra/factorization.hpp"
#include "core/linearization.hpp"
#include "model/deck_mesh.hpp"
#include "tests/apps/deck_texts.hpp"
#include "tests/apps/traced_deck.hpp"

namespace arcwall::jump_motion_test {
namespace {

using test::TracedDeck;
using Assignments = std::vector<std::string>;

// Closed where a node is inside a wall, open elsewhere.
State with_contacts_where_inside(const UnilateralSystem& system, const State& state) {
  const Vector guards = system.guards(state);
  ActiveSet active_set = state.active_set;
  for (std::size_t j = 0; j < active_set.size(); ++j)
    if (guards[static_cast<Index>(j)] < 0.0) active_set[j] = active_set[j] != 0 ? 0 : 1;
  return system.with_active_set(state, active_set);
}

// μ W ẋ = −F at fixed λ by steps of one Newton iteration each, no longer than a hundredth; μ doubles while K + μ W has
// negative eigenvalues and else falls by a tenth.
State slow_motion(const UnilateralSystem& system, State state) {
  constexpr double longest = 0.01, at_rest = 1e-11;
  Linearization at;
  const auto solver = make_ldlt();
  double mu = 1.0;
  for (int step = 0; step < 20000; ++step) {
    state = with_contacts_where_inside(system, state);
    const Vector weights = system.weights(state.active_set);
    const Index multipliers = system.multiplier_count(state.active_set);
    for (;; mu *= 2.0) {
      system.linearize(state, at);
      for (Index i = 0; i < weights.size(); ++i) at.K.coeffRef(i, i) += mu * weights[i];
      const bool factored = solver->factorize(at.K, {.multipliers = multipliers}) == FactorStatus::ok;
      if (factored && solver->inertia() && solver->inertia()->negative == multipliers) break;
      if (mu > 1e12) throw std::runtime_error("no step is convex");
    }
    Matrix dx = -at.F;
    solver->solve(dx);
    const double length = std::sqrt((weights.array() * dx.col(0).array().square()).sum());
    state.x += std::min(1.0, longest / length) * dx.col(0);
    if (length < at_rest) return state;
    mu *= 0.9;
  }
  throw std::runtime_error("no rest");
}

struct Problem {
  std::string name, deck;
  Assignments assignments{};
  double tolerance = 1e-8;  // of monitors, by the size of the structure
};

std::ostream& operator<<(std::ostream& out, const Problem& problem) { return out << problem.name; }

const std::string bars_above_a_stop = test::low_truss + R"toml([[wall]]
name = "stop"
side = "below"
contact_surface = "axis"
profile = { type = "flat", z = -0.5 }
[path]
step = 0.3
jumps = true
stop = { lambda = [-5.0, 5.0] }
)toml";

// With walls nodes touch where the path has contact between them, and springs give way.
std::vector<Problem> problems() {
  constexpr double of_nodes = 0.02;
  const std::string channel(test::example("channel")), arch(test::example("arch"));
  const auto jump = [](Assignments more = {}) {
    more.emplace_back("path.jumps=true");
    return more;
  };
  return {
      {"ShallowArch", arch, jump()},
      {"TwoBars", std::string(test::example("truss")), jump()},
      {"Lee", std::string(test::example("lee")), jump()},
      {"TwoBarsOnAStop", bars_above_a_stop, {}, 1e-5},
      {"Channel", channel, jump(), of_nodes},
      {"NarrowerChannel", channel, jump({"wall.upper.profile.z=0.19"}), of_nodes},
      {"ArchOnALowFloor", test::arch_above_a_floor("-0.08"), {}, 1e-5},
      {"ArchOnAFloor", test::arch_above_a_floor("-0.06"), {}, 1e-5},
      {"ArchPressedOnAFloor", test::arch_above_a_floor("-0.02"), {}, 1e-3},
      {"ArchAlongAFloor", test::arch_above_a_floor("0.0"), {}, 1e-3},
  };
}

class FallenStructure : public testing::TestWithParam<Problem> {};

}  // namespace

TEST_P(FallenStructure, IsWhereASlowMotionAmongSpringsEnds) {
  const Problem& problem = GetParam();
  const TracedDeck traced(problem.deck, problem.assignments);
  int fallen = 0;
  for (const RecordEvent& event : traced.record().events) {
    if (!event.jump || !event.jump->reason.empty()) continue;
    ++fallen;
    // The same deck with its contact at nodes and walls that give way.
    Assignments assignments = problem.assignments;
    if (traced.model().contact() != nullptr)
      for (const char* set : {"contact.method=\"penalty\"", "contact.penalty=1e7"}) assignments.emplace_back(set);
    const Session soft = make_session({.deck = "deck.toml", .deck_text = problem.deck, .assignments = assignments});
    const DeckMesh mesh(traced.model()), soft_mesh(soft.model());
    const auto& points = traced.record().points;
    const auto at = std::find_if(points.begin(), points.end(), [&](const RecordPoint& point) {
      return point.branch == event.branch && point.step == event.step;
    });
    const Vector here = mesh.unknowns(at->state), behind = mesh.unknowns((at + 1)->state) - here;
    const double far = mesh.distance(behind, Vector::Zero(behind.size()));
    const ActiveSet active_set = soft.model().contact() ? soft.model().contact()->open_active_set() : ActiveSet();
    State start{
        .x = Vector::Zero(soft_mesh.system().size(active_set)), .lambda = event.lambda, .active_set = active_set};
    start.x.head(here.size()) = here + std::max(1.0, 0.03 / far) * behind;
    const State rest = slow_motion(soft_mesh.system(), start);

    for (std::size_t m = 0; m < traced.model().monitors().size(); ++m) {
      // As soft() reads it: its states have the deck's mesh.
      const double found = soft.model().monitors()[m].quantity->value(rest);
      const double size = traced.model().structure().length_scale();
      EXPECT_NEAR(found, event.jump->monitors[m], problem.tolerance * size)
          << traced.model().monitors()[m].name << " of event " << event.id;
    }
  }
  EXPECT_GT(fallen, 0);
}

INSTANTIATE_TEST_SUITE_P(Problems, FallenStructure, testing::ValuesIn(problems()),
                         [](const auto& problem) { return problem.param.name + "Slow"; });

namespace {

constexpr std::array<std::pair<double, double>, 8> gauss{{{0.0950125098376374, 0.1894506104550685},
                                                          {0.2816035507792589, 0.1826034150449236},
                                                          {0.4580167776572274, 0.1691565193950025},
                                                          {0.6178762444026438, 0.1495959888165767},
                                                          {0.7554044083550030, 0.1246289712555339},
                                                          {0.8656312023878318, 0.0951585116824928},
                                                          {0.9445750230732326, 0.0622535239386479},
                                                          {0.9894009349916499, 0.0271524594117541}}};

// A value of λ and what it counts in an integral over λ.
struct Place {
  double lambda, weight;
};

// Gauss' rule with 16 points in t, λ = (a + b)/2 − (b − a)/2 cos πt: what q does at limit points goes with the root of
// the distance in λ, and is smooth in t.
std::vector<Place> places_between(double a, double b) {
  constexpr double pi = 3.141592653589793;
  std::vector<Place> places;
  for (const auto& [node, weight] : gauss)
    for (const double sign : {-1.0, 1.0}) {
      const double t = 0.5 * (1.0 + sign * node), half = 0.5 * (b - a);
      places.push_back(
          {.lambda = 0.5 * (a + b) - half * std::cos(pi * t), .weight = 0.5 * weight * half * pi * std::sin(pi * t)});
    }
  return places;
}

// Of a record, the points of the branch on the way to the fall and of the one that is fallen to, between the two λ of
// the loop.
struct Sides {
  std::vector<const RecordPoint*> left, reached;
};

Sides sides(const Record& record, const RecordEvent& event) {
  const RecordJump& jump = *event.jump;
  Sides found;
  for (const RecordPoint& point : record.points) {
    if (point.lambda < jump.on_return->lambda || point.lambda > event.lambda || point.count.unstable != 0) continue;
    if (point.branch == event.branch && point.arc < event.arc) found.left.push_back(&point);
    if (point.branch == *jump.on_branch && point.arc > event.arc) found.reached.push_back(&point);
  }
  return found;
}

// q = −∂Π/∂λ; the potential of dead loads is linear in λ.
double conjugate(const TracedDeck& traced, const RecordPoint& point) {
  const double h = std::max(1.0, std::abs(point.lambda));
  State more = point.state, less = point.state;
  more.lambda += h;
  less.lambda -= h;
  const System& system = traced.model().system();
  return (system.energy(less) - system.energy(more)) / (2.0 * h);
}

double at(const TracedDeck& traced, const std::vector<const RecordPoint*>& side, double lambda) {
  for (const RecordPoint* const point : side)
    if (point->lambda == lambda) return conjugate(traced, *point);
  throw std::runtime_error("no point was landed on");
}

std::vector<Problem> loops() {
  const std::string channel(test::example("channel"));
  const Assignments jump{"path.jumps=true"};
  const auto with = [&](const char* more) { return Assignments{"path.jumps=true", more}; };
  const Assignments lower{"member.arch.sine.rise=0.08"};
  return {{"Channel", channel, jump},
          {"WiderChannel", channel, with("wall.upper.profile.z=0.21")},
          {"HardlyWiderChannel", channel, with("wall.upper.profile.z=0.205")},
          {"ArchThatMeetsNoFloor", test::arch_above_a_floor("-0.3"), {}},
          {"ArchOnALowFloor", test::arch_above_a_floor("-0.08"), {}},
          {"ArchOnAFloor", test::arch_above_a_floor("-0.06"), {}},
          {"ArchPressedOnAFloor", test::arch_above_a_floor("-0.02"), {}},
          {"ArchAlongAFloor", test::arch_above_a_floor("0.0"), {}},
          {"LowerArchThatMeetsNoFloor", test::arch_above_a_floor("-0.3"), lower},
          {"LowerArchPressedOnAFloor", test::arch_above_a_floor("-0.02"), lower}};
}

class HysteresisLoop : public testing::TestWithParam<Problem> {};

}  // namespace

// ∮ q dλ around the loop: q of the branch that is fallen to less q of the one that is left, from event to event, as q
// has kinks where contacts change.
TEST_P(HysteresisLoop, LosesTheWorkOfTheLoad) {
  const Problem& problem = GetParam();
  const TracedDeck first(problem.deck, problem.assignments);
  const auto& events = first.record().events;
  const auto falls = std::find_if(events.begin(), events.end(), [](const RecordEvent& event) {
    return event.jump && event.jump->energy_dissipated && event.jump->on_branch;
  });
  ASSERT_NE(falls, events.end());
  const double top = falls->lambda, bottom = falls->jump->on_return->lambda;
  const double least = 1e-6 * (top - bottom);
  std::vector<double> ends{bottom, top};
  for (const RecordEvent& event : events)
    if (event.lambda > bottom + least && event.lambda < top - least) ends.push_back(event.lambda);
  std::sort(ends.begin(), ends.end());
  std::vector<Place> places;
  std::string land;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    if (ends[i + 1] - ends[i] < least) continue;
    for (const Place& place : places_between(ends[i], ends[i + 1])) {
      places.push_back(place);
      char text[40];
      std::snprintf(text, sizeof text, "%.17g", place.lambda);
      land += (land.empty() ? "" : ", ") + std::string(text);
    }
  }
  Assignments dense_assignments = problem.assignments;
  dense_assignments.push_back("path.output_at.lambda=[" + land + "]");
  const TracedDeck dense(problem.deck, dense_assignments);
  const RecordEvent& same = dense.record().events.at(static_cast<std::size_t>(falls->id));
  ASSERT_TRUE(same.jump && same.jump->on_branch);
  const Sides found = sides(dense.record(), same);
  double area = 0.0;
  for (const Place& place : places)
    area += place.weight * (at(dense, found.reached, place.lambda) - at(dense, found.left, place.lambda));
  EXPECT_NEAR(area / *falls->jump->energy_dissipated, 1.0, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Problems, HysteresisLoop, testing::ValuesIn(loops()),
                         [](const auto& problem) { return problem.param.name + "Slow"; });

}  // namespace arcwall::jump_motion_test
