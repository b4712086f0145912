// Mechanisms that what is constant stiffens: a straight cable of two bars that is stretched, and then loaded across.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <string>

#include "tests/model/traced_session.hpp"

namespace arcwall::stiffened_mechanisms_test {
namespace {

using test::traced;

constexpr double EA = 2e6, half = 1000.0;

std::string cable(const std::string& right, const std::string& constants) {
  return fmt::format(R"toml(
title = "A cable"
units = {{ length = "mm", force = "N" }}
material.s = {{ E = 2.0e5, expansion = 1e-5 }}
section.r = {{ shape = "general", A = 10.0, I = 1.0 }}
point = {{ l = [0.0, 0.0], t = [1000.0, 0.0], r = [2000.0, 0.0] }}
support = {{ l = ["x", "z"], r = [{}] }}
[member.p]
from = "l"
to = "t"
theory = "truss"
strain = "engineering"
material = "s"
section = "r"
elements = 1
[member.q]
from = "t"
to = "r"
theory = "truss"
strain = "engineering"
material = "s"
section = "r"
elements = 1
[[load]]
at = "t"
force = [0.0, -400.0]
[[monitor]]
name = "sag"
at = "t"
component = "z"
sign = -1
[path]
step = 0.05
stop = {{ lambda = [-0.1, 1.0] }}
{})toml",
                     right, constants);
}

// How far the middle of a cable moves under P, whose halves are stretched to a length: 2 N sin α = P.
double sag(double stretched, double P) {
  const auto rest = [&](double d) {
    const double length = std::hypot(stretched, d);
    return 2.0 * EA * (length / half - 1.0) * d / length - P;
  };
  boost::uintmax_t most = 100;
  const auto [low, high] =
      boost::math::tools::toms748_solve(rest, 0.0, 500.0, boost::math::tools::eps_tolerance<double>(48), most);
  return 0.5 * (low + high);
}

}  // namespace

TEST(StiffenedMechanisms, AStretchedCableCarriesALoadAcross) {
  const auto session = traced(cable(R"("z")", "[[prescribed]]\nat = \"r\"\nx = 2.0\nconstant = true\n"));
  ASSERT_EQ(session.record().branches.front().end->reason, EndReason::stop);
  for (const RecordPoint& point : session.record().points)
    EXPECT_NEAR(point.monitors[0], sag(half + 1.0, 400.0 * point.lambda), 1e-7) << point.lambda;
}

TEST(StiffenedMechanisms, WhatStiffensNothingIsAMechanismStill) {
  std::string slack = cable(R"("x", "z")", "[[load]]\nat = \"t\"\nforce = [1.0, 0.0]\nconstant = true\n");
  std::string reason;
  EXPECT_FALSE(Model(deck::read_deck_text(slack, "deck.toml", {})).start(reason).has_value());
  EXPECT_EQ(reason.find("the structure is a mechanism, which can move without strain"), 0u) << reason;
}

}  // namespace arcwall::stiffened_mechanisms_test
