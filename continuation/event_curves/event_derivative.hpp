#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "continuation/metric.hpp"
#include "continuation/path_point.hpp"
#include "continuation/step/corrector.hpp"
#include "core/system.hpp"

namespace arcwall {

/// A quantity of which a rate is wanted, null where none is, and what round-off makes of its value.
struct RatedQuantity {
  std::shared_ptr<const Observable> value{};
  double roundoff = 0.0;
};

/// The system for one of a few values of a number κ of the model. A derivative by κ is a sum over such samples,
///
///     dQ/dκ = Σ weight · Q(sample)
struct SystemSample {
  const System* system = nullptr;               ///< must outlive its use
  State state{};                                ///< the event's, in the unknowns of this system
  std::shared_ptr<const Observable> watched{};  ///< the quantity that turns or passes a value there, of this system
  std::vector<RatedQuantity> quantities{};      ///< of this system
  double offset = 0.0;                          ///< its value of κ less the event's [κ]
  double weight = 0.0;                          ///< [1/κ]
  double coarse_weight = 0.0;                   ///< the same of differences of a lower order, which tell the error
};

/// dλ/dκ of an event, or in words why there is none, and dm/dκ of quantities m there.
struct EventDerivative {
  std::optional<double> value{};
  std::vector<std::optional<double>> rates{};  ///< of the quantities, in their order; empty: unknown
  std::string why_none{};
  bool steps_too_long = false;  ///< whether samples nearer to the event's κ may tell it better
  double off = 0.0;             ///< then, by which differences of lower order differ
};

/// A rate by differences with the step that serves best, and by how much the next one differs.
struct SettledRate {
  double value = 0.0, off = 0.0;
};

/// How an event moves along λ where a number of the model changes (docs/theory.md, section 12): along the equilibria
/// that fulfil the event's condition. That is a vanishing guard for changes of contact and what turns with them, λ′ = 0
/// for a limit point, m′ = 0 for a monitor m that turns, its value for one that passes a value, and two tangents for a
/// branch point.
class EventDerivatives {
 public:
  /// Of an event of an arc, which lies at the arc's end. `system` must outlive this. `watched`: the quantity that turns
  /// or passes a value there, null at other events.
  EventDerivatives(const System& system, const Arc& arc, const Event& event, std::shared_ptr<const Observable> watched,
                   std::vector<RatedQuantity> quantities, double lambda_scale, const MakeFactorization& factorization);

  /// By one number. The samples lie on both sides of its value.
  EventDerivative by(std::vector<SystemSample> samples);

 private:
  enum class Condition { limit, turning, value, guards, crossing };

  bool begin_regular(const Direction& along);
  bool begin_crossing(const BranchPoint& point);
  double step_on_one_piece(const Direction& d, double longest) const;
  SettledRate bend(const Direction& k, const Direction& d);
  // The change of the equilibrium with κ, and how much of it is unsure.
  struct Response {
    Direction d{}, unsure{};
  };

  template <typename Solve>
  std::optional<Response> followed(const std::vector<SystemSample>& samples, const Solve& solve) const;
  EventDerivative by_condition(const Response& response, const std::vector<SystemSample>& samples);
  double untold_of(const EventDerivative& found) const;
  bool persists(const std::vector<SystemSample>& samples) const;
  SettledRate slope_of(const Response& response, const SettledRate& moves) const;
  std::optional<Direction> along_path(const Vector& f);
  std::optional<Direction> across_crossing(const Vector& f);
  template <typename Quantity>
  SettledRate rate_of(const Row& gradient, const Direction& d, const std::vector<SystemSample>& samples,
                      const Quantity& quantity) const;
  EventDerivative of_motion(const Response& response, const SettledRate& moves,
                            const std::vector<SystemSample>& samples) const;
  Direction along(const Direction& response, double moves) const;
  EventDerivative by_limit(const Response& response, const std::vector<SystemSample>& samples);
  EventDerivative by_value(const Response& response, const std::vector<SystemSample>& samples) const;
  EventDerivative by_guards(const Response& response, const std::vector<SystemSample>& samples) const;
  EventDerivative by_turning(const Response& response, const std::vector<SystemSample>& samples);
  double turning_beside(Corrector& corrector, const Observable& turning, const State& guess, double along) const;
  SettledRate turning_along() const;
  Vector second_derivative(const Direction& k, const Direction& d, double h);
  SettledRate turning_rate(const Direction& d, const Vector& more, double more_of_gradient);
  struct Turned {
    SettledRate slope, moves;
  };
  Turned turned(const SettledRate& along, const SettledRate& rate, const Response& response) const;
  struct TurnedBy {
    Turned equilibria, equations;
    SettledRate rate;
  };
  TurnedBy turned_by(const Response& response, const std::vector<SystemSample>& samples);
  std::vector<std::optional<double>> rates(const Direction& motion, const std::vector<SystemSample>& samples,
                                           const std::vector<Direction>& unsure) const;
  static bool is_settled(const SettledRate& rate, double of, const std::vector<SystemSample>& samples);
  double greatest_work(const Vector& f) const;
  EventDerivative settled(const SettledRate& slope, const std::vector<SystemSample>& samples) const;
  EventDerivative by_crossing(const Response& response, const std::vector<SystemSample>& samples);

  const System& system_;
  Metric metric_;
  double lambda_scale_;
  MakeFactorization factorization_;
  Corrector corrector_;
  Linearization workspace_;
  State state_;
  Condition condition_ = Condition::limit;
  std::string why_none_;
  Direction tangent_;                          // of the path; of a branch point none
  std::shared_ptr<const Observable> watched_;  // what turns or passes a value; λ of a limit point
  std::vector<RatedQuantity> quantities_;
  SettledRate turning_along_;        // the rate of its rate along the path, by equilibria
  SettledRate turning_here_;         // and by the second derivatives of the equations
  std::vector<Index> guards_;        // that vanish
  Vector left_;                      // of a branch point: the left null vector w,
  double load_work_ = 0.0;           // the most work of the loads along it,
  std::vector<Direction> kernel_;    // the null vectors of [J F_λ]: the mode, and one with λ = 1,
  Eigen::Matrix2d bend_, bend_off_;  // and wᵀ D²F of these
};

}  // namespace arcwall
