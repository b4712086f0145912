#pragma once

#include <optional>
#include <vector>

#include "core/contact_mode.hpp"
#include "core/types.hpp"

namespace arcwall {

/// A contact that stands at a bound: it touches without a force, or the friction of its force is at the bound.
struct ContactAtBound {
  ContactMode mode = ContactMode::open;
  double friction = 0.0;    ///< coefficient μ [-]
  bool touches = false;     ///< without a force
  double slip_sense = 0.0;  ///< ±1: of one that does not touch, in which it slips; 0: it cannot but stick
};

/// The rates ṗ and Ṫ of contacts at bounds by those of their gaps and slips, ġ and ẏ, and of λ:
///
///     (ṗ, Ṫ) = A (ġ, ẏ) + b λ̇
///
/// Of k contacts p and g stand first, in their order, T and y behind them.
struct ContactRates {
  std::vector<ContactAtBound> contacts{};
  Matrix A{};
  Vector b{};
};

/// Returns what contacts do so that their rates fulfil 0 ≤ ġ ⊥ ṗ ≥ 0 where they touch, and the law of friction, with λ̇
/// of either sign. Found by complementary pivoting (Lemke 1965): what they do at first violates the law for λ̇ = 1, and
/// is relaxed by z; the piecewise linear path of solutions is followed to z = 0, one change of one contact after
/// another. Empty where it meets equations that are singular, or comes back.
std::optional<std::vector<ContactMode>> pivoted_modes(const ContactRates& rates);

}  // namespace arcwall
