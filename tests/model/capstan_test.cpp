#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "tests/model/friction_decks.hpp"

// A strip round a rough cylinder, EI = R = 1 and μ = 0.25, whose long legs two dead forces pull down: the capstan with
// bending (Singh 2022). It lifts off where 1 − cos ψ = EI/(2 F R²), with edge forces F sin ψ, and slips as a whole at
//
//     F₂ (cos ψ₂ ∓ μ sin ψ₂) = F₁ (cos ψ₁ ± μ sin ψ₁) exp(± μ (π − ψ₁ − ψ₂))
//
// With F₁ = 2 towards side 2 at 3.929972499949, towards side 1 at 1.090593058453; a flexible strip at 4.387 and 0.912.
namespace arcwall::capstan_test {

namespace {

using friction_test::run_of;

constexpr double towards_2 = 3.929972499949, towards_1 = 1.090593058453;

const std::string at_nodes = "points = \"nodes\"";

std::string compliant(double stiffness) {
  return fmt::format("method = \"compliant\"\nlaw = {{ stiffness = {} }}", stiffness);
}

// Of the parts that touch, 1.4 on each side of the top; the legs are 5 more.
double element_length(int elements) { return 1.4 / double(std::lround(0.3 * elements)); }

std::string member(const std::string& name, const std::string& from, const std::string& to, long elements) {
  return fmt::format(
      "[member.{}]\nfrom = \"{}\"\nto = \"{}\"\ntheory = \"elastica\"\nmaterial = \"m\"\nsection = \"s\"\n"
      "elements = {}\n",
      name, from, to, elements);
}

// A straight strip on top of the cylinder: both forces grow to 2, then the second changes until λ can go no further.
// The springs hold what nothing else does before anything is pressed; they bear 1e-5 at most.
std::string capstan(const std::string& contact, int elements, double sense) {
  const long half = std::lround(0.3 * elements), leg = std::lround(0.2 * elements);
  return fmt::format(R"(
[material.m]
E = 1e5
[section.s]
shape = "general"
A = 1.0
I = 1e-5
[point]
end1 = [-6.4, 0.0]
joint1 = [-1.4, 0.0]
top = [0.0, 0.0]
joint2 = [1.4, 0.0]
end2 = [6.4, 0.0]
[[spring]]
at = "top"
stiffness = {{ x = 1e-3, z = 1e-3, rotation = 1e-3 }}
[[load]]
at = "end1"
force = [0.0, -1.0]
[[load]]
at = "end2"
force = [0.0, -1.0]
[contact]
{}
[[wall]]
name = "cylinder"
members = ["half1", "half2"]
contact_surface = "axis"
outline = {{ type = "circle", centre = [0.0, -1.0], radius = 1.0 }}
friction = 0.25
[[stage]]
name = "load"
drives = ["load.0", "load.1"]
step = 0.05
stop = {{ lambda = [-1.0, 2.0] }}
[[stage]]
name = "pull"
drives = ["load.1"]
step = {}
stop = {{ lambda = [-1.5, 3.0], event = "{}" }}
)",
                     contact, 0.05 * sense, contact == at_nodes ? "contact-limit-point" : "limit-point") +
         member("leg1", "end1", "joint1", leg) + member("half1", "joint1", "top", half) +
         member("half2", "top", "joint2", half) + member("leg2", "joint2", "end2", leg);
}

// The second force at which the strip slips as a whole: the extreme value.
double limit(const std::string& contact, int elements, double sense = 1.0) {
  const Session run = run_of(capstan(contact, elements, sense));
  double most = -std::numeric_limits<double>::infinity();
  for (const RecordPoint& point : run.points())
    if (run.record().stage_number(point.branch) == 1) most = std::max(most, sense * point.lambda);
  EXPECT_EQ(run.record().branches.back().end->reason, EndReason::stop) << "the limit was passed";
  return 2.0 + sense * most;
}

}  // namespace

// The places where the strip lifts off are nodes: the limit oscillates with the mesh, by less than h².
TEST(Capstan, AtNodesSlipsAsAWhole) {
  EXPECT_NEAR(limit(at_nodes, 40), towards_2, element_length(40) * element_length(40));
  EXPECT_NEAR(limit(at_nodes, 40, -1.0), towards_1, element_length(40) * element_length(40));
}

TEST(Capstan, AtNodesTendsToTheClosedFormSlow) {
  for (const int elements : {50, 60, 80, 100, 140}) {
    const double h = element_length(elements);
    EXPECT_NEAR(limit(at_nodes, elements), towards_2, h * h) << elements;
    if (elements == 140) continue;  // takes its time
    EXPECT_NEAR(limit(at_nodes, elements, -1.0), towards_1, h * h) << elements;
  }
}

// On a compliant wall the mesh does not show. The pressure of an edge is spread over (EI/k)^¼, whose second power the
// limit is off by: half as much with four times the stiffness, or less.
TEST(Capstan, OnCompliantWallsTendsToTheRigidOne) {
  const double coarse = limit(compliant(250.0), 40) - towards_2, fine = limit(compliant(1000.0), 40) - towards_2;
  EXPECT_GT(fine, 0.0);
  EXPECT_LT(fine, 0.5 * coarse);
  EXPECT_NEAR(limit(compliant(1000.0), 80) - towards_2, fine, 1e-6);
}

TEST(Capstan, OnStifferWallsTendsToTheRigidOneSlow) {
  const double coarse = limit(compliant(1000.0), 80) - towards_2, fine = limit(compliant(4000.0), 80) - towards_2;
  EXPECT_GT(fine, 0.0);
  EXPECT_LT(fine, 0.5 * coarse);
  EXPECT_NEAR(limit(compliant(1000.0), 40, -1.0), towards_1, 0.5 * coarse);
}

}  // namespace arcwall::capstan_test
