#include "apps/verify/energy_balance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "apps/verify/differences.hpp"
#include "continuation/path_tolerances.hpp"

namespace arcwall::verify {

namespace {

// The points of a smooth part of a branch, by their numbers in the record: the first and the last included. A kink of
// the path is between two points that coincide.
struct Piece {
  std::size_t first = 0, last = 0;
};

std::vector<Piece> pieces_of(const Record& record, Index branch) {
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < record.points.size(); ++i) {
    const RecordPoint& point = record.points[i];
    if (point.branch != branch) continue;
    const bool is_kink = point.step > 0 && point.arc - record.points[i - 1].arc <= coincidence_tolerance;
    if (point.step > 0 && !is_kink) pieces.back().last = i;
    if (point.step == 0 || is_kink || point.rates_after) pieces.push_back({.first = i, .last = i});
  }
  std::erase_if(pieces, [](const Piece& piece) { return piece.first == piece.last; });
  return pieces;
}

// An integral over a step with the error of its quadrature.
struct Quadrature {
  double value = 0.0, error = 0.0;

  Quadrature& operator+=(const Quadrature& other) {
    value += other.value;
    error += other.error;
    return *this;
  }
};

// A quantity at the points of a piece, with their arc lengths.
using Samples = std::vector<double>;

// Lagrange's polynomial through points [from, from + count), or its slope.
double polynomial(const Samples& s, const Samples& f, std::size_t from, std::size_t count, double at, bool slope) {
  double sum = 0.0;
  for (std::size_t i = from; i < from + count; ++i) {
    double basis = 1.0, of_slope = 0.0;
    for (std::size_t j = from; j < from + count; ++j) {
      if (j == i) continue;
      of_slope = (of_slope * (at - s[j]) + basis) / (s[i] - s[j]);
      basis *= (at - s[j]) / (s[i] - s[j]);
    }
    sum += f[i] * (slope ? of_slope : basis);
  }
  return sum;
}

// ∫ a db over the step behind point i, with polynomials through `count` points about it.
double integral(const Samples& s, const Samples& a, const Samples& b, std::size_t i, std::size_t count) {
  constexpr std::array<std::pair<double, double>, 4> gauss{{{0.0694318442029737, 0.1739274225687269},
                                                            {0.3300094782075719, 0.3260725774312731},
                                                            {0.6699905217924281, 0.3260725774312731},
                                                            {0.9305681557970263, 0.1739274225687269}}};
  const std::size_t before = std::min(i, (count - 1) / 2), from = std::min(i - before, s.size() - count);
  const double length = s[i + 1] - s[i];
  double sum = 0.0;
  for (const auto& [u, weight] : gauss) {
    const double at = s[i] + u * length;
    sum += weight * length * polynomial(s, a, from, count, at, false) * polynomial(s, b, from, count, at, true);
  }
  return sum;
}

Quadrature integral(const Samples& s, const Samples& a, const Samples& b) {
  constexpr std::size_t most = 4;
  const std::size_t count = std::min(most, s.size());
  Quadrature sum;
  for (std::size_t i = 0; i + 1 < s.size(); ++i) {
    const double value = integral(s, a, b, i, count);
    const double coarse = count > 2 ? integral(s, a, b, i, 2) : a[i] * (b[i + 1] - b[i]);
    sum += {.value = value, .error = std::abs(value - coarse)};
  }
  return sum;
}

// A derivative, and by how much two differences of it differ.
struct Rate {
  double value = 0.0, error = 0.0;
};

// f′(0) by differences of order 4 over shorter and shorter steps h (after Ridders, Adv. Eng. Softw. 4, 1982). How much
// two in a row differ is the error of the formula or round-off, which is c/h: so an error is at least what any shorter
// step shows of c. The value of the least error is taken. f is NaN where a step is too long for it.
Rate refined_derivative(const auto& f, double longest) {
  constexpr std::size_t steps = 9;
  constexpr double shorter = 0.25;
  std::array<double, steps> h{}, value{};
  for (std::size_t i = 0; i < steps; ++i) {
    h[i] = i == 0 ? longest : shorter * h[i - 1];
    value[i] = derivative(f, h[i]);
  }
  Rate best{.value = std::numeric_limits<double>::quiet_NaN(), .error = std::numeric_limits<double>::infinity()};
  double c = 0.0;
  for (std::size_t i = steps - 1; i > 0 && std::isfinite(value[i - 1]); --i) {
    c = std::max(c, std::abs(value[i] - value[i - 1]) * h[i]);
    if (i + 1 == steps) continue;  // one alone may agree by chance
    if (c / h[i] < best.error) best = {.value = value[i], .error = c / h[i]};
  }
  return best;
}

// By how much λ does work on the structure: ∂Π/∂λ with the unknowns and the places of contacts on walls held.
Rate work_rate(const Model& model, const State& state, double longest) {
  Rate rate = refined_derivative(
      [&](double h) {
        State moved = state;
        moved.lambda += h;
        return model.system().energy(moved);
      },
      longest);
  if (model.compliant() != nullptr) return rate;  // walls and slips are part of Π
  if (const SlidingContact* const sliding = model.sliding()) {
    Linearization now;
    sliding->linearize(state, now);  // the rows of forces have the rates of gaps and places, with the other sign
    for (Index j = 0; j < static_cast<Index>(state.active_set.contacts()); ++j)
      for (const auto force :
           {sliding->enforcement(state.active_set, j).multiplier, sliding->friction_index(state.active_set, j)})
        if (force) rate.value += state.x[*force] * now.F_lambda[*force];
    return rate;
  }
  const MultiplierContact& contacts = *model.contact();
  Gap field;
  for (Index j = 0; j < contacts.contact_count(); ++j) {
    const auto p = contacts.multiplier_index(state.active_set, j);
    if (!p) continue;
    contacts.candidate(j).gap(state, field);
    rate.value -= state.x[*p] * field.rate;
    const auto T = contacts.friction_index(state.active_set, j);
    if (!T) continue;
    contacts.candidate(j).place(state, 0.0, field);
    rate.value -= state.x[*T] * field.rate;
  }
  return rate;
}

// The friction force of each contact of a piece at one of its points. At the last one contacts may have come together,
// parted or moved to ends: those that have become one share its force, and one that has parted has that of all.
std::map<Index, double> friction_forces(const SlidingContact& contacts, const State& within, const State& at) {
  const auto rubbing = [](const State& state) {
    std::vector<Index> found;
    for (Index j = 0; j < static_cast<Index>(state.active_set.contacts()); ++j)
      if (rubs(state.active_set, static_cast<std::size_t>(j))) found.push_back(j);
    return found;
  };
  std::map<Index, std::vector<Index>> have_become;  // of each contact there those of the piece
  for (const Index j : rubbing(within))
    if (const auto there = contacts.counterpart(within, j, at)) have_become[*there].push_back(j);
  std::map<Index, double> forces;
  for (const Index i : rubbing(at)) {
    const double T = contacts.friction_force(at, i);
    const auto known = have_become.find(i);
    if (known == have_become.end()) {
      if (const auto from = contacts.counterpart(at, i, within)) forces[*from] += T;
      continue;
    }
    for (const Index j : known->second) forces[j] += T / double(known->second.size());
  }
  return forces;
}

// −∫ T (dw − Λ ds) of the contacts that move along members, and of the ends of these.
Quadrature dissipated_while_moving(const SlidingContact& contacts, const std::vector<const RecordPoint*>& points,
                                   const Samples& arc) {
  Quadrature sum;
  const State& within = points[points.size() / 2]->state;
  std::vector<std::map<Index, double>> forces;
  for (const RecordPoint* point : points) forces.push_back(friction_forces(contacts, within, point->state));
  for (Index j = 0; j < static_cast<Index>(within.active_set.contacts()); ++j) {
    if (std::none_of(forces.begin(), forces.end(), [j](const auto& at) { return at.contains(j); })) continue;
    const double round = contacts.round_length(within.active_set, j);
    Samples against, against_rolled, w, s;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const State& state = points[i]->state;
      const auto there = contacts.counterpart(within, j, state);
      if (!there) break;
      ContactPlace place = contacts.place(state, *there);
      if (round > 0.0 && !w.empty()) place.w += round * std::round((w.back() - place.w) / round);
      const double T = forces[i].contains(j) ? forces[i].at(j) : 0.0;
      against.push_back(-T);
      against_rolled.push_back(T * place.stretch);
      w.push_back(place.w);
      s.push_back(place.s);
    }
    if (w.size() != points.size()) continue;
    sum += integral(arc, against, w);
    if (contacts.rolls(within.active_set, j)) sum += integral(arc, against_rolled, s);
  }
  return sum;
}

