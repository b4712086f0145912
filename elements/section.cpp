#include "elements/section.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <utility>

#include "core/types.hpp"

namespace arcwall {

namespace {

// The quartic through the values at five places of equal spacing on [0, 1], by powers.
std::array<double, 5> quartic(const std::array<double, 5>& values) {
  std::array<double, 5> newton = values;  // coefficients of t (t − 1) (t − 2) …, t = 4 x
  for (std::size_t order = 1; order < newton.size(); ++order)
    for (std::size_t i = newton.size(); i-- > order;) newton[i] = (newton[i] - newton[i - 1]) / double(order);
  std::array<double, 5> powers{};
  for (std::size_t i = newton.size(); i-- > 0;) {  // powers ← newton[i] + (4 x − i) powers
    for (std::size_t k = powers.size(); k-- > 0;)
      powers[k] = (k > 0 ? 4.0 * powers[k - 1] : 0.0) - double(i) * powers[k];
    powers[0] += newton[i];
  }
  return powers;
}

double derived(const std::array<double, 5>& powers, double x, int derivative) {
  double value = 0.0;
  for (int k = int(powers.size()) - 1; k >= derivative; --k) {
    double factor = powers[static_cast<std::size_t>(k)];
    for (int i = 0; i < derivative; ++i) factor *= double(k - i);
    value = value * x + factor;
  }
  return value;
}

}  // namespace

SectionTaper::SectionTaper(std::vector<double> breaks, const std::function<SectionSizes(double)>& sizes) {
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    Piece piece{.from = breaks[i], .to = breaks[i + 1], .A = {}, .I = {}, .height = {}, .shear_area = {}};
    for (std::size_t k = 0; k < piece.A.size(); ++k) {
      const SectionSizes here = sizes(piece.from + 0.25 * double(k) * (piece.to - piece.from));
      piece.A[k] = here.A;
      piece.I[k] = here.I;
      piece.height[k] = here.height;
      piece.shear_area[k] = here.shear_area;
    }
    for (Polynomial* values : {&piece.A, &piece.I, &piece.height, &piece.shear_area}) *values = quartic(*values);
    pieces_.push_back(piece);
  }
}

SectionSizes SectionTaper::at(double fraction, int derivative) const {
  const auto behind = std::find_if(pieces_.begin(), pieces_.end(), [&](const Piece& p) { return fraction <= p.to; });
  const Piece& piece = behind == pieces_.end() ? pieces_.back() : *behind;
  const double length = piece.to - piece.from, x = (fraction - piece.from) / length;
  const double scale = std::pow(length, -derivative);
  const auto of = [&](const Polynomial& powers) { return scale * derived(powers, x, derivative); };
  return {.A = of(piece.A), .I = of(piece.I), .height = of(piece.height), .shear_area = of(piece.shear_area)};
}

Section Section::at(double fraction) const {
  if (!taper) return *this;
  const SectionSizes sizes = taper->at(fraction);
  Section here = *this;
  here.taper = nullptr;
  here.A = sizes.A;
  here.I = sizes.I;
  if (height) here.height = sizes.height;
  here.shear_area = sizes.shear_area;
  return here;
}

std::vector<SectionPoint> rectangle_points(double width, double height) {
  using Gauss = boost::math::quadrature::gauss<double, 5>;
  const double half = 0.5 * height;
  std::vector<SectionPoint> points;
  for (std::size_t i = 0; i < Gauss::abscissa().size(); ++i) {
    const double z = half * Gauss::abscissa()[i], area = width * half * Gauss::weights()[i];
    points.push_back({.z = z, .area = area});
    if (z != 0.0) points.push_back({.z = -z, .area = area});
  }
  return points;
}

// ∫ f(z) 2 √(r² − z²) dz = Σ (2π r²/6) sin²(iπ/6) f(r cos(iπ/6)), the Gauss rule for this weight.
std::vector<SectionPoint> circle_points(double radius) {
  constexpr int count = 5;
  std::vector<SectionPoint> points;
  for (int i = 1; i <= count; ++i) {
    const double angle = i * pi / (count + 1), sine = std::sin(angle);
    points.push_back({.z = radius * std::cos(angle), .area = 2.0 * pi * radius * radius / (count + 1) * sine * sine});
  }
  return points;
}

std::vector<SectionPoint> tube_points(double radius, double thickness) {
  std::vector<SectionPoint> points = circle_points(radius);
  for (const SectionPoint& hole : circle_points(radius - thickness))
    points.push_back({.z = hole.z, .area = -hole.area});
  return points;
}

}  // namespace arcwall
