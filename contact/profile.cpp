#include "contact/profile.hpp"

#include <algorithm>
#include <cmath>

#include "core/cubic_spline.hpp"
#include "core/gauss_points.hpp"

namespace arcwall {

namespace {

constexpr double small_turn = pi / 18.0;  // of a surface between two of its knots [rad]
constexpr int quarter = 9;                // so many of them are a quarter of a turn

class LineProfile final : public Profile {
 public:
  LineProfile(double z, double slope) : z_(z), slope_(slope) {}
  Height at(double x) const override { return {z_ + slope_ * x, slope_, 0.0, 0.0, 0.0}; }
  double length_to(double x) const override { return std::hypot(1.0, slope_) * x; }

 private:
  double z_, slope_;
};

class ParabolaProfile final : public Profile {
 public:
  ParabolaProfile(const Vec2& apex, double curvature) : apex_(apex), curvature_(curvature) {}
  Height at(double x) const override {
    const double d = x - apex_.x();
    return {apex_.y() + 0.5 * curvature_ * d * d, curvature_ * d, curvature_, 0.0, 0.0};
  }

  // ½ (d √(1 + k² d²) + arsinh(k d)/k)
  double length_to(double x) const override {
    const double d = x - apex_.x(), slope = curvature_ * d;
    return curvature_ == 0.0 ? d : 0.5 * (d * std::sqrt(1.0 + slope * slope) + std::asinh(slope) / curvature_);
  }

  std::vector<double> knots() const override {
    if (curvature_ == 0.0) return {};
    std::vector<double> x{-infinity};
    for (int i = 1 - quarter; i < quarter; ++i)
      x.push_back(apex_.x() + std::tan(i * small_turn) / std::abs(curvature_));
    x.push_back(infinity);
    return x;
  }

  bool is_smooth() const override { return true; }

 private:
  Vec2 apex_;
  double curvature_;
};

class CircleProfile final : public Profile {
 public:
  CircleProfile(const Vec2& centre, double radius, Side side)
      : centre_(centre), radius_(radius), sign_(side == Side::below ? 1.0 : -1.0) {}

  // y = √(R² − d²):  y′ = −d/y,  y″ = −R²/y³,  y‴ = −3 R² d/y⁵,  y⁗ = −3 R² (R² + 4 d²)/y⁷
  Height at(double x) const override {
    const double d = x - centre_.x(), r2 = radius_ * radius_, y = std::sqrt(r2 - d * d);
    const double y2 = y * y, y3 = y2 * y, y5 = y3 * y2, y7 = y5 * y2;
    return {centre_.y() + sign_ * y, -sign_ * d / y, -sign_ * r2 / y3, -3.0 * sign_ * r2 * d / y5,
            -3.0 * sign_ * r2 * (r2 + 4.0 * d * d) / y7};
  }

  double length_to(double x) const override { return radius_ * std::asin((x - centre_.x()) / radius_); }

  // The arc ends where its normal is level to 1e-6: there the height says nothing about the distance any more.
  bool covers(double x) const override { return std::abs(x - centre_.x()) < radius_ * (1.0 - 1e-6); }

  std::pair<double, double> extent() const override { return {centre_.x() - reach(), centre_.x() + reach()}; }

  std::vector<double> knots() const override {
    std::vector<double> x;
    for (int i = -quarter; i <= quarter; ++i) x.push_back(centre_.x() + reach() * std::sin(i * small_turn));
    return x;
  }

  bool is_smooth() const override { return true; }

 private:
  double reach() const { return radius_ * (1.0 - 2e-6); }

  Vec2 centre_;
  double radius_, sign_;
};

class SplineProfile final : public Profile {
 public:
  SplineProfile(std::vector<double> x, std::vector<double> z) : spline_(std::move(x), std::move(z), knot_rounding) {}
  Height at(double x) const override {
    const auto v = spline_.at(x);
    return {v[0], v[1], v[2], v[3], 0.0};
  }
  bool covers(double x) const override { return x >= spline_.first() && x <= spline_.last(); }

  // By Gauss's rule of eight points on parts of each cubic.
  double length_to(double x) const override {
    constexpr int parts = 8;
    double length = 0.0;
    const std::vector<double>& given = spline_.knots();
    for (std::size_t i = 0; i + 1 < given.size() && given[i] < x; ++i) {
      const double step = (std::min(x, given[i + 1]) - given[i]) / parts;
      for (int k = 0; k < parts; ++k) length += length_between(given[i] + k * step, given[i] + (k + 1) * step);
    }
    return length;
  }
  std::pair<double, double> extent() const override { return {spline_.first(), spline_.last()}; }

