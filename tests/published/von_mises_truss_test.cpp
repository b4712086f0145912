#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/invariants.hpp"
#include "tests/support/models.hpp"

// Two bars of half span b = 10 and rise h = 1, apex load P = λ, v the descent of the apex. With z = h − v, l² = b² +
// z², L the length at rest, the limit loads over EA are
//
//   Green         z² = h²/3:                        P = 2 h³ / (3√3 L³)
//   engineering   l³ = b² L:                        P = 2 (1 − (b/L)^(2/3))^(3/2)
//   logarithmic   z² + (b² − z²) ln(l/L) = 0:       P = −2 L ln(l/L) z / l²
namespace arcwall {

namespace {

using test::trace;

struct Limit {
  TrussStrain strain;
  double load, descent;
};

// The closed forms to 20 digits.
const Limit limits[] = {{TrussStrain::green, 0.00037919801295143635767, 0.42264973081037423549},
                        {TrussStrain::engineering, 0.00038108719041809789404, 0.4236074651689875275},
                        {TrussStrain::log, 0.00038298928854153894156, 0.42456395665616353628}};

}  // namespace

TEST(VonMisesTruss, LimitLoadsMatchTheClosedFormsForAllStrains) {
  for (const Limit& expected : limits) {
    SCOPED_TRACE(static_cast<int>(expected.strain));
    constexpr double EA = 1e4;
    const auto truss = test::VonMisesTruss{.EA = EA, .strain = expected.strain}.structure();
    const auto w = test::displacement(*truss, 1, Freedom::z);
    TraceOptions options;
    options.landmarks.push_back({.quantity = w, .value = -2.3, .stops = true, .label = "w"});
    const test::Branch branch = trace(*truss, options, std::vector<Watch>{{.quantity = w, .label = "w"}});

    const auto found = events_of(branch, EventKind::limit_point);
    ASSERT_EQ(found.size(), 2U);
    EXPECT_NEAR(found[0].state.lambda, EA * expected.load, 1e-11 * EA * expected.load);
    // λ is level there: displacements are sure to about the root of that.
    EXPECT_NEAR(w->value(found[0].state), -expected.descent, 1e-8);
    EXPECT_NEAR(found[1].state.lambda, -EA * expected.load, 1e-11 * EA * expected.load);  // the mirror image
    EXPECT_EQ(found[0].unstable_before, 0);
    EXPECT_EQ(found[0].unstable_after, 1);
    EXPECT_EQ(found[1].unstable_after, 0);
    EXPECT_TRUE(events_of(branch, EventKind::displacement_limit).empty());
    expect_branch_invariants(*truss, branch, options);
  }
}

// Green: λ = EA z (h² − z²) / L³ all along the path.
TEST(VonMisesTruss, ThePathIsTheClosedForm) {
  const auto truss = test::VonMisesTruss{.EA = 1.0}.structure();
  const auto w = test::displacement(*truss, 1, Freedom::z);
  TraceOptions options;
  options.landmarks.push_back({.quantity = w, .value = -2.25, .stops = true, .label = "w"});
  const test::Branch branch = trace(*truss, options);
  const double L = std::sqrt(101.0);
  for (const Arc& arc : branch.arcs) {
    const double z = 1.0 + w->value(arc.to.state);
    EXPECT_NEAR(arc.to.state.lambda, z * (1.0 - z * z) / (L * L * L), 1e-14);
  }
  EXPECT_NEAR(branch.last().state.lambda, 0.00069270843996673129803, 1e-14);
}

// A steep truss, b = 1, h = 5, which may not sway: its limit comes at the same formula.
TEST(VonMisesTruss, ASteepTrussThatCannotSwayHasTheSameFormula) {
  const auto truss = test::VonMisesTruss{.EA = 1.0, .half_span = 1.0, .rise = 5.0, .sways = false}.structure();
  const auto w = test::displacement(*truss, 1, Freedom::z);
  TraceOptions options;
  options.landmarks.push_back({.quantity = w, .value = -5.0, .stops = true, .label = "w"});
  const test::Branch branch = trace(*truss, options);
  const double expected = 2.0 * 125.0 / (3.0 * std::sqrt(3.0) * std::pow(26.0, 1.5));
  EXPECT_NEAR(only_event(branch, EventKind::limit_point).state.lambda, expected, 1e-11 * expected);
}

}  // namespace arcwall
