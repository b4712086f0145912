#pragma once

namespace arcwall {

/// Stores a number that depends on λ: constant + λ · proportional.
struct Driven {
  double constant = 0.0;
  double proportional = 0.0;

  double at(double lambda) const { return constant + lambda * proportional; }
  bool is_zero() const { return constant == 0.0 && proportional == 0.0; }

  Driven& operator+=(const Driven& other) {
    constant += other.constant;
    proportional += other.proportional;
    return *this;
  }
  bool operator==(const Driven&) const = default;
};

}  // namespace arcwall
