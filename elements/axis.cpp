#include "elements/axis.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <complex>
#include <limits>

#include "core/cubic_spline.hpp"

namespace arcwall {

namespace {

template <unsigned points>
using AxisGauss = boost::math::quadrature::gauss<double, points>;
using Gauss = AxisGauss<10>;

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }
double angle_of(const Vec2& v) { return std::atan2(v.y(), v.x()); }

// cos n φ + i sin n φ = (cos φ + i sin φ)ⁿ, by products where they are few.
std::complex<double> multiple_turn(const std::complex<double>& once, double angle, int n) {
  constexpr int few = 8;
  if (n < 1 || n > few) return {std::cos(n * angle), std::sin(n * angle)};
  std::complex<double> turned = once;
  for (int i = 1; i < n; ++i) turned *= once;
  return turned;
}

class StraightAxis final : public Axis {
 public:
  StraightAxis(const Vec2& from, const Vec2& to)
      : from_(from), to_(to), length_((to - from).norm()), angle_(angle_of(to - from)) {}
  double length() const override { return length_; }
  bool is_straight() const override { return true; }
  AxisPoint at(double s) const override {
    const double t = s / length_;
    return {.position = (1.0 - t) * from_ + t * to_, .angle = angle_};
  }
  Vec2 chord(double from, double to) const override { return (to - from) / length_ * (to_ - from_); }

 private:
  Vec2 from_, to_;
  double length_, angle_;
};

class ArcAxis final : public Axis {
 public:
  // Centre from the perpendicular bisectors: with a = via − from and b = to − from,
  // centre − from = (|a|² b⊥ − |b|² a⊥) / (2 b × a), turned so that both chords end on the circle.
  ArcAxis(const Vec2& from, const Vec2& via, const Vec2& to) {
    const Vec2 a = via - from, b = to - from;
    centre_ = from + (b.squaredNorm() * perp(a) - a.squaredNorm() * perp(b)) / (2.0 * cross(a, b));
    radius_ = (from - centre_).norm();
    sense_ = cross(a, b) > 0.0 ? 1.0 : -1.0;
    start_ = angle_of(from - centre_);
    double sweep = sense_ * (angle_of(to - centre_) - start_);
    while (sweep <= 0.0) sweep += 2.0 * pi;
    sweep_ = sweep;
  }
  double length() const override { return radius_ * sweep_; }
  AxisPoint at(double s) const override {
    const double polar = start_ + sense_ * s / radius_;
    return {.position = centre_ + radius_ * Vec2(std::cos(polar), std::sin(polar)),
            .angle = polar + sense_ * 0.5 * pi,
            .curvature = sense_ / radius_};
  }
  Vec2 chord(double from, double to) const override {
    const double middle = start_ + sense_ * 0.5 * (from + to) / radius_;
    return 2.0 * radius_ * sense_ * std::sin(0.5 * (to - from) / radius_) * Vec2(-std::sin(middle), std::cos(middle));
  }

 private:
  Vec2 centre_{};
  double radius_ = 0.0, sense_ = 1.0, start_ = 0.0, sweep_ = 0.0;
};

// A curve r(t) on knots t_0 < … < t_n, measured by arc length: lengths between knots are tabulated, then s → t by
// Newton.
class ParametricAxis : public Axis {
 public:
  double length() const override { return lengths_.back(); }

  // κ = r′ × r″/v³, v = |r′|, and dκ/ds = (r′ × r‴/v³ − 3 κ r′·r″/v²)/v.
  AxisPoint at(double s) const override {
    const double t = parameter(s);
    const Derivatives r = curve(t);
    const double speed = r.first.norm(), cube = speed * speed * speed;
    const double curvature = cross(r.first, r.second) / cube;
    const auto k = interval(s);
    // The tangent's angle, continued from the knot before (turns between knots stay below half a turn).
    const Vec2 tangent_before = curve(knots_[k]).first;
    const double turn = std::atan2(cross(tangent_before, r.first), tangent_before.dot(r.first));
    return {.position = r.value,
            .angle = angles_[k] + turn,
            .curvature = curvature,
            .curvature_rate =
                (cross(r.first, r.third) / cube - 3.0 * curvature * r.first.dot(r.second) / (speed * speed)) / speed};
  }

 protected:
  struct Derivatives {
    Vec2 value, first, second, third;
  };
  virtual Derivatives curve(double t) const = 0;

