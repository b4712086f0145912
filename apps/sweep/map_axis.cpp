#include "apps/sweep/map_axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/output/svg_chart.hpp"
#include "apps/sweep/case_list.hpp"

namespace arcwall::sweep {

namespace {

constexpr std::size_t most_named = 10;  // values that are ticks themselves

std::string short_label(const Json& value) {
  return value.is_number() ? short_number(value.get<double>()) : label(value);
}

}  // namespace

std::string short_number(double value) { return fmt::format("{:.6g}", value); }

MapAxis::MapAxis(const std::vector<Json>& values, AxisScale scale) : scale_(scale) {
  numbers_ = std::all_of(values.begin(), values.end(), [](const Json& value) { return value.is_number(); });
  if (!numbers_) {
    for (const Json& value : values)
      if (std::find(distinct_.begin(), distinct_.end(), value) == distinct_.end()) distinct_.push_back(value);
    low_ = -0.5;
    high_ = static_cast<double>(distinct_.size()) - 0.5;
    return;
  }
  distinct_ = values;
  std::sort(distinct_.begin(), distinct_.end(),
            [](const Json& a, const Json& b) { return a.get<double>() < b.get<double>(); });
  distinct_.erase(std::unique(distinct_.begin(), distinct_.end()), distinct_.end());
  const double least = distinct_.front().get<double>(), greatest = distinct_.back().get<double>();
  constexpr double decade = 10.0;
  logarithmic_ = scale == AxisScale::by_extent && least > 0.0 && greatest >= decade * least;
  // Half a mean distance on either side is room for the cells at the ends. What differs by round-off is one value.
  constexpr double round_off = 1e-9;
  const double extent = scaled(greatest) - scaled(least);
  const bool differ = extent > round_off * std::max(std::abs(scaled(least)), std::abs(scaled(greatest)));
  const double room = differ ? 0.5 * extent / static_cast<double>(std::min<std::size_t>(distinct_.size() - 1, 20))
                             : std::max(std::abs(scaled(greatest)), 1.0);
  low_ = scaled(least) - room;
  high_ = scaled(greatest) + room;
}

double MapAxis::scaled(double value) const { return logarithmic_ ? std::log10(value) : value; }

double MapAxis::place(const Json& value) const {
  const double at = numbers_
                        ? scaled(value.get<double>())
                        : static_cast<double>(std::find(distinct_.begin(), distinct_.end(), value) - distinct_.begin());
  return (at - low_) / (high_ - low_);
}

std::vector<Tick> MapAxis::ticks() const {
  if (numbers_ && (scale_ == AxisScale::linear || distinct_.size() > most_named)) return round_ticks();
  std::vector<Tick> result;
  for (const Json& value : distinct_) result.push_back({.at = place(value), .text = short_label(value)});
  return result;
}

std::vector<Tick> MapAxis::round_ticks() const {
  std::vector<double> values;
  if (logarithmic_) {
    constexpr double few = 3.0;  // decades
    const std::vector<double> factors = high_ - low_ > few ? std::vector{1.0} : std::vector{1.0, 2.0, 5.0};
    for (double power = std::floor(low_); power <= high_; ++power)
      for (const double factor : factors) values.push_back(factor * std::pow(10.0, power));
  } else {
    values = arcwall::ticks(low_, high_);
  }
  std::vector<Tick> result;
  for (const double value : values) {
    const double at = (scaled(value) - low_) / (high_ - low_);
    if (at >= 0.0 && at <= 1.0) result.push_back({.at = at, .text = short_number(value)});
  }
  return result;
}

}  // namespace arcwall::sweep
