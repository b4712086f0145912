#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace arcwall {

/// Options of the step length.
struct StepOptions {
  double first = 0.02;  ///< increment of λ of the first predictor; its sign is the direction [-]
  double min = 1e-8;    ///< arc length below which the branch ends [path metric]
  double max = 0.2;     ///< largest motion of the structure in a step [path metric]
  double max_lambda = std::numeric_limits<double>::infinity();  ///< largest change of λ in a step [-]
  int wanted_iterations = 5;                                    ///< a step is scaled by wanted/used …
  double wanted_turn = 0.2;  ///< … and by wanted/seen turn of the tangent [rad], within [¼, 2]
  double max_turn = 0.6;     ///< a step with a larger tangent angle is rejected [rad]
};

/// Controls the length of the next step [path metric].
class StepControl {
 public:
  StepControl(const StepOptions& options, double first) : options_(options), length_(std::min(first, options.max)) {}

  double length() const { return length_; }
  bool too_short() const { return length_ < options_.min; }

  /// Adapts the length after an accepted step: corrector iterations, tangent angle [rad], length `taken`.
  void succeeded(int iterations, double turn, double taken) {
    const double by_iterations = double(options_.wanted_iterations) / std::max(iterations, 1);
    const double by_turn = options_.wanted_turn / std::max(turn, 1e-12);
    const double factor = std::clamp(std::min(std::sqrt(by_iterations), by_turn), 0.25, 2.0);
    // A step cut by an event says nothing against the planned one.
    length_ = factor >= 1.0 ? std::max(length_, taken * factor) : std::max(taken, 0.5 * length_) * factor;
  }

  /// Limits the length before a step along the unit tangent. `motion`: norm of its part in x, in [0, 1]; `lambda_rate`:
  /// dλ. `max` limits the step, or its motion alone if the part of λ is larger.
  void limit(double motion, double lambda_rate) {
    const double lambda_part = std::sqrt(std::max(0.0, 1.0 - motion * motion));
    if (motion > 0.0) length_ = std::min(length_, options_.max * std::max(1.0, lambda_part / motion));
    if (lambda_rate != 0.0) length_ = std::min(length_, options_.max_lambda / std::abs(lambda_rate));
  }

  void failed(double taken) { length_ = 0.5 * taken; }
  void restart(double length) { length_ = std::clamp(length, options_.min, options_.max); }

  /// Writes or reads the length, as Tracer::serialize().
  template <typename Archive>
  void serialize(Archive& archive) {
    archive(length_);
  }

 private:
  StepOptions options_;
  double length_;
};

}  // namespace arcwall
