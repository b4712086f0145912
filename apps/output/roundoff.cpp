#include "apps/output/roundoff.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

namespace arcwall {

// Of a column of round-off alone only its unit tells the size. A rotation of 1 is a large one.
std::vector<double> roundoff(const Record& record) {
  constexpr double part = 1e-12;
  std::vector<double> own;
  std::map<std::string, double> of_unit{{"rad", 1.0}};
  for (std::size_t i = 0; i < record.columns.size(); ++i) {
    double& greatest = own.emplace_back(0.0);
    for (const RecordPoint& point : record.points)
      if (std::isfinite(point.monitors[i])) greatest = std::max(greatest, std::abs(point.monitors[i]));
    double& common = of_unit[record.columns[i].unit];
    common = std::max(common, greatest);
  }
  for (std::size_t i = 0; i < own.size(); ++i)
    own[i] = std::max(part * (record.columns[i].unit.empty() ? own[i] : of_unit[record.columns[i].unit]),
                      record.columns[i].roundoff);
  return own;
}

double without_roundoff(double value, double roundoff) { return std::abs(value) <= roundoff ? 0.0 : value; }

}  // namespace arcwall