  // To be called once by the constructor of the curve.
  void measure(std::vector<double> knots) {
    knots_ = std::move(knots);
    lengths_.assign(1, 0.0);
    angles_.assign(1, angle_of(curve(knots_[0]).first));
    for (std::size_t k = 1; k < knots_.size(); ++k) {
      lengths_.push_back(lengths_.back() + length_between(knots_[k - 1], knots_[k]));
      const Vec2 a = curve(knots_[k - 1]).first, b = curve(knots_[k]).first;
      angles_.push_back(angles_.back() + std::atan2(cross(a, b), a.dot(b)));
    }
  }

 private:
  double length_between(double a, double b) const {
    return b > a ? Gauss::integrate([this](double t) { return curve(t).first.norm(); }, a, b) : 0.0;
  }

  std::size_t interval(double s) const {
    const auto above = std::upper_bound(lengths_.begin() + 1, lengths_.end() - 1, s);
    return static_cast<std::size_t>(above - lengths_.begin()) - 1;
  }

  double parameter(double s) const {
    const auto k = interval(s);
    const double low = knots_[k], high = knots_[k + 1];
    double t = low + (high - low) * (s - lengths_[k]) / (lengths_[k + 1] - lengths_[k]);
    for (int i = 0; i < 20; ++i) {
      const double error = lengths_[k] + length_between(low, t) - s;
      t = std::clamp(t - error / curve(t).first.norm(), low, high);
      if (std::abs(error) <= 1e-15 * lengths_.back()) break;
    }
    return t;
  }

  std::vector<double> knots_, lengths_, angles_;
};

class SineAxis final : public ParametricAxis {
 public:
  SineAxis(const Vec2& from, const Vec2& to, double rise, int waves)
      : from_(from), chord_(to - from), normal_(perp(chord_.normalized())), rise_(rise), wave_number_(waves * pi) {
    constexpr int knots_a_half_wave = 16;
    const int count = knots_a_half_wave * waves;
    std::vector<double> knots;
    for (int k = 0; k <= count; ++k) knots.push_back(double(k) / count);
    measure(std::move(knots));
  }

 protected:
  Derivatives curve(double t) const override {
    const double a = wave_number_ * t;
    return {.value = (1.0 - t) * from_ + t * (from_ + chord_) + rise_ * std::sin(a) * normal_,
            .first = chord_ + rise_ * wave_number_ * std::cos(a) * normal_,
            .second = -rise_ * wave_number_ * wave_number_ * std::sin(a) * normal_,
            .third = -rise_ * wave_number_ * wave_number_ * wave_number_ * std::cos(a) * normal_};
  }

 private:
  Vec2 from_, chord_, normal_;
  double rise_, wave_number_;
};

std::vector<double> cumulative_chords(const std::vector<Vec2>& points) {
  std::vector<double> t{0.0};
  for (std::size_t k = 1; k < points.size(); ++k) t.push_back(t.back() + (points[k] - points[k - 1]).norm());
  return t;
}

std::vector<double> coordinate(const std::vector<Vec2>& points, int which) {
  std::vector<double> values;
  for (const Vec2& point : points) values.push_back(point[which]);
  return values;
}

class SplineAxis final : public ParametricAxis {
 public:
  explicit SplineAxis(const std::vector<Vec2>& points)
      : x_(cumulative_chords(points), coordinate(points, 0)), z_(x_.knots(), coordinate(points, 1)) {
    constexpr int parts = 4;  // of each stretch between points, for the accuracy of its length
    std::vector<double> knots{x_.first()};
    for (std::size_t k = 1; k < x_.knots().size(); ++k)
      for (int i = 1; i <= parts; ++i)
        knots.push_back(x_.knots()[k - 1] + (x_.knots()[k] - x_.knots()[k - 1]) * i / parts);
    measure(std::move(knots));
  }

 protected:
  Derivatives curve(double t) const override {
    const auto x = x_.at(t), z = z_.at(t);
    return {.value = {x[0], z[0]}, .first = {x[1], z[1]}, .second = {x[2], z[2]}, .third = {x[3], z[3]}};
  }

 private:
  CubicSpline x_, z_;
};

}  // namespace

std::unique_ptr<Axis> straight_axis(const Vec2& from, const Vec2& to) {
  return std::make_unique<StraightAxis>(from, to);
}

std::unique_ptr<Axis> arc_axis(const Vec2& from, const Vec2& via, const Vec2& to) {
  return std::make_unique<ArcAxis>(from, via, to);
}

