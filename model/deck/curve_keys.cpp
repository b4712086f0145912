// The event that `trace-path curve` follows.
#include <algorithm>
#include <string>

#include "core/text.hpp"
#include "model/deck/deck_keys.hpp"
#include "model/deck/value.hpp"

namespace arcwall::deck {

namespace {

void event_keys(Keys& keys, EventToFollow& curve) {
  keys.word("kind", curve.event, curve_event_words,
            "`\"limit-point\"`, `\"branch-point\"`, `\"contact-closes\"`, `\"contact-spreads\"`, "
            "`\"contact-splits\"`, `\"contact-shrinks\"`, `\"contacts-merge\"`, `\"contact-limit-point\"`, "
            "`\"turning-point\"` or `\"value-crossing\"`");
  keys.integer(optional("number"), curve.number, {.low = 1},
               "which of that kind, counted from 1 in the order of `events.txt`");
}

void check_range(Keys& keys, const EventToFollow& curve) {
  if (curve.range.size() != 2 || !(curve.range[0] < curve.range[1]))
    return keys.report("range", "is no interval", "give [low, high] with low less than high");
  const auto outside = [&](double value) { return value < curve.range[0] || value > curve.range[1]; };
  const auto found = std::find_if(curve.output_at.begin(), curve.output_at.end(), outside);
  if (found != curve.output_at.end())
    keys.report("output_at", round_trip(*found) + " is outside range", "give values between those of range");
}

// A curve over one number, or the worst of several.
void check_what_varies(Keys& keys, const EventToFollow& curve) {
  if (curve.parameter.empty() == curve.worst.empty())
    return keys.report(curve.parameter.empty() ? "parameter" : "worst",
                       curve.parameter.empty() ? "nothing varies: there is neither parameter nor worst"
                                               : "parameter and worst are two different questions",
                       "give parameter with range for a curve, or worst with radius for the worst combination");
  if (!curve.parameter.empty()) {
    if (!keys.has("range")) return keys.report("range", "is missing: parameter needs it", "add range = [low, high]");
    return check_range(keys, curve);
  }
  if (!curve.radius)
    keys.report("radius", "is missing: worst needs it", "add radius, the norm of what changes the numbers");
}

void keys_of_curve(Keys& keys, EventToFollow& curve) {
  curve.position = keys.position();
  keys.table(
      "event", Form::in_line, [&](Keys& event) { event_keys(event, curve); },
      "the event to follow: `{ kind = \"limit-point\", number = 1 }`");
  keys.text(optional("parameter", "none"), curve.parameter,
            "the key that varies, as in `--set`: `\"wall.upper.profile.z\"`");
  keys.numbers(optional("range", "none"), curve.range, unit::none,
               "of `parameter`: `[low, high]`, with the deck's value inside");
  keys.number(optional("step", "1/100 of range"), curve.step, unit::none, positive,
              "increment of the parameter in the first predictor");
  keys.integer(optional("max_points"), curve.max_points, {.low = 1},
               "limit on points on each side of the deck's value");
  keys.numbers(optional("output_at", "none"), curve.output_at, unit::none,
               "values of the parameter at which a point is output");
  keys.any_texts(optional("worst", "none"), curve.worst,
                 "instead of `parameter`: keys whose combination is sought that lowers the event most");
  keys.number(optional("radius", "none"), curve.radius, unit::none, positive,
              "of `worst`: norm of the changes (root of the sum of squares)");
  if (keys.reads()) check_what_varies(keys, curve);
}

}  // namespace

void declare_curve(Keys& root, Deck& deck) {
  root.part("curve", deck.curve, [&](EventToFollow& curve) {
    root.table(
        optional("curve", "none"), Form::header, [&](Keys& keys) { keys_of_curve(keys, curve); }, "");
  });
}

}  // namespace arcwall::deck
