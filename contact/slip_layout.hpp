#pragma once

#include <utility>
#include <vector>

#include "core/state.hpp"

namespace arcwall {

/// The history of material points that friction of compliant walls holds: what each was when it was committed last.
class SlipLayout final : public Layout {
 public:
  struct Point {
    double place = 0.0;                       ///< along the wall [length]
    double force = 0.0;                       ///< friction along the wall's tangent, on the structure [force]
    double most = 0.0;                        ///< its bound, μ times the force across the wall [force]
    double slip = 0.0;                        ///< since the wall was touched [length]
    double most_rate = 0.0, slip_rate = 0.0;  ///< along the path from there on
    int sense = 0;                            ///< of a slip that goes on, 1 or −1
    bool is_known = false;                    ///< false: the wall has not faced it yet

    template <typename Archive>
    void serialize(Archive& archive) {
      archive(place, force, most, slip, most_rate, slip_rate, sense, is_known);
    }
  };

  /// `dissipated`: since the start of the run, one a contact [force·length].
  SlipLayout(std::vector<Point> points, std::vector<double> dissipated)
      : points_(std::move(points)), dissipated_(std::move(dissipated)) {}

  const std::vector<Point>& points() const { return points_; }
  const std::vector<double>& dissipated() const { return dissipated_; }

 private:
  std::vector<Point> points_;
  std::vector<double> dissipated_;
};

}  // namespace arcwall
