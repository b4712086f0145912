#include "elements/heated_beam.hpp"

#include <algorithm>

namespace arcwall {

// The energy is of the first degree in both stiffnesses, so that these, which are s EA and s EI, add f s′/s to the
// rate.
Eigen::Matrix<double, 6, 1> heat_rate(const StretchReference& cold, const SlenderSection& section,
                                      const ThermalStrain& thermal, double lambda, const BeamEnds& ends) {
  const HeatedStretch hot = heated(cold, thermal, lambda);
  BeamResponse response;
  with_slender_beam(hot.by_lambda, section, hot.stiffer, [&](const auto& beam) { beam.respond(ends, true, response); });
  return at_ends(Eigen::Vector4d(response.force_rate[0] + hot.stiffer_rate / hot.stiffer * response.force));
}

double HeatedBeam::evaluate_at(const double* u, double lambda, double* f, double* K, double* f_lambda) const {
  const BeamEnds ends{.chord = cold_.chord + Vec2(u[3] - u[0], u[4] - u[1]),
                      .angle1 = cold_.angles.front() + u[2],
                      .angle2 = cold_.angles.back() + u[5]};
  const HeatedStretch hot = heated(cold_, thermal_, lambda);
  BeamResponse response;
  with_slender_beam(hot.reference, section_, hot.stiffer,
                    [&](const auto& beam) { beam.respond(ends, false, response); });
  const auto copy = [](const auto& from, double* to) {
    if (to != nullptr) std::copy_n(from.data(), from.size(), to);
  };
  copy(at_ends(response.force), f);
  copy(at_ends(response.stiffness), K);
  if (f_lambda != nullptr) copy(heat_rate(cold_, section_, thermal_, lambda, ends), f_lambda);
  return response.energy;
}

double HeatedReissnerBeam::evaluate_at(const double* u, double lambda, double* f, double* K, double* f_lambda) const {
  return beam_.evaluate(u, {.strain = thermal_.strain.at(lambda), .curvature = thermal_.curvature.at(lambda)}, f, K,
                        {.strain = thermal_.strain.proportional, .curvature = thermal_.curvature.proportional},
                        f_lambda);
}

double HeatedTruss::evaluate_at(const double* u, double lambda, double* f, double* K, double* f_lambda) const {
  double by_strain[4];
  const double U = bar_.evaluate(u, thermal_.at(lambda), f, K, by_strain);
  for (int i = 0; i < 4 && f_lambda != nullptr; ++i) f_lambda[i] = thermal_.proportional * by_strain[i];
  return U;
}

}  // namespace arcwall
