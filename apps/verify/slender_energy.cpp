// Slender beams: the expanded energy (2.3), the mixed element (2.8), and the places inside both.
#include <Eigen/LU>
#include <limits>
#include <memory>

#include "apps/verify/strain_energy.hpp"
#include "core/unit_tangent.hpp"

namespace arcwall::verify {

double angle_inside(const Stretch& stretch, double fraction) {
  double sum = 0.0;
  for (std::size_t k = 0; k < stretch.angles.size(); ++k) {
    double basis = 1.0;
    for (std::size_t j = 0; j < stretch.angles.size(); ++j)
      if (j != k) basis *= (3.0 * fraction - double(j)) / (double(k) - double(j));
    sum += basis * stretch.angles[k];
  }
  return sum;
}

namespace {

// An angle to within half a turn.
template <int N>
Jet<N> within_half_a_turn(Jet<N> angle) {
  angle.value = std::remainder(angle.value, 2.0 * pi);
  return angle;
}

double direction_of(const Vec2& v) { return std::atan2(v.y(), v.x()); }

// A stretch as it would lie without force: 1 + e times as long, and turned by κ h (ξ − ½) where it is ξ of its length.
// Its chord differs from the cold one by what the interpolated angles tell.
Stretch freed(const Stretch& cold, const FreeDeformation& free) {
  Stretch hot = cold;
  const double longer = 1.0 + free.strain, h = cold.length;
  const auto turn = [&](double fraction) { return free.curvature * h * (fraction - 0.5); };
  if (free.curvature != 0.0) {
    for (std::size_t k = 0; k < hot.angles.size(); ++k) hot.angles[k] += turn(double(k) / 3.0);
    for (const auto& [at, weight] : seven_points) {
      const double angle = angle_inside(cold, at);
      hot.chord += weight * h * (unit_tangent(angle + turn(at)) - unit_tangent(angle));
    }
  }
  hot.length *= longer;
  hot.chord *= longer;
  return hot;
}

// The growth of the chord's length and the turns of the ends against it, all since the stress-free state, by the six
// unknowns; and the chord itself.
struct ChordMotion {
  Jet<6> stretch{}, turn1{}, turn2{}, x{}, z{}, length{};
};

ChordMotion chord_motion(const Stretch& cold, const Stretch& rest, const EndsMotion& motion) {
  const auto unknown = [](std::size_t i, double value) { return Jet<6>::variable(i, value); };
  const Jet<6> x = unknown(3, motion.second.x()) - unknown(0, motion.first.x());
  const Jet<6> z = unknown(4, motion.second.y()) - unknown(1, motion.first.y());
  const Vec2 from_rest = cold.chord - rest.chord;  // exactly 0 without heat
  const Jet<6> dx = x + from_rest.x(), dz = z + from_rest.y();
  ChordMotion out{.x = dx + rest.chord.x(), .z = dz + rest.chord.y()};
  out.length = sqrt(out.x * out.x + out.z * out.z);
  out.stretch = (dx * (out.x + rest.chord.x()) + dz * (out.z + rest.chord.y())) / (out.length + rest.chord.norm());
  const Jet<6> turn =
      atan2(rest.chord.x() * out.z - rest.chord.y() * out.x, rest.chord.x() * out.x + rest.chord.y() * out.z);
  out.turn1 = within_half_a_turn(unknown(2, motion.turn1 + cold.angles.front() - rest.angles.front()) - turn);
  out.turn2 = within_half_a_turn(unknown(5, motion.turn2 + cold.angles.back() - rest.angles.back()) - turn);
  return out;
}

using Three = Jet<3>;  // by the stretch of the chord and the turns of the ends against it

struct ThreeVariables {
  Three stretch{}, turn1{}, turn2{};
};

ThreeVariables three_variables(const ChordMotion& at) {
  return {.stretch = Three::variable(0, at.stretch.value),
          .turn1 = Three::variable(1, at.turn1.value),
          .turn2 = Three::variable(2, at.turn2.value)};
}

// What θ = b x + σ (x² − 1/12), |x| ≤ ½, the slope of Hermite's cubic, tells of an inextensible axis to the fourth
// order, with means ⟨⟩ along it. For the mean sine to be 0 the angle is θ + a (1 − 6 (x² − 1/12)), and then
//
//   a = ⟨θ³⟩/6,   c = σ − 6a,   q = ½⟨θ²⟩,   ⟨cos⟩ = 1 − q + Q,   Q = ⟨θ⁴⟩/24 − a ⟨θ (1 − 6 (x² − 1/12))⟩
struct Bend {
  Three q, c, shortening;
};

Bend bend_of(const Three& b, const Three& sigma) {
  std::array<Three, 5> angle;
  Three square, cube, fourth;
  for (std::size_t g = 0; g < angle.size(); ++g) {
    const auto [at, weight] = five_points[g];
    const double x = at - 0.5;
    angle[g] = x * b + (x * x - 1.0 / 12.0) * sigma;
    const Three here = angle[g] * angle[g];
    square += weight * here;
    cube += weight * (here * angle[g]);
    fourth += weight * (here * here);
  }
  const Three a = 1.0 / 6.0 * cube;
  Three correction;  // of ½⟨θ²⟩ by a
  for (std::size_t g = 0; g < angle.size(); ++g) {
    const double x = five_points[g].at - 0.5;
    correction += five_points[g].weight * (1.0 - 6.0 * (x * x - 1.0 / 12.0)) * angle[g];
  }
  const Three q = 0.5 * square, Q = 1.0 / 24.0 * fourth - correction * a;
  return {.q = q, .c = sigma - 6.0 * a, .shortening = q + q * q - Q};
}

// An element of a slender beam with what it is at rest.
struct AtRest {
  Stretch stretch{};
  double slope1 = 0.0, slope2 = 0.0;  // of the ends against the chord
  double stiffer = 1.0;               // EA and EI by the length without force
};

AtRest at_rest(const SlenderElement& element) {
  AtRest out{.stretch = freed(element.stretch, element.free), .stiffer = 1.0 + element.free.strain};
  const double direction = direction_of(out.stretch.chord);
  out.slope1 = std::remainder(out.stretch.angles.front() - direction, 2.0 * pi);
  out.slope2 = std::remainder(out.stretch.angles.back() - direction, 2.0 * pi);
  return out;
}

// (2.3): the axial strain, the curvature, and the tilt a of the chord under the force V across it, of which the mixed
// functional is stationary:
//
//   −2 EI (σ − σ⁰) a/h + 6 EI a²/h − V l a − V² h q/EA
struct Classic {
  Three energy{}, V{};
  Bend now{};
};

Classic classic_energy(const SlenderElement& element, const AtRest& rest, const ThreeVariables& z) {
  const PlainStiffness section = element.section(0.5);
  const double EA = rest.stiffer * section.EA, EI = rest.stiffer * section.EI;
  const double h = rest.stretch.length, l0 = rest.stretch.chord.norm();
  const double b0 = rest.slope2 - rest.slope1, sigma0 = 3.0 * (rest.slope1 + rest.slope2);
  const Three db = z.turn2 - z.turn1, dsigma = 3.0 * (z.turn1 + z.turn2), l = z.stretch + l0;
  const Bend before = bend_of(b0, sigma0);
  Classic out{.now = bend_of(db + b0, dsigma + sigma0)};
  const Bend& now = out.now;
  const Three strain = 1.0 / h * (z.stretch * (1.0 + now.shortening) + l0 * (now.shortening - before.shortening));
  out.energy = 0.5 * EA * h * (strain * strain);
  for (const auto& [at, weight] : two_points) {
    const Three curvature = db + 2.0 * (at - 0.5) * (now.c - before.c);
    out.energy += 0.5 * EI / h * weight * (curvature * curvature);
  }
  out.V = -2.0 * EI / h * dsigma / (l + 24.0 * EI / EA * now.q / l);
  const Three a = -2.0 * h / EA * (out.V * now.q) / l;
  out.energy += -1.0 * EI / h * (dsigma * a);  // half of the linear term, where it is stationary
  return out;
}

// --- the mixed element ----------------------------------------------------------------------------------------------

// By the stretch of the chord, the turns of the ends against it, and the inner unknowns a₂ − a₂⁰, a₃ − a₃⁰, e and v.
using Seven = Jet<7>;
using Inner = Eigen::Vector4d;
constexpr std::size_t outer_count = 3, inner_count = 4;

// The angle since rest at x = ξ − ½, and x-derivative of it, by these.
std::array<double, inner_count> turn_shapes(double x) { return {0.5 - x, 0.5 + x, x * x - 0.25, x * (x * x - 0.25)}; }
std::array<double, inner_count> turn_slopes(double x) { return {-1.0, 1.0, 2.0 * x, 3.0 * x * x - 0.25}; }

Seven combined(const std::array<double, inner_count>& shapes, const std::array<Seven, 7>& q) {
  Seven sum;
  for (std::size_t i = 0; i < shapes.size(); ++i) sum += shapes[i] * q[i + 1];
  return sum;
}

// The mixed element (2.8) at its Gauss points.
class MixedElement {
 public:
  MixedElement(const SlenderElement& element, const AtRest& rest) : element_(element), rest_(rest) {
    const PlainStiffness middle = element.section(0.5);
    EA_ = rest.stiffer * middle.EA;
    const double direction = direction_of(rest.stretch.chord);
    const double turns = rest.slope1 - (rest.stretch.angles.front() - direction);  // whole ones
    // An added quartic gives the interpolated angle the chord's direction, ∫ sin θ⁰ = 0; its own integral is −1/270.
    for (const auto& [at, weight] : seven_points)
      quartic_ += 270.0 * weight * std::sin(angle_inside(rest.stretch, at) - direction + turns);
    angle_against_ = turns - direction;
    for (std::size_t g = 0; g < seven_points.size(); ++g) {
      const double at = seven_points[g].at;
      const PlainStiffness here = element.section(at);
      angles_[g] = rest_angle(at);
      softness_[g] = middle.EA / here.EA;
      bending_[g] = rest.stiffer * here.EI;
    }
  }

