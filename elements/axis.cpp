#include "elements/axis.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>

#include "core/cubic_spline.hpp"

namespace arcwall {

namespace {

template <unsigned points>
using AxisGauss = boost::math::quadrature::gauss<double, points>;
using Gauss = AxisGauss<10>;

double angle_of(const Vec2& v) { return std::atan2(v.y(), v.x()); }

// cos n φ + i sin n φ = (cos φ + i sin φ)ⁿ, by products where they are few.
std::complex<double> multiple_turn(const std::complex<double>& once, double angle, int n) {
  constexpr int few = 8;
  if (n < 1 || n > few) return {std::cos(n * angle), std::sin(n * angle)};
  std::complex<double> turned = once;
  for (int i = 1; i < n; ++i) turned *= once;
  return turned;
}

// Of the shortest wave over a part of a curve: a polynomial of degree 6 is its speed to round-off.
constexpr double small_phase = 0.25;

// The speed over a part of a curve, as the polynomial through its values at both ends and at Gauss's five points; by
// u from −1 to 1.
class PolynomialSpeed {
 public:
  // `speed_at` takes the fraction of the part.
  template <typename Speed>
  PolynomialSpeed(double first, double last, const Speed& speed_at) {
    Values values;
    values[0] = first;
    values[size - 1] = last;
    for (Index i = 1; i + 1 < size; ++i) values[i] = speed_at(0.5 + 0.5 * nodes()[i]);
    coefficients_ = from_values() * values;
    length_ = integral(1.0);
  }

  // As a multiple of the length of the part's axis.
  double length() const { return 0.5 * length_; }

  // The fraction of the axis at a fraction of the length, by Newton's method.
  double place_of(double fraction) const {
    constexpr int most_iterations = 10;
    double u = 2.0 * fraction - 1.0;
    for (int i = 0; i < most_iterations; ++i) {
      const double change = (fraction * length_ - integral(u)) / value(u);
      u += change;
      if (std::abs(change) <= 4.0 * std::numeric_limits<double>::epsilon()) break;
    }
    return 0.5 + 0.5 * u;
  }

 private:
  static constexpr Index size = 7;
  using Values = Eigen::Matrix<double, size, 1>;
  using Square = Eigen::Matrix<double, size, size>;

  static const Values& nodes() {
    static const Values result = [] {
      const auto& positive = AxisGauss<5>::abscissa();  // 0 first
      return Values{-1.0, -positive[2], -positive[1], positive[0], positive[1], positive[2], 1.0};
    }();
    return result;
  }

  // Coefficients of 1, u, u², … of the polynomial through values at the nodes.
  static const Square& from_values() {
    static const Square result = [] {
      Square powers;
      for (Index k = 0; k < size; ++k) powers.col(k) = nodes().array().pow(double(k));
      return Square(powers.inverse());
    }();
    return result;
  }

  double value(double u) const {
    double sum = 0.0;
    for (Index k = size; k-- > 0;) sum = sum * u + coefficients_[k];
    return sum;
  }

  // From −1 to u.
  double integral(double u) const {
    const auto antiderivative = [this](double at) {
      double sum = 0.0;
      for (Index k = size; k-- > 0;) sum = (sum + coefficients_[k] / double(k + 1)) * at;
      return sum;
    };
    return antiderivative(u) - antiderivative(-1.0);
  }

  Values coefficients_;
  double length_ = 0.0;
};

class StraightAxis final : public Axis {
 public:
  StraightAxis(const Vec2& from, const Vec2& to)
      : from_(from), to_(to), length_((to - from).norm()), angle_(angle_of(to - from)) {}
  double length() const override { return length_; }
  bool is_straight() const override { return true; }
  std::optional<double> constant_curvature() const override { return 0.0; }
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
  enum class Extent { to_last, all_round };

  // Centre from the perpendicular bisectors: with a = via − from and b = to − from,
  // centre − from = (|a|² b⊥ − |b|² a⊥) / (2 b × a), turned so that both chords end on the circle.
  ArcAxis(const Vec2& from, const Vec2& via, const Vec2& to, Extent extent = Extent::to_last) {
    const Vec2 a = via - from, b = to - from;
    centre_ = from + (b.squaredNorm() * perp(a) - a.squaredNorm() * perp(b)) / (2.0 * cross(a, b));
    radius_ = (from - centre_).norm();
    sense_ = cross(a, b) > 0.0 ? 1.0 : -1.0;
    start_ = angle_of(from - centre_);
    double sweep = sense_ * (angle_of(to - centre_) - start_);
    while (sweep <= 0.0) sweep += 2.0 * pi;
    sweep_ = extent == Extent::all_round ? 2.0 * pi : sweep;
  }
  double length() const override { return radius_ * sweep_; }
  std::optional<double> constant_curvature() const override { return sense_ / radius_; }
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
    const double turn = turn_between(tangents_[k], r.first);
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
  virtual Vec2 tangent(double t) const = 0;  // curve(t).first

