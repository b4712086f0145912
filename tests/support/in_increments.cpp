#include "tests/support/in_increments.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace arcwall::test {

InIncrements::InIncrements(std::unique_ptr<Structure> structure, const std::vector<TestWall>& walls,
                           const ContactLaw& law)
    : described_(std::move(structure)), present_(*described_) {
  contact_ = std::make_unique<MultiplierContact>(present_, candidates(*described_, walls),
                                                 ContactScales{.length = 2.0, .force = 1.0}, law);
  const Index n = described_->size({});
  scheme_ = std::make_unique<LoadIncrements>(
      *contact_, State{.x = Vector::Zero(n), .active_set = contact_->open_active_set()}, 1.0,
      [this, n](const State& state) { present_.advance({.x = state.x.head(n), .lambda = state.lambda}); });
  last_ = scheme_->start().to;
}

void InIncrements::load_to(double lambda, double step) {
  const double from = last_.state.lambda;
  const int count = static_cast<int>(std::ceil((lambda - from) / step - 1e-9));
  for (int i = 1; i <= count; ++i) ASSERT_NO_FATAL_FAILURE(go_to(from + (lambda - from) * i / count));
}

void InIncrements::relax(int increments) {
  const double lambda = last_.state.lambda;
  for (int i = 0; i < increments; ++i) ASSERT_NO_FATAL_FAILURE(go_to(lambda));
}

double InIncrements::force() const { return last_.state.x.tail(last_.state.active_set.closed_count()).sum(); }

double InIncrements::z_of(std::size_t node, double offset) const {
  return MemberPoint(*described_, described_->members()[0], node, offset).position(last_.state).y() - offset;
}

void InIncrements::go_to(double lambda) {
  const auto arc = scheme_->to(lambda);
  ASSERT_TRUE(arc) << "the increment to " << lambda << " fails";
  last_ = arc->to;
}

}  // namespace arcwall::test