  std::vector<double> knots() const override {
    constexpr int parts = 4;  // of each cubic
    const std::vector<double>& given = spline_.knots();
    std::vector<double> x;
    for (std::size_t i = 0; i + 1 < given.size(); ++i)
      for (int k = 0; k < parts; ++k) x.push_back(given[i] + (given[i + 1] - given[i]) * k / parts);
    x.push_back(given.back());
    return x;
  }

  std::vector<Jump> jumps() const override {
    std::vector<Jump> jumps;
    for (std::size_t i = 1; i + 1 < spline_.knots().size(); ++i)
      jumps.push_back(
          {.x = spline_.knots()[i], .of_third = spline_.third_derivative_jump(i), .half_width = spline_.half_width(i)});
    return jumps;
  }

 private:
  double length_between(double from, double to) const {
    double length = 0.0;
    for (const auto& [place, weight] : gauss_points)
      for (const double sign : {-1.0, 1.0})
        length += weight * std::hypot(1.0, at(0.5 * (from + to) + sign * place * 0.5 * (to - from)).first);
    return 0.5 * (to - from) * length;
  }

  CubicSpline spline_;
};

// Of a slope; most walls are level.
double cosine(double slope) { return slope == 0.0 ? 1.0 : 1.0 / std::sqrt(1.0 + slope * slope); }

class ProfileObstacle final : public Obstacle {
 public:
  ProfileObstacle(std::shared_ptr<const Profile> profile, Side side)
      : profile_(std::move(profile)), side_(side), knots_(profile_->knots()), jumps_(jumps_of(*profile_)) {}

  Side side() const override { return side_; }
  bool faces(const Vec2& position, double) const override { return profile_->covers(position.x()); }

  // g = ± d c with d = z − ψ, c = (1 + ψ′²)^(−½):  c′ = −ψ′ψ″ c³,  c″ = −(ψ″² + ψ′ψ‴) c³ + 3 (ψ′ψ″)² c⁵
  //
  //   g_x = ±(d c′ − ψ′ c),  g_z = ± c,  g_xx = ±(d c″ − 2 ψ′ c′ − ψ″ c),  g_xz = ± c′,  g_zz = 0
  QuadraticField gap(const Vec2& position, double) const override {
    const Height psi = profile_->at(position.x());
    const double sign = sign_of(side_);
    const double c = cosine(psi.first), c3 = c * c * c, bend = psi.first * psi.second;
    const double c1 = -bend * c3;
    const double c2 = -(psi.second * psi.second + psi.first * psi.third) * c3 + 3.0 * bend * bend * c3 * c * c;
    const double d = position.y() - psi.value;
    return {.value = sign * d * c,
            .x = sign * (d * c1 - psi.first * c),
            .z = sign * c,
            .xx = sign * (d * c2 - 2.0 * psi.first * c1 - psi.second * c),
            .xz = sign * c1};
  }

  LinearField gap_slope(const Vec2& position, double) const override {
    if (!profile_->covers(position.x())) return {.value = infinity};
    const Height psi = profile_->at(position.x());
    const double sign = sign_of(side_);
    const double c = cosine(psi.first), d = position.y() - psi.value;
    return {.value = sign * d * c, .x = -sign * psi.first * c * (1.0 + d * psi.second * c * c), .z = sign * c};
  }

  // φ = arctan ψ′
  QuadraticField direction(const Vec2& position, double) const override {
    const Height psi = profile_->at(position.x());
    const double w = 1.0 + psi.first * psi.first;
    return {.value = std::atan(psi.first),
            .x = psi.second / w,
            .xx = psi.third / w - 2.0 * psi.first * psi.second * psi.second / (w * w)};
  }

  // ψ″ / (1 + ψ′²)^(3/2)
  LinearField curvature(const Vec2& position, double) const override {
    const Height psi = profile_->at(position.x());
    const double w = 1.0 + psi.first * psi.first, root = std::sqrt(w);
    return {.value = psi.second / (w * root),
            .x = psi.third / (w * root) - 3.0 * psi.first * psi.second * psi.second / (w * w * root)};
  }

