// Jumps of a small part of a structure, against the closed form of a bar that snaps through.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/apps/traced_deck.hpp"

namespace arcwall::local_jumps_test {
namespace {

using test::TracedDeck;

constexpr double half_span = 10.0;

// A bar of EA over a half-span, risen by h₀, with a spring of stiffness k beside it. Squeezed to a rise h it carries
// λ = c h (h₀² − h²) + k (h₀ − h), c = EA/(2 L³), by Green's strain.
struct Cell {
  double h0 = 1.0, EA = 1e4, k = 0.1;

  double c() const { return EA / (2.0 * std::pow(half_span * half_span + h0 * h0, 1.5)); }
  double load(double h) const { return c() * h * (h0 * h0 - h * h) + k * (h0 - h); }
  double energy(double h) const {
    const double strained = h * h - h0 * h0, closed = h0 - h;
    return 0.25 * c() * strained * strained + 0.5 * k * closed * closed;
  }
  double rise_at_snap() const { return std::sqrt((h0 * h0 - k / c()) / 3.0); }

  // At a load, before the snap or after it: the load decreases with h there.
  double rise(double at, bool snapped) const {
    double low = snapped ? -20.0 * h0 : rise_at_snap(), high = snapped ? -rise_at_snap() : h0;
    for (int i = 0; i < 200; ++i) {
      const double h = 0.5 * (low + high);
      (load(h) > at ? low : high) = h;
    }
    return 0.5 * (low + high);
  }
};

// Cells on each other, pressed at the top. `far`: of the ground below them, to which a stiff bar leads.
std::string stack(const std::vector<Cell>& cells, double far, const std::string& path) {
  std::string points = "p0 = [0.0, 0.0]\n", supports = far > 0.0 ? "p0 = [\"x\"]\n" : "p0 = [\"x\", \"z\"]\n", members,
              springs, monitors, sections;
  double height = 0.0;
  for (std::size_t i = 1; i <= cells.size(); ++i) {
    const Cell& cell = cells[i - 1];
    height += cell.h0;
    points += fmt::format("p{} = [{}, {}]\n", i, i % 2 == 0 ? 0.0 : half_span, height);
    supports += fmt::format("p{} = [\"x\"]\n", i);
    sections += fmt::format("section.s{} = {{ shape = \"general\", A = {}, I = 1.0 }}\n", i, cell.EA);
    members += fmt::format(
        "[member.bar{0}]\nfrom = \"p{1}\"\nto = \"p{0}\"\ntheory = \"truss\"\nstrain = \"green\"\nelements = 1\n"
        "material = \"m\"\nsection = \"s{0}\"\n",
        i, i - 1);
    springs += fmt::format("[[spring]]\nbetween = [\"p{}\", \"p{}\"]\nstiffness = {{ z = {} }}\n", i - 1, i, cell.k);
    monitors += fmt::format("[[monitor]]\nname = \"z{0}\"\nat = \"p{0}\"\ncomponent = \"z\"\n", i);
  }
  if (far > 0.0) {
    points += fmt::format("ground = [0.0, {}]\n", -far);
    supports += "ground = [\"x\", \"z\"]\n";
    sections += "section.stiff = { shape = \"general\", A = 1e12, I = 1.0 }\n";
    members +=
        "[member.down]\nfrom = \"ground\"\nto = \"p0\"\ntheory = \"truss\"\nstrain = \"green\"\nelements = 1\n"
        "material = \"m\"\nsection = \"stiff\"\n";
  }
  return "title = \"Cells\"\nmaterial.m = { E = 1.0 }\n" + sections +
         fmt::format("load = [{{ at = \"p{}\", force = [0.0, -1.0] }}]\n[point]\n", cells.size()) + points +
         "[support]\n" + supports + members + springs + monitors + "[path]\njumps = true\n" + path;
}

// Expects a jump at the load at which cell `snaps` does, to the state in which it and the cells `snapped` before have.
void expect_jump(const RecordJump* jump, const std::vector<Cell>& cells, std::size_t snaps,
                 const std::vector<std::size_t>& snapped) {
  ASSERT_NE(jump, nullptr);
  ASSERT_EQ(jump->reason, "") << jump->why;
  const Cell& lost = cells[snaps];
  const double load = lost.load(lost.rise_at_snap());
  double moved = 0.0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const bool down = i == snaps || std::find(snapped.begin(), snapped.end(), i) != snapped.end();
    moved += cells[i].rise(load, down) - cells[i].h0;
    EXPECT_NEAR(jump->monitors[i], moved, 1e-6 * lost.h0) << i;
  }
  const double before = lost.rise_at_snap(), after = lost.rise(load, true);
  const double released = lost.energy(before) - lost.energy(after) + load * (before - after);
  EXPECT_NEAR(jump->energy_released, released, 1e-6 * released);
}

std::vector<const RecordJump*> jumps_of(const TracedDeck& traced) {
  std::vector<const RecordJump*> found;
  for (const RecordEvent& event : traced.record().events)
    if (event.jump) found.push_back(event.jump.get());
  return found;
}

TEST(LocalJump, OfACellOnALargerOne) {
  for (const bool below : {true, false}) {
    const Cell small{.h0 = 0.2, .EA = 1e6, .k = 0.5}, large{.h0 = 4.0, .EA = 1e4, .k = 0.3};
    const std::vector<Cell> cells = below ? std::vector{small, large} : std::vector{large, small};
    const TracedDeck traced(stack(cells, 0.0, "step = 0.1\nstop.lambda = [-50.0, 10.0]\n"));
    const auto jumps = jumps_of(traced);
    ASSERT_FALSE(jumps.empty());
    expect_jump(jumps.front(), cells, below ? 0 : 1, {});
  }
}

TEST(LocalJump, DoesNotDependOnTheSizeOfTheStructure) {
  for (const double far : {0.0, 1e2, 1e4}) {
    const std::vector<Cell> cells{{.h0 = 1.0, .EA = 1e4, .k = 0.1}};
    const TracedDeck traced(stack(cells, far, "step = 0.1\nstop.lambda = [-5.0, 2.5]\n"));
    const auto jumps = jumps_of(traced);
    ASSERT_FALSE(jumps.empty()) << far;
    expect_jump(jumps.front(), cells, 0, {});
  }
}

// A staircase: each of forty cells snaps alone, the softest first.
TEST(LocalJump, OfFortyCellsOneAfterTheOther) {
  std::vector<Cell> cells;
  for (int i = 0; i < 40; ++i) cells.push_back({.k = 0.1 + 0.025 * i});
  const TracedDeck traced(stack(cells, 0.0, "step = 0.1\nbranches = \"jump\"\nstop.lambda = [-5.0, 3.0]\n"));
  const auto jumps = jumps_of(traced);
  ASSERT_EQ(jumps.size(), cells.size());
  std::vector<std::size_t> snapped;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    expect_jump(jumps[i], cells, i, snapped);
    snapped.push_back(i);
  }
}

TEST(LocalJump, IsNotToldWhereEqualCellsLoseTheirStabilityTogether) {
  const TracedDeck traced(stack(std::vector<Cell>(5), 0.0, "step = 0.1\nstop.lambda = [-5.0, 3.0]\n"));
  const auto jumps = jumps_of(traced);
  ASSERT_FALSE(jumps.empty());
  EXPECT_EQ(jumps.front()->reason, "not_found");
  EXPECT_NE(jumps.front()->why.find("several modes"), std::string::npos) << jumps.front()->why;
}

}  // namespace
}  // namespace arcwall::local_jumps_test
