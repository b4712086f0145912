#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace arcwall {

/// How the length of the next step is chosen.
struct StepOptions {
  double first = 0.02;  ///< increment of λ of the first predictor; its sign is the direction [-]
  double min = 1e-8;    ///< arc length below which the branch ends [path metric]
  double max = 0.2;     ///< of the structure's motion [path metric]
  double max_lambda = std::numeric_limits<double>::infinity();  ///< of the change of λ
  int wanted_iterations = 5;                                    ///< a step is scaled by wanted/used …
  double wanted_turn = 0.2;  ///< … and by wanted/seen turn of the tangent [rad], within [¼, 2]
  double max_turn = 0.6;     ///< a step over which the tangent turns more is not trusted [rad]
};

/// The length of the next step.
class StepControl {
 public:
  StepControl(const StepOptions& options, double first) : options_(options), length_(std::min(first, options.max)) {}

  double length() const { return length_; }
  bool too_short() const { return length_ < options_.min; }

  /// After a success: `iterations` of the corrector, `turn` of the tangent over a step of length `taken`.
  void succeeded(int iterations, double turn, double taken) {
    const double by_iterations = double(options_.wanted_iterations) / std::max(iterations, 1);
    const double by_turn = options_.wanted_turn / std::max(turn, 1e-12);
    const double factor = std::clamp(std::min(std::sqrt(by_iterations), by_turn), 0.25, 2.0);
    // A step cut by an event says nothing against the planned one.
    length_ = factor >= 1.0 ? std::max(length_, taken * factor) : std::max(taken, 0.5 * length_) * factor;
  }

  /// Before a step along the unit tangent: `motion` is the structure's part of it, in [0, 1], `lambda_rate` that of λ.
  /// A step is at most `max` long; where λ has the greater part, that is the structure's motion alone.
  void limit(double motion, double lambda_rate) {
    const double lambda_part = std::sqrt(std::max(0.0, 1.0 - motion * motion));
    if (motion > 0.0) length_ = std::min(length_, options_.max * std::max(1.0, lambda_part / motion));
    if (lambda_rate != 0.0) length_ = std::min(length_, options_.max_lambda / std::abs(lambda_rate));
  }

  void failed(double taken) { length_ = 0.5 * taken; }
  void restart(double length) { length_ = std::clamp(length, options_.min, options_.max); }

  /// Visits what changes, as Tracer::serialize().
  template <typename Archive>
  void serialize(Archive& archive) {
    archive(length_);
  }

 private:
  StepOptions options_;
  double length_;
};

}  // namespace arcwall
