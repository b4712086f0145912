#include "model/deck/smoothing.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/cubic_spline.hpp"

namespace arcwall::deck {

namespace {

constexpr std::size_t first_count = 3, most_intervals = 200;

// What the ends of a spline are like decays by 2 − √3 from knot to knot: with so many more on both sides a closed curve
// is smooth where it closes, to round-off.
constexpr std::size_t around = 32;

std::vector<double> chord_sums(const std::vector<Vec2>& points) {
  std::vector<double> sums{0.0};
  for (std::size_t i = 1; i < points.size(); ++i) sums.push_back(sums.back() + (points[i] - points[i - 1]).norm());
  return sums;
}

// The knots of a spline, and which of the values each has.
struct Knots {
  std::vector<double> t{};
  std::vector<std::size_t> value{};
};

Knots knots_between(const std::vector<double>& ends, bool is_ring) {
  const std::size_t intervals = ends.size() - 1;
  Knots knots;
  if (!is_ring) {
    knots.t = ends;
    for (std::size_t j = 0; j <= intervals; ++j) knots.value.push_back(j);
    return knots;
  }
  const double period = ends.back() - ends.front();
  const auto count = static_cast<std::ptrdiff_t>(intervals), more = static_cast<std::ptrdiff_t>(around);
  for (std::ptrdiff_t j = -more; j <= count + more; ++j) {
    const std::ptrdiff_t turn = j >= 0 ? j / count : -((count - 1 - j) / count), at = j - turn * count;
    knots.t.push_back(ends[static_cast<std::size_t>(at)] + static_cast<double>(turn) * period);
    knots.value.push_back(static_cast<std::size_t>(at));
  }
  return knots;
}

CubicSpline spline_of(const Knots& knots, const auto& value_of) {
  std::vector<double> values;
  for (const std::size_t which : knots.value) values.push_back(value_of(which));
  return {knots.t, std::move(values)};
}

// Values at equal intervals whose spline is nearest to the points; empty if the points do not determine them.
std::optional<Matrix> least_squares(const std::vector<double>& t, const std::vector<Vec2>& points,
                                    const std::vector<double>& ends, bool is_ring) {
  const Knots knots = knots_between(ends, is_ring);
  const auto unknowns = static_cast<Index>(is_ring ? ends.size() - 1 : ends.size());
  const auto rows = static_cast<Index>(points.size());
  Matrix A(rows, unknowns), b(rows, 2);
  for (Index j = 0; j < unknowns; ++j) {
    const CubicSpline base =
        spline_of(knots, [&](std::size_t which) { return static_cast<Index>(which) == j ? 1.0 : 0.0; });
    for (Index i = 0; i < rows; ++i) A(i, j) = base.at(t[static_cast<std::size_t>(i)])[0];
  }
  for (Index i = 0; i < rows; ++i) b.row(i) = points[static_cast<std::size_t>(i)].transpose();
  const Eigen::ColPivHouseholderQR<Matrix> factors(A);
  if (factors.rank() < unknowns) return std::nullopt;
  return factors.solve(b);
}

// The greatest distance of the points from the curve that a wall has through the values: by its own chord lengths.
double greatest_distance(const std::vector<double>& t, const std::vector<Vec2>& points, const std::vector<double>& ends,
                         const std::vector<Vec2>& values, AlongPoints along) {
  std::vector<double> own = ends;
  if (along != AlongPoints::x) {
    std::vector<Vec2> line = values;
    if (along == AlongPoints::ring) line.push_back(values.front());
    own = chord_sums(line);
  }
  const Knots knots = knots_between(own, along == AlongPoints::ring);
  const CubicSpline x = spline_of(knots, [&](std::size_t which) { return values[which].x(); });
  const CubicSpline z = spline_of(knots, [&](std::size_t which) { return values[which].y(); });
  double greatest = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto above = std::upper_bound(ends.begin() + 1, ends.end() - 1, t[i]);
    const auto j = static_cast<std::size_t>(above - ends.begin()) - 1;
    const double at = own[j] + (own[j + 1] - own[j]) * (t[i] - ends[j]) / (ends[j + 1] - ends[j]);
    const double across = z.at(at)[0] - points[i].y();
    greatest = std::max(greatest,
                        along == AlongPoints::x ? std::abs(across) : std::hypot(x.at(at)[0] - points[i].x(), across));
  }
  return greatest;
}

}  // namespace

std::optional<std::vector<Vec2>> smoothed(const std::vector<Vec2>& points, double tolerance, AlongPoints along) {
  const bool is_ring = along == AlongPoints::ring;
  std::vector<double> t;
  if (along == AlongPoints::x)
    for (const Vec2& point : points) t.push_back(point.x());
  else
    t = chord_sums(points);
  const double last = t.back() + (is_ring ? (points.front() - points.back()).norm() : 0.0);
  for (std::size_t count = first_count; count <= std::min(points.size() / 3, most_intervals); count += 1 + count / 4) {
    std::vector<double> ends;
    for (std::size_t j = 0; j <= count; ++j)
      ends.push_back(t.front() + (last - t.front()) * static_cast<double>(j) / static_cast<double>(count));
    const auto found = least_squares(t, points, ends, is_ring);
    if (!found) return std::nullopt;
    std::vector<Vec2> values;
    for (Index j = 0; j < found->rows(); ++j)
      values.emplace_back(along == AlongPoints::x ? ends[static_cast<std::size_t>(j)] : (*found)(j, 0), (*found)(j, 1));
    if (greatest_distance(t, points, ends, values, along) <= tolerance) return values;
  }
  return std::nullopt;
}

}  // namespace arcwall::deck