  // With w = 1 + ψ′² the curvature is ψ″ w^(−3/2), and d/ds = w^(−1/2) d/dx.
  double curvature_second(const Vec2& position, double) const override {
    const Height psi = profile_->at(position.x());
    const double w = 1.0 + psi.first * psi.first, bend = psi.first * psi.second,
                 second3 = psi.second * psi.second * psi.second;
    const double by_x = psi.third - 3.0 * bend * psi.second / w;                        // times w^(−3/2)
    const double by_xx = psi.fourth - 9.0 * bend * psi.third / w - 3.0 * second3 / w +  // the same
                         15.0 * bend * bend * psi.second / (w * w);
    return (by_xx - by_x * bend / w) / (w * w * std::sqrt(w));
  }

  double along(const Vec2& position, double) const override { return position.x(); }

  // σ = S(x) + s d with S the length of the surface, s = ψ′ c its slope's sine: of d = 0 the gradient is (c, s).
  //
  //   σ_x = 1/c + s′ d − s ψ′,  σ_z = s,  σ_xx = (1/c)′ + s″ d − 2 s′ ψ′ − s ψ″,  σ_xz = s′
  //   s′ = ψ″ c³,  s″ = ψ‴ c³ − 3 ψ′ ψ″² c⁵,  (1/c)′ = ψ′ ψ″ c
  QuadraticField arc_length(const Vec2& position, double) const override {
    const Height psi = profile_->at(position.x());
    const double c = cosine(psi.first), c3 = c * c * c, s = psi.first * c, d = position.y() - psi.value;
    const double s1 = psi.second * c3;
    const double s2 = psi.third * c3 - 3.0 * psi.first * psi.second * psi.second * c3 * c * c;
    return {.value = profile_->length_to(position.x()) + s * d,
            .x = 1.0 / c + s1 * d - s * psi.first,
            .z = s,
            .xx = psi.first * psi.second * c + s2 * d - 2.0 * s1 * psi.first - s * psi.second,
            .xz = s1};
  }

  const std::vector<double>& knots() const override { return knots_; }
  bool is_smooth() const override { return profile_->is_smooth(); }

  std::span<const CurvatureRateJump> curvature_rate_jumps() const override { return jumps_; }

  // Points are closer together towards the ends, where a circle is steep.
  std::vector<Vec2> outline(double from, double to, double) const override {
    constexpr int parts = 400;
    const auto [first, last] = profile_->extent();
    const bool apart = last <= from || first >= to;
    const double low = apart ? first : std::max(first, from), high = apart ? last : std::min(last, to);
    std::vector<Vec2> line;
    for (int i = 0; i <= parts; ++i) {
      const double x = std::clamp(0.5 * (low + high) - 0.5 * (high - low) * std::cos(pi * i / parts), low, high);
      line.emplace_back(x, profile_->at(x).value);
    }
    return line;
  }

 private:
  // Of κ′ / √(1 + ψ′²), where κ′ jumps as ψ‴ does.
  static std::vector<CurvatureRateJump> jumps_of(const Profile& profile) {
    std::vector<CurvatureRateJump> jumps;
    for (const auto& [x, of_third, half_width] : profile.jumps()) {
      const Height psi = profile.at(x);
      const double w = 1.0 + psi.first * psi.first;
      jumps.push_back({.place = {x, psi.value},
                       .tangent = Vec2(1.0, psi.first) / std::sqrt(w),
                       .jump = of_third / (w * w),
                       .half_width = std::sqrt(w) * half_width});
    }
    return jumps;
  }

  std::shared_ptr<const Profile> profile_;
  Side side_;
  std::vector<double> knots_;
  std::vector<CurvatureRateJump> jumps_;
};

}  // namespace

std::shared_ptr<const Obstacle> obstacle(std::shared_ptr<const Profile> profile, Side side) {
  return std::make_shared<ProfileObstacle>(std::move(profile), side);
}

std::unique_ptr<Profile> flat_profile(double z) { return std::make_unique<LineProfile>(z, 0.0); }
std::unique_ptr<Profile> line_profile(double z, double slope) { return std::make_unique<LineProfile>(z, slope); }
std::unique_ptr<Profile> parabola_profile(const Vec2& apex, double curvature) {
  return std::make_unique<ParabolaProfile>(apex, curvature);
}
std::unique_ptr<Profile> circle_profile(const Vec2& centre, double radius, Side side) {
  return std::make_unique<CircleProfile>(centre, radius, side);
}
std::unique_ptr<Profile> spline_profile(std::vector<double> x, std::vector<double> z) {
  return std::make_unique<SplineProfile>(std::move(x), std::move(z));
}

}  // namespace arcwall
