#include "continuation/corners/contact_rates.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

// Modes found by pivoting against all combinations, each of which is solved and looked at by itself.
namespace arcwall::contact_rates_test {

namespace {

using enum ContactMode;

// The rates of one combination at λ̇ = ±1.
struct Rates {
  Vector g, y, p, T;
};

Rates rates_of(const ContactRates& rates, const std::vector<ContactMode>& modes, double lambda) {
  const auto k = static_cast<Index>(modes.size());
  Matrix equations = Matrix::Zero(2 * k, 2 * k);
  Vector rest = Vector::Zero(2 * k);
  for (Index i = 0; i < k; ++i) {
    const ContactMode mode = modes[static_cast<std::size_t>(i)];
    const double mu = rates.contacts[static_cast<std::size_t>(i)].friction;
    equations(i, i) = equations(k + i, k + i) = 1.0;
    if (mode == open) {
      equations.row(i) = rates.A.row(i);
      rest[i] = rates.b[i] * lambda;
    }
    if (mu == 0.0 || mode == sticks) continue;
    const double sense = slip_sense(mode);
    equations.row(k + i) = rates.A.row(k + i) + sense * mu * rates.A.row(i);
    rest[k + i] = (rates.b[k + i] + sense * mu * rates.b[i]) * lambda;
  }
  const Vector motion = equations.fullPivLu().solve(Vector(-rest)), force = rates.A * motion + rates.b * lambda;
  return {.g = motion.head(k), .y = motion.tail(k), .p = force.head(k), .T = force.tail(k)};
}

bool fulfil_law(const ContactRates& rates, const std::vector<ContactMode>& modes, double lambda) {
  constexpr double noise = 1e-9;
  const Rates of = rates_of(rates, modes, lambda);
  for (std::size_t j = 0; j < modes.size(); ++j) {
    const ContactAtBound& contact = rates.contacts[j];
    const auto i = static_cast<Index>(j);
    const double mu = contact.friction;
    if (modes[j] == open ? of.g[i] < -noise : contact.touches && of.p[i] < -noise) return false;
    if (slips(modes[j]) && slip_sense(modes[j]) * of.y[i] < -noise) return false;
    if (modes[j] != sticks) continue;
    for (const double sense : {1.0, -1.0})
      if ((contact.touches || contact.slip_sense == sense) && mu * of.p[i] + sense * of.T[i] < -noise) return false;
  }
  return true;
}

bool fulfil_law_in_a_sense(const ContactRates& rates, const std::vector<ContactMode>& modes) {
  return fulfil_law(rates, modes, 1.0) || fulfil_law(rates, modes, -1.0);
}

// Forces that resist motions: A is positive definite.
ContactRates resisted(std::mt19937& random, std::vector<ContactAtBound> contacts) {
  const auto n = 2 * static_cast<Index>(contacts.size());
  std::normal_distribution<double> normal;
  const Matrix R = Matrix::NullaryExpr(n, n, [&] { return normal(random); });
  return {.contacts = std::move(contacts),
          .A = R * R.transpose() + 0.1 * Matrix::Identity(n, n),
          .b = Vector::NullaryExpr(n, [&] { return normal(random); })};
}

ContactAtBound at_bound(ContactMode mode, double sense) {
  return {.mode = mode, .friction = 0.3, .touches = false, .slip_sense = sense};
}

}  // namespace

TEST(ContactRates, GoOnAsTheyDoWhereThatFulfilsTheLaw) {
  const ContactRates block{
      .contacts = {at_bound(slips_forward, 1.0)}, .A = Matrix::Identity(2, 2), .b = Vector(Eigen::Vector2d(0.0, -1.0))};
  EXPECT_EQ(pivoted_modes(block), std::vector{slips_forward});
}

// A block that is pushed beyond its bound slips, be it that a spring resists or that λ has to turn for equilibrium.
TEST(ContactRates, LetABlockSlipWhetherLambdaGoesOnOrTurns) {
  for (const double stiffness : {1.0, -1.0}) {
    const Matrix A = (Matrix(2, 2) << 1.0, 0.0, 0.0, stiffness).finished();
    const ContactRates block{.contacts = {at_bound(sticks, 1.0)}, .A = A, .b = Vector(Eigen::Vector2d(0.0, -1.0))};
    EXPECT_EQ(pivoted_modes(block), std::vector{slips_forward});
    EXPECT_TRUE(fulfil_law(block, {slips_forward}, stiffness));
    EXPECT_FALSE(fulfil_law(block, {slips_forward}, -stiffness));
  }
}

TEST(ContactRates, FulfilTheLawOfContactsAtTheirBounds) {
  std::mt19937 random(7);
  int changed = 0;
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<ContactAtBound> contacts;
    for (int i = 0; i < 6; ++i) {
      const double sense = random() % 2 == 0 ? 1.0 : -1.0;
      const ContactMode slip = sense > 0.0 ? slips_forward : slips_backward;
      contacts.push_back(at_bound(random() % 3 == 0 ? sticks : slip, sense));
    }
    const ContactRates rates = resisted(random, std::move(contacts));
    const auto modes = pivoted_modes(rates);
    ASSERT_TRUE(modes);
    EXPECT_TRUE(fulfil_law_in_a_sense(rates, *modes));
    for (std::size_t i = 0; i < modes->size(); ++i) changed += (*modes)[i] != rates.contacts[i].mode ? 1 : 0;
  }
  EXPECT_GT(changed, 300);
}

TEST(ContactRates, FulfilTheLawOfContactsThatTouch) {
  std::mt19937 random(8);
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<ContactAtBound> contacts;
    for (int i = 0; i < 5; ++i) {
      const bool is_rough = random() % 3 != 0;
      contacts.push_back({.mode = is_rough ? sticks : closed, .friction = is_rough ? 0.3 : 0.0, .touches = true});
    }
    ContactRates rates = resisted(random, std::move(contacts));
    for (Index i = 0; i < 5; ++i) {
      if (rates.contacts[static_cast<std::size_t>(i)].friction > 0.0) continue;
      rates.A.row(5 + i).setZero();
      rates.A.col(5 + i).setZero();
      rates.b[5 + i] = 0.0;
    }
    const auto modes = pivoted_modes(rates);
    ASSERT_TRUE(modes);
    EXPECT_TRUE(fulfil_law_in_a_sense(rates, *modes));
  }
}

// Contacts that move as one body come to rest together.
TEST(ContactRates, StopTogether) {
  constexpr Index k = 12;
  std::vector<ContactAtBound> contacts(k, at_bound(slips_forward, 1.0));
  contacts.push_back(at_bound(sticks, -1.0));
  const Index n = k + 1;
  Matrix A = Matrix::Zero(2 * n, 2 * n);
  for (Index i = 0; i < n; ++i) {
    A(i, i) = 1.0;
    A(n + i, n + i) = i == 0 || i == n - 1 ? 1e6 + 1.0 : 2e6;
    if (i > 0) A(n + i, n + i - 1) = A(n + i - 1, n + i) = -1e6;
  }
  Vector b = Vector::Zero(2 * n);
  b[2 * n - 1] = 1.0;
  const ContactRates rates{.contacts = contacts, .A = A, .b = b};
  const auto modes = pivoted_modes(rates);
  ASSERT_TRUE(modes);
  EXPECT_TRUE(fulfil_law_in_a_sense(rates, *modes));
}

}  // namespace arcwall::contact_rates_test