  double EA() const { return EA_; }
  double EA_at(double fraction) const { return rest_.stiffer * element_.section(fraction).EA; }

  // θ⁰ against the stress-free chord.
  double rest_angle(double fraction) const {
    const double square = (fraction - 0.5) * (fraction - 0.5);
    return angle_inside(rest_.stretch, fraction) + angle_against_ + quartic_ * (square - 0.25) * (square - 1.0 / 36.0);
  }

  // Π/EA of (2.8).
  Seven functional(const ThreeVariables& z, const Inner& y) const {
    std::array<Seven, 7> q;
    const std::array<double, 7> values{z.stretch.value, z.turn1.value, z.turn2.value, y[0], y[1], y[2], y[3]};
    for (std::size_t i = 0; i < q.size(); ++i) q[i] = Seven::variable(i, values[i]);
    const double h = rest_.stretch.length;
    Seven sum = q[5] * q[0];  // e (l − l₀)
    for (std::size_t g = 0; g < seven_points.size(); ++g) {
      const double x = seven_points[g].at - 0.5, weight = seven_points[g].weight;
      const Seven curvature = combined(turn_slopes(x), q), turn = combined(turn_shapes(x), q);
      sum += 0.5 * weight * bending_[g] / (EA_ * h) * (curvature * curvature);
      sum += -h * weight * composed<3, 7>(stretching(g, turn.value, y[2], y[3]), {turn, q[5], q[6]});
    }
    return sum;
  }