  // To be called once by the constructor of the curve.
  void measure(std::vector<double> knots) {
    knots_ = std::move(knots);
    for (const double knot : knots_) tangents_.push_back(tangent(knot));
    lengths_.assign(1, 0.0);
    angles_.assign(1, angle_of(tangents_[0]));
    for (std::size_t k = 1; k < knots_.size(); ++k) {
      lengths_.push_back(lengths_.back() + length_between<10>(knots_[k - 1], knots_[k]));
      angles_.push_back(angles_.back() + turn_between(tangents_[k - 1], tangents_[k]));
    }
  }

 private:
  // Negative where b lies before a.
  template <unsigned points>
  double length_between(double a, double b) const {
    return AxisGauss<points>::integrate([this](double t) { return tangent(t).norm(); }, a, b);
  }

  std::size_t interval(double s) const {
    const auto above = std::upper_bound(lengths_.begin() + 1, lengths_.end() - 1, s);
    return static_cast<std::size_t>(above - lengths_.begin()) - 1;
  }

  // Newton's method, as coordinate_at() below.
  double parameter(double s) const {
    const auto k = interval(s);
    const double low = knots_[k], high = knots_[k + 1];
    double t = low + (high - low) * (s - lengths_[k]) / (lengths_[k + 1] - lengths_[k]);
    double error = lengths_[k] + length_between<10>(low, t) - s;
    for (int i = 0; i < 20; ++i) {
      const double next = std::clamp(t - error / tangent(t).norm(), low, high);
      if (std::abs(error) <= 1e-15 * lengths_.back()) return next;
      error += length_between<3>(t, next);
      t = next;
    }
    return t;
  }

  std::vector<double> knots_, lengths_, angles_;
  std::vector<Vec2> tangents_;  // at the knots
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
  Vec2 tangent(double t) const override { return chord_ + rise_ * wave_number_ * std::cos(wave_number_ * t) * normal_; }

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
  Vec2 tangent(double t) const override { return {x_.at(t)[1], z_.at(t)[1]}; }

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

std::unique_ptr<Axis> circle_axis(const Vec2& from, const Vec2& via, const Vec2& later) {
  return std::make_unique<ArcAxis>(from, via, later, ArcAxis::Extent::all_round);
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
  DeviatedPoint point{
      .position = axis.position, .deviation = Vec2::Zero(), .angle = axis.angle, .turning = axis.curvature};
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
  const double turned = phase(from, to);
  if (turned <= small_phase) return AxisGauss<5>::integrate(here, from, to);
  if (turned <= 1.0) return AxisGauss<7>::integrate(here, from, to);
  return Gauss::integrate(here, from, to);
}

// Of the shortest wave; infinite where the axis has waves of its own.
double ImperfectAxis::phase(double from, double to) const {
  return axis_.is_straight() ? wave_number_ * std::abs(to - from) : infinity;
}

// Arc length of the axis takes the place of its own where nothing deviates.
DividedPart ImperfectAxis::divided(double from, double to, DividedPart::Inside inside) const {
  DividedPart part;
  DeviatedPoint &first = part.at.front(), &last = part.at.back();
  first = along(from);
  last = along(to);
  part.chord = axis_.constant_curvature() ? axis_.chord(from, to) + last.deviation - first.deviation
                                          : Vec2(last.position - first.position);
  const auto divide = [&](const auto& place_at) {
    if (inside == DividedPart::Inside::left_out) return;
    for (std::size_t k = 1; k + 1 < part.at.size(); ++k)
      part.at[k] = along(place_at(double(k) / double(part.at.size() - 1)));
  };
  const auto linear = [&](double fraction) { return from + fraction * (to - from); };
  if (!deviations_.empty() && phase(from, to) <= small_phase) {
    const PolynomialSpeed speeds(part.at.front().speed, part.at.back().speed,
                                 [&](double fraction) { return speed(linear(fraction)); });
    part.length = (to - from) * speeds.length();
    divide([&](double fraction) { return linear(speeds.place_of(fraction)); });
  } else {
    part.length = length(from, to);
    divide([&](double fraction) { return coordinate_at(from, fraction * part.length, linear(fraction)); });
  }
  return part;
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

AxisPoints::AxisPoints(std::shared_ptr<const Axis> axis, const std::vector<SineDeviation>& deviations, int elements,
                       const Vec2& first, const Vec2& last)
    : axis_(std::move(axis)), elements_(static_cast<std::size_t>(elements)), first_(first), last_(last) {
  if (axis_->is_straight() && deviations.empty()) return;
  const ImperfectAxis curve(*axis_, deviations);
  for (std::size_t k = 0; k <= elements_; ++k)
    points_.push_back(deviations.empty() ? axis_->at(arc(k)) : curve.at(arc(k)));
}

AxisPoint AxisPoints::operator[](std::size_t k) const {
  AxisPoint point = points_.empty() ? axis_->at(arc(k)) : points_[k];
  if (k == 0) point.position = first_;
  if (k == elements_) point.position = last_;
  return point;
}

double box_diagonal(const std::vector<Vec2>& points) {
  Eigen::AlignedBox2d box;
  for (const Vec2& point : points) box.extend(point);
  return box.diagonal().norm();
}

}  // namespace arcwall
