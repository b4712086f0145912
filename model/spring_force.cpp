#include "model/spring_force.hpp"

namespace arcwall {

SpringLaw::Response SpringForce::at(double stretch) const {
  if (const double* k = std::get_if<double>(&law_))
    return {.energy = 0.5 * *k * stretch * stretch, .force = *k * stretch, .stiffness = *k};
  return std::get<std::shared_ptr<const SpringLaw>>(law_)->at(stretch);
}

double SpringForce::stretch(const State& state) const {
  return second_->value(state) - (first_ ? first_->value(state) : 0.0);
}

double SpringForce::value(const State& state) const { return at(stretch(state)).force; }

Row SpringForce::gradient(const State& state) const {
  const double stiffness = at(stretch(state)).stiffness;
  Row row = second_->gradient(state);
  if (first_) {
    const Row other = first_->gradient(state);
    row.dx -= other.dx;
    row.dlambda -= other.dlambda;
  }
  row.dx *= stiffness;
  row.dlambda *= stiffness;
  return row;
}

}  // namespace arcwall