 private:
  // e Δcos θ + v Δsin θ + ½ a ν² by the turn since rest, e and v.
  Three stretching(std::size_t g, double turn, double e_value, double v_value) const {
    const Three half = 0.5 * Three::variable(0, turn), e = Three::variable(1, e_value), v = Three::variable(2, v_value);
    const Three middle = half + angles_[g], growth = 2.0 * sin(half);
    const Three dcos = -sin(middle) * growth, dsin = cos(middle) * growth;
    const Three nu = e * (dcos + std::cos(angles_[g])) + v * (dsin + std::sin(angles_[g]));
    return e * dcos + v * dsin + 0.5 * softness_[g] * (nu * nu);
  }

  const SlenderElement& element_;
  const AtRest& rest_;
  double EA_ = 0.0, quartic_ = 0.0, angle_against_ = 0.0;
  std::array<double, 7> angles_{}, softness_{}, bending_{};
};

// Second derivatives of Π/EA: of the inner unknowns, and of these with the outer ones. In the angle of order 4 a₃ keeps
// its stress-free value.
struct InnerSystem {
  Eigen::Matrix4d matrix;
  Inner slope;
  Eigen::Matrix<double, 4, 3> coupling;

  InnerSystem(const Seven& of, AxisAngle angle) {
    for (std::size_t i = 0; i < inner_count; ++i) {
      const auto row = static_cast<Index>(i);
      slope[row] = of.slope[outer_count + i];
      for (std::size_t j = 0; j < inner_count; ++j)
        matrix(row, static_cast<Index>(j)) = of.second(outer_count + i, outer_count + j);
      for (std::size_t j = 0; j < outer_count; ++j)
        coupling(row, static_cast<Index>(j)) = of.second(outer_count + i, j);
    }
    if (angle == AxisAngle::cubic) return;
    matrix.row(1).setZero();
    matrix.col(1).setZero();
    matrix(1, 1) = 1.0;
    slope[1] = 0.0;
    coupling.row(1).setZero();
  }
};

// Where Π is stationary in its inner unknowns; NaN if Newton's method does not arrive.
struct Mixed {
  Three energy{};
  Inner inner = Inner::Constant(std::numeric_limits<double>::quiet_NaN());
  Eigen::Matrix<double, 4, 3> inner_slope = Eigen::Matrix<double, 4, 3>::Zero();  // ∂y/∂z
};

// Without force across: the angle bends so that its mean sine stays 0 to first order, and the axis takes up the rest.
Inner first_guess(const MixedElement& element, const AtRest& rest, const ThreeVariables& z) {
  Inner y(3.0 * (z.turn1.value + z.turn2.value), 0.0, 0.0, 0.0);
  double length = 0.0, square = 0.0;
  for (const auto& [at, weight] : seven_points) {
    const std::array<double, inner_count> shapes = turn_shapes(at - 0.5);
    const double before = element.rest_angle(at);
    const double now = before + shapes[0] * z.turn1.value + shapes[1] * z.turn2.value + shapes[2] * y[0];
    length += weight * (std::cos(now) - std::cos(before));
    square += weight * element.EA() / element.EA_at(at) * std::cos(now) * std::cos(now);
  }
  y[2] = (z.stretch.value / rest.stretch.length - length) / square;
  return y;
}

// Newton's method; then, by the theorem of implicit functions,
//
//   ∂²U/∂z² = Π_zz + Π_zy ∂y/∂z,     ∂y/∂z = −Π_yy⁻¹ Π_yz                                                 (2.10)
Mixed mixed_energy(const MixedElement& mixed, AxisAngle angle, const AtRest& rest, const ThreeVariables& z) {
  constexpr int most_iterations = 50;
  constexpr double arrived = 1e-9;  // last correction: what it leaves is of the order of its square
  Inner y = first_guess(mixed, rest, z);
  double correction = infinity;
  for (int i = 0; i < most_iterations; ++i) {
    const Seven functional = mixed.functional(z, y);
    const InnerSystem system(functional, angle);
    const Eigen::PartialPivLU<Eigen::Matrix4d> factors(system.matrix);
    if (correction <= arrived * (1.0 + y.cwiseAbs().maxCoeff())) {
      Mixed out{.energy = mixed.EA() * functional.value, .inner = y, .inner_slope = -factors.solve(system.coupling)};
      const Eigen::Matrix3d condensed = system.coupling.transpose() * out.inner_slope;
      for (std::size_t r = 0, k = 0; r < outer_count; ++r) {
        out.energy.slope[r] = mixed.EA() * functional.slope[r];
        for (std::size_t c = 0; c <= r; ++c, ++k)
          out.energy.bend[k] =
              mixed.EA() * (functional.second(r, c) + condensed(static_cast<Index>(r), static_cast<Index>(c)));
      }
      return out;
    }
    const Inner step = factors.solve(system.slope);
    y -= step;
    correction = step.cwiseAbs().maxCoeff();
  }
  return {.energy = std::numeric_limits<double>::quiet_NaN()};
}

}  // namespace

LocalEnergy slender_energy(const SlenderElement& element, const EndsMotion& motion) {
  const AtRest rest = at_rest(element);
  const ChordMotion at = chord_motion(element.stretch, rest.stretch, motion);
  const ThreeVariables z = three_variables(at);
  const Three energy = element.angle == AxisAngle::expanded
                           ? classic_energy(element, rest, z).energy
                           : mixed_energy(MixedElement(element, rest), element.angle, rest, z).energy;
  return LocalEnergy(composed<3, 6>(energy, {at.stretch, at.turn1, at.turn2}));
}

// --- places inside --------------------------------------------------------------------------------------------------

namespace {

// The angle against the chord along an axis and the force along the chord and across it, by the three variables: of
// each the value and the first derivatives alone.
struct BentAxis {
  std::function<Three(double)> angle;  // at a fraction
  Three along, across;
  std::function<double(double)> EA;  // by the length without force
};

// A quantity that depends on first derivatives of an energy.
Three slope_of(const Three& energy, std::size_t variable) {
  Three out(energy.slope[variable]);
  for (std::size_t i = 0; i < out.variables; ++i) out.slope[i] = energy.second(variable, i);
  return out;
}

BentAxis classic_axis(const SlenderElement& element, const AtRest& rest, const ThreeVariables& z) {
  const Classic classic = classic_energy(element, rest, z);
  const PlainStiffness section = element.section(0.5);
  const double EA = rest.stiffer * section.EA;
  const Three l = z.stretch + rest.stretch.chord.norm();
  // Σ of the end moments over the chord; the turns' mean is σ/6.
  const Three N = slope_of(classic.energy, 0);
  const Three V = -1.0 * (slope_of(classic.energy, 1) + slope_of(classic.energy, 2)) / l;
  const Three slope1 = z.turn1 + rest.slope1, slope2 = z.turn2 + rest.slope2;
  const Three b = slope2 - slope1, mean = 0.5 * (slope1 + slope2);
  const Three c = classic.now.c + 12.0 * (classic.now.q * V) / (N + EA);
  return {.angle =
              [=](double fraction) {
                const double x = fraction - 0.5;
                return mean + x * b + (x * x - 0.25) * c;
              },
          .along = N,
          .across = V,
          .EA = [=](double) { return EA; }};
}

BentAxis mixed_axis(const SlenderElement& element, const AtRest& rest, const ThreeVariables& z) {
  const auto mixed = std::make_shared<const MixedElement>(element, rest);
  const Mixed found = mixed_energy(*mixed, element.angle, rest, z);
  const auto inner = [&](Index i) {
    Three out(found.inner[i]);
    for (std::size_t j = 0; j < out.variables; ++j) out.slope[j] = found.inner_slope(i, static_cast<Index>(j));
    return out;
  };
  const Three a2 = inner(0), a3 = inner(1);
  return {.angle =
              [=](double fraction) {
                const std::array<double, inner_count> shapes = turn_shapes(fraction - 0.5);
                return shapes[0] * z.turn1 + shapes[1] * z.turn2 + shapes[2] * a2 + shapes[3] * a3 +
                       mixed->rest_angle(fraction);
              },
          .along = mixed->EA() * inner(2),
          .across = mixed->EA() * inner(3),
          .EA = [=](double fraction) { return mixed->EA_at(fraction); }};
}

// ∫ h (1 + N/EA) (cos θ, sin θ) to a fraction.
std::array<Three, 2> path_to(const BentAxis& axis, double length, double fraction) {
  std::array<Three, 2> path;
  for (const auto& [at, weight] : seven_points) {
    const Three angle = axis.angle(fraction * at), cosine = cos(angle), sine = sin(angle);
    const Three stretch = 1.0 + 1.0 / axis.EA(fraction * at) * (axis.along * cosine + axis.across * sine);
    path[0] += fraction * weight * length * (stretch * cosine);
    path[1] += fraction * weight * length * (stretch * sine);
  }
  return path;
}

}  // namespace

// The path from the first end with a share of what it misses the second by, in the frame of the chord.
PlaceInside place_inside(const SlenderElement& element, const EndsMotion& motion, double fraction) {
  const AtRest rest = at_rest(element);
  const ChordMotion at = chord_motion(element.stretch, rest.stretch, motion);
  const ThreeVariables z = three_variables(at);
  const BentAxis axis =
      element.angle == AxisAngle::expanded ? classic_axis(element, rest, z) : mixed_axis(element, rest, z);
  const std::array<Three, 2> here = path_to(axis, rest.stretch.length, fraction);
  const std::array<Three, 2> end = path_to(axis, rest.stretch.length, 1.0);
  const std::array<Jet<6>, 3> by_ends{at.stretch, at.turn1, at.turn2};
  const Three chord = z.stretch + rest.stretch.chord.norm();
  const Jet<6> along = composed<3, 6>(here[0] + fraction * (chord - end[0]), by_ends);
  const Jet<6> across = composed<3, 6>(here[1] - fraction * end[1], by_ends);
  const Jet<6> cosine = at.x / at.length, sine = at.z / at.length;
  const std::array<Jet<6>, 2> offset{cosine * along - sine * across, sine * along + cosine * across};
  PlaceInside out{.offset = {offset[0].value, offset[1].value}};
  for (Index row = 0; row < 2; ++row)
    for (Index i = 0; i < 6; ++i)
      out.gradient(row, i) = offset[static_cast<std::size_t>(row)].slope[static_cast<std::size_t>(i)];
  for (const Index i : {0, 1}) out.gradient(i, i) += 1.0;  // of the first end itself
  return out;
}

}  // namespace arcwall::verify