std::unique_ptr<Axis> sine_axis(const Vec2& from, const Vec2& to, double rise, int waves) {
  return std::make_unique<SineAxis>(from, to, rise, waves);
}

std::unique_ptr<Axis> spline_axis(const std::vector<Vec2>& points) { return std::make_unique<SplineAxis>(points); }

ImperfectAxis::ImperfectAxis(const Axis& axis, std::vector<SineDeviation> deviations)
    : axis_(axis), deviations_(std::move(deviations)), wave_number_(0.0) {
  for (const SineDeviation& wave : deviations_)
    wave_number_ = std::max(wave_number_, std::abs(wave.waves) * pi / axis_.length());
}

ImperfectAxis::Deviation ImperfectAxis::deviation(double s) const {
  Deviation y{.value = 0.0, .slope = 0.0, .second = 0.0};
  const double k1 = pi / axis_.length();
  const std::complex<double> once(std::cos(k1 * s), std::sin(k1 * s));
  for (const SineDeviation& wave : deviations_) {
    const double k = wave.waves * k1;
    const std::complex<double> turned = multiple_turn(once, k1 * s, wave.waves);
    y.value += wave.amplitude * turned.imag();
    y.slope += wave.amplitude * k * turned.real();
    y.second -= wave.amplitude * k * k * turned.imag();
  }
  return y;
}

// r = r_axis + y n:  r′ = a t + y′ n,  a = 1 − κ y,  and the angle turns by κ + (a y″ − y′ a′)/(a² + y′²).
DeviatedPoint ImperfectAxis::along(double s) const {
  const AxisPoint axis = axis_.at(s);
  DeviatedPoint point{.position = axis.position, .angle = axis.angle, .turning = axis.curvature};
  if (deviations_.empty()) return point;
  const Deviation y = deviation(s);
  const double a = 1.0 - axis.curvature * y.value;
  const double a_rate = -axis.curvature_rate * y.value - axis.curvature * y.slope;
  point.deviation = y.value * Vec2(-std::sin(axis.angle), std::cos(axis.angle));
  point.position += point.deviation;
  point.angle += std::atan2(y.slope, a);
  point.speed = std::sqrt(a * a + y.slope * y.slope);
  point.turning += (a * y.second - y.slope * a_rate) / (a * a + y.slope * y.slope);
  return point;
}

AxisPoint ImperfectAxis::at(double s) const {
  const DeviatedPoint point = along(s);
  return {.position = point.position, .angle = point.angle};
}

Vec2 ImperfectAxis::chord(double from, double to) const {
  const Vec2 chord = axis_.chord(from, to);
  return deviations_.empty() ? chord : Vec2(chord + along(to).deviation - along(from).deviation);
}

double ImperfectAxis::speed(double s) const {
  if (deviations_.empty()) return 1.0;
  const Deviation y = deviation(s);
  const double a = axis_.is_straight() ? 1.0 : 1.0 - axis_.at(s).curvature * y.value;
  return std::sqrt(a * a + y.slope * y.slope);
}

// On a straight axis the speed is made of waves with twice the wave numbers of the deviations; over a part of a wave
// few points are exact to round-off.
double ImperfectAxis::length(double from, double to) const {
  if (deviations_.empty()) return to - from;
  const auto here = [this](double s) { return speed(s); };
  const double phase = axis_.is_straight() ? wave_number_ * std::abs(to - from) : infinity;
  if (phase <= 0.25) return AxisGauss<5>::integrate(here, from, to);
  if (phase <= 1.0) return AxisGauss<7>::integrate(here, from, to);
  return Gauss::integrate(here, from, to);
}

// Newton's method. What a step leaves of the error is the length between its ends less its own linear estimate, so that
// one integral over the whole is enough.
double ImperfectAxis::coordinate_at(double from, double length, double guess) const {
  if (deviations_.empty()) return from + length;
  constexpr int most_iterations = 10;
  double s = guess, error = this->length(from, s) - length;
  for (int i = 0; i < most_iterations; ++i) {
    if (std::abs(error) <= 4.0 * std::numeric_limits<double>::epsilon() * std::abs(s)) break;
    const double next = s - error / speed(s);
    error -= AxisGauss<3>::integrate([this](double t) { return speed(t); }, next, s);
    s = next;
  }
  return s;
}

double box_diagonal(const std::vector<Vec2>& points) {
  Eigen::AlignedBox2d box;
  for (const Vec2& point : points) box.extend(point);
  return box.diagonal().norm();
}

}  // namespace arcwall
