#include "apps/output/path_cubics.hpp"

namespace arcwall {

const std::optional<RecordRates>& leaving_rates(const RecordPoint& point) {
  return point.rates_after ? point.rates_after : point.rates;
}

std::optional<CubicStep> cubic_step(const Record& record, std::size_t i, std::optional<std::size_t> monitor) {
  const RecordPoint &from = record.points[i - 1], &to = record.points[i];
  const std::optional<RecordRates>&begin = leaving_rates(from), &end = to.rates;
  if (!begin || !end) return std::nullopt;
  const auto derivative = [&](const RecordRates& rates) {
    return Vec2((to.arc - from.arc) * Vec2(monitor ? rates.monitors[*monitor] : 1.0, rates.lambda));
  };
  const CubicStep step{.begin = derivative(*begin), .end = derivative(*end)};
  if (!step.begin.allFinite() || !step.end.allFinite()) return std::nullopt;
  return step;
}

}  // namespace arcwall
