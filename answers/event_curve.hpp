#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "continuation/path_point.hpp"
#include "model/deck/deck.hpp"
#include "model/record.hpp"
#include "model/shape.hpp"

namespace arcwall {

/// A point of a curve of events.
struct CurvePoint {
  double arc = 0.0;     ///< from the curve's first point [path metric]
  double key = 0.0;     ///< the number of the deck
  double lambda = 0.0;  ///< of the event
  std::vector<double> monitors{};
  std::optional<double> slope{};                ///< dλ/dkey; empty at a cusp
  std::vector<std::optional<double>> slopes{};  ///< the same of the monitors
  std::optional<Index> unstable_before{}, unstable_after{};
  Index contacts = 0;  ///< closed
  Shape shape{};
  std::vector<WallShape> walls{};  ///< where they are at the event
  std::vector<double> heights{};   ///< of the members' sections; 0 if unknown [length]
  State state{};                   ///< the event's, in the unknowns of the model of the deck's own value
};

/// Gives a point what pictures of it show; `model` and `state` are those of its number.
void add_scenery(const Model& model, const State& state, CurvePoint& to);

/// What happens on a curve of events.
enum class CurveSpecialKind {
  begins,    ///< the event comes into being, or is followed no farther; `why` says which
  ends,      ///< the same at the other end
  cusp,      ///< the number turns
  crossing,  ///< the event meets another one
};

struct CurveSpecial {
  CurveSpecialKind kind = CurveSpecialKind::cusp;
  std::size_t point = 0;               ///< of the curve
  std::string why{};                   ///< a sentence without a full stop
  EndReason reason = EndReason::stop;  ///< of begins and ends
};

/// An event of a deck, followed while a number of the deck varies.
struct EventCurve {
  std::string deck{}, title{};
  std::string key{}, key_unit{};
  EventKind event = EventKind::limit_point;
  int number = 1;
  double own_value = 0.0;  ///< of the deck
  std::vector<RecordColumn> columns{};
  std::vector<CurvePoint> points{};
  std::vector<CurveSpecial> specials{};  ///< in the order of their points
  std::string problem{};                 ///< why there is no curve; empty otherwise
};

/// Throws InputError where the event of `[curve]` cannot be followed for what the rest of the deck says; runs of it do
/// not mind.
void require_curve(const deck::Deck& deck);

/// Traces a deck's path up to the event that its `[curve]` names, and then the event in two parameters
/// (docs/theory.md, section 14). `stopped` is asked at each point; true ends the curve. Throws InputError where the
/// deck is wrong.
EventCurve trace_event_curve(const deck::Deck& deck, const std::function<bool()>& stopped);

/// `begins`, `ends`, `cusp` or `crossing`.
std::string_view to_text(CurveSpecialKind kind);

}  // namespace arcwall
