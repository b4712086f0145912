#include "model/friction_at_wall.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace arcwall {

// |T|/(μ p) of a closed contact: 1 of one that slips, whatever round-off says, and 0 of one that only touches.
double FrictionAtWall::use_of(const State& state, Index j) const {
  if (slips(friction_.mode(state.active_set, j))) return 1.0;
  const double most = friction_.coefficient(state.active_set, j) * contacts_.force(state, j);
  return most > 0.0 ? std::abs(friction_.friction_force(state, j)) / most : 0.0;
}

template <typename Visit>
void FrictionAtWall::for_each(const State& state, const Visit& visit) const {
  for (Index j = 0; j < static_cast<Index>(state.active_set.contacts()); ++j)
    if (friction_.friction_index(state.active_set, j) && of_.includes(contacts_.contact(state, j).label)) visit(j);
}

double FrictionAtWall::value(const State& state) const {
  double sum = 0.0;
  std::optional<double> greatest;
  for_each(state, [&](Index j) {
    switch (what_) {
      case What::force:
        sum += friction_.friction_force(state, j);
        break;
      case What::slip:
        sum += friction_.slip(state, j);
        break;
      case What::greatest_use:
        greatest = std::max(greatest.value_or(0.0), use_of(state, j));
        break;
    }
  });
  return what_ == What::greatest_use ? greatest.value_or(std::numeric_limits<double>::quiet_NaN()) : sum;
}

Row FrictionAtWall::gradient(const State& state) const {
  Row row{.dx = Vector::Zero(state.x.size()), .dlambda = 0.0};
  std::optional<Index> most_used;
  for_each(state, [&](Index j) {
    if (what_ == What::force) row.dx[*friction_.friction_index(state.active_set, j)] = 1.0;
    if (what_ == What::slip) row.dx += friction_.slip_gradient(state, j).dx;
    if (!most_used || use_of(state, j) > use_of(state, *most_used)) most_used = j;
  });
  if (what_ != What::greatest_use || !most_used || slips(friction_.mode(state.active_set, *most_used))) return row;
  const double T = friction_.friction_force(state, *most_used), p = contacts_.force(state, *most_used);
  const double most = friction_.coefficient(state.active_set, *most_used) * p;
  if (most <= 0.0) return row;
  row.dx[*friction_.friction_index(state.active_set, *most_used)] = (T < 0.0 ? -1.0 : 1.0) / most;
  row.dx[*friction_.force_index(state.active_set, *most_used)] = -std::abs(T) / (most * p);
  return row;
}

Row FrictionPower::gradient(const State& state) const {
  Row row{.dx = Vector::Zero(state.x.size()), .dlambda = 0.0};
  for (const Index j : friction_.slipping(state.active_set))
    if (wall_.empty() || contacts_.contact(state, j).label.wall == wall_)
      row.dx -= friction_.friction_force(state, j) * friction_.slip_gradient(state, j).dx;
  return row;
}

namespace {

double use_of(const CompliantFriction::Point& point) {
  return point.sense != 0 ? 1.0 : std::abs(point.force) / point.most;
}

}  // namespace

// Those that tell: of slip and of the greatest use one at most.
std::vector<CompliantFriction::Point> ElasticFrictionAtWall::points(const State& state) const {
  std::vector<CompliantFriction::Point> points = contact_.elastic_friction()->points(state);
  std::erase_if(points, [&](const CompliantFriction::Point& point) {
    const auto j = static_cast<Index>(point.pressed->contact);
    return !of_.includes_wall(contact_.wall(j).name) || (!of_.member.empty() && contact_.member_of(j) != of_.member);
  });
  if (what_ == FrictionAtWall::What::force || points.empty()) return points;
  const auto rank = [&](const CompliantFriction::Point& point) {
    return what_ == FrictionAtWall::What::slip ? -std::abs(point.fraction - of_.fraction.value_or(0.5)) : use_of(point);
  };
  return {
      *std::max_element(points.begin(), points.end(), [&](const auto& a, const auto& b) { return rank(a) < rank(b); })};
}

double ElasticFrictionAtWall::value(const State& state) const {
  const auto all = points(state);
  if (what_ == FrictionAtWall::What::greatest_use)
    return all.empty() ? std::numeric_limits<double>::quiet_NaN() : use_of(all.front());
  double sum = 0.0;
  for (const CompliantFriction::Point& point : all)
    sum += what_ == FrictionAtWall::What::slip ? point.slip : point.force;
  return sum;
}

Row ElasticFrictionAtWall::gradient(const State& state) const {
  Row sum{.dx = Vector::Zero(state.x.size()), .dlambda = 0.0};
  const auto add = [&](const Row& row, double factor) {
    sum.dx += factor * row.dx;
    sum.dlambda += factor * row.dlambda;
  };
  for (const CompliantFriction::Point& point : points(state)) {
    const CompliantFriction::Rows rows = contact_.elastic_friction()->rows(state, point);
    if (what_ == FrictionAtWall::What::force) add(rows.force, 1.0);
    if (what_ == FrictionAtWall::What::slip) add(rows.slip, 1.0);
    if (what_ != FrictionAtWall::What::greatest_use || point.sense != 0) continue;
    add(rows.force, (point.force < 0.0 ? -1.0 : 1.0) / point.most);
    add(rows.most, -std::abs(point.force) / (point.most * point.most));
  }
  return sum;
}

Row ElasticFrictionPower::gradient(const State& state) const {
  Row row{.dx = Vector::Zero(state.x.size()), .dlambda = 0.0};
  const CompliantFriction& friction = *contact_.elastic_friction();
  for (const CompliantFriction::Point& point : friction.points(state)) {
    const std::string& name = contact_.wall(static_cast<Index>(point.pressed->contact)).name;
    if (point.sense == 0 || (!wall_.empty() && name != wall_)) continue;
    const Row slip = friction.rows(state, point).slip;
    row.dx -= point.force * slip.dx;
    row.dlambda -= point.force * slip.dlambda;
  }
  return row;
}

}  // namespace arcwall