// Σ μ P |Δw| of the material points on compliant walls, P the mean of both ends of a step, and by how much another mean
// may differ.
Quadrature dissipated_at_points(const CompliantFriction& friction, const std::vector<const RecordPoint*>& points,
                                Findings& findings) {
  Quadrature sum;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const auto& from = friction.committed_points(points[i]->state);
    const auto& to = friction.committed_points(points[i + 1]->state);
    double against = 0.0;
    for (std::size_t k = 0; k < to.size(); ++k) {
      if (from[k].most == 0.0 && to[k].most == 0.0) continue;
      const double way = to[k].slip - (from[k].most > 0.0 ? from[k].slip : 0.0);
      sum += {.value = 0.5 * (from[k].most + to[k].most) * std::abs(way),
              .error = 0.5 * std::abs(to[k].most - from[k].most) * std::abs(way)};
      against = std::max(against, to[k].force * way);
    }
    findings.compare("friction opposes slip", against, 1e-9 * std::abs(sum.value));
  }
  return sum;
}

// −∫ T dw of all contacts along a piece, from what the states tell of T and w.
Quadrature dissipated(const Model& model, const std::vector<const RecordPoint*>& points, const Samples& s) {
  if (model.sliding() != nullptr) return dissipated_while_moving(*model.sliding(), points, s);
  const MultiplierContact& contacts = *model.contact();
  Quadrature sum;
  for (Index j = 0; j < contacts.contact_count(); ++j) {
    const auto is_closed = [j](const RecordPoint* point) {
      return point->state.active_set[static_cast<std::size_t>(j)] != 0;
    };
    if (!contacts.is_rough(j) || std::none_of(points.begin(), points.end(), is_closed)) continue;
    Samples against, place;
    Gap field;
    for (const RecordPoint* point : points) {
      const double last = place.empty() ? 0.0 : place.back();
      const bool faces = contacts.candidate(j).faces_wall(point->state);
      if (faces) contacts.candidate(j).place(point->state, last, field);
      place.push_back(faces ? field.value : last);
      against.push_back(-contacts.friction_force(point->state, j));
    }
    sum += integral(s, against, place);
  }
  return sum;
}

}  // namespace

void check_energy_balance(const Model& model, const Record& record, Index branch, Findings& findings) {
  const double unit = model.frame().factor();
  const RecordBranch& of = record.branches.at(static_cast<std::size_t>(branch));
  const double range = of.greatest_lambda - of.least_lambda;
  const double step = 2e-4 * (range > 0.0 ? range : 1.0);
  Quadrature work, friction;
  double dissipated_in_run = 0.0, stored = 0.0, magnitude = 0.0, travelled = 0.0;
  for (const Piece& piece : pieces_of(record, branch)) {
    std::vector<const RecordPoint*> points;
    Samples s, lambda, rate, off;
    for (std::size_t i = piece.first; i <= piece.last; ++i) {
      const RecordPoint& point = record.points[i];
      if (!s.empty() && point.arc <= s.back()) continue;  // the same place again
      points.push_back(&point);
      s.push_back(point.arc);
      lambda.push_back(point.lambda);
      const Rate of_work = work_rate(model, point.state, step);
      rate.push_back(unit * of_work.value);
      off.push_back(unit * of_work.error);
      magnitude = std::max({magnitude, std::abs(point.energy), std::abs(rate.back() * point.lambda)});
    }
    work += integral(s, rate, lambda);
    for (std::size_t i = 0; i + 1 < s.size(); ++i)
      work.error += std::max(off[i], off[i + 1]) * std::abs(lambda[i + 1] - lambda[i]);
    friction += model.compliant() != nullptr
                    ? dissipated_at_points(*model.compliant()->elastic_friction(), points, findings)
                    : dissipated(model, points, s);
    const RecordPoint &from = record.points[piece.first], &to = record.points[piece.last];
    const auto total = [](const RecordPoint& at) {
      return std::accumulate(at.dissipation.begin(), at.dissipation.end(), 0.0);
    };
    stored += to.energy - from.energy;
    travelled += to.arc - from.arc;
    dissipated_in_run += total(to) - total(from);
    for (std::size_t i = piece.first; i < piece.last; ++i)
      for (std::size_t wall = 0; wall < from.dissipation.size(); ++wall)
        findings.compare("dissipation never falls",
                         record.points[i].dissipation[wall] - record.points[i + 1].dissipation[wall], 0.0);
  }
  friction.value *= unit;
  friction.error *= unit;
  // Energies are sums of as many parts as there are unknowns; rates are differences of such over a part of the range.
  // Forces of no motion but round-off do work on the whole path, whose length is that of mean motions.
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  const Structure& structure = model.structure();
  const double of_forces = 10.0 * structure.force_roundoff() * structure.length_scale() * travelled;
  const double roundoff = (1e3 * epsilon * range / step + 1e-12) * magnitude + unit * of_forces;
  findings.compare("friction dissipates −∫ T dw", std::abs(dissipated_in_run - friction.value),
                   friction.error + roundoff);
  findings.compare("work = energy stored + dissipated", std::abs(work.value - stored - dissipated_in_run),
                   work.error + friction.error + roundoff);
}

}  // namespace arcwall::verify
