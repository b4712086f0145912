#include "apps/explore/traced_curve.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "answers/curve_session.hpp"
#include "apps/explore/lines.hpp"
#include "apps/output/markup.hpp"
#include "core/text.hpp"
#include "model/event_names.hpp"

namespace arcwall::explore {

namespace {

Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

// Of a point the number, λ and its slope.
Json curve_json(const EventCurve& curve) {
  Json points = Json::array(), specials = Json::array();
  for (const CurvePoint& point : curve.points)
    points.push_back({finite(point.key), finite(point.lambda), point.slope ? finite(*point.slope) : Json(nullptr)});
  for (const CurveSpecial& special : curve.specials)
    specials.push_back(
        {{"kind", to_text(special.kind)}, {"point", special.point}, {"why", plain(special.why, most_characters)}});
  return {{"key", plain(curve.key, most_characters)},
          {"unit", plain(curve.key_unit, most_characters)},
          {"event", to_text(curve.event)},
          {"number", curve.number},
          {"own", finite(curve.own_value)},
          {"points", std::move(points)},
          {"specials", std::move(specials)}};
}

// The table [curve], as an assignment.
std::string asked_curve(const Json& request) {
  const auto word = [&](const char* key) { return Json(request.at(key).get<std::string>()).dump(); };
  return fmt::format("curve={{event={{kind={},number={}}},parameter={},range=[{},{}]}}", word("kind"),
                     request.at("number").get<int>(), word("parameter"), round_trip(request.at("low").get<double>()),
                     round_trip(request.at("high").get<double>()));
}

void trace(CurveTracing& curve, double most_seconds, const LineSink& give) {
  constexpr double pause = 0.1;  // between lines [s]
  const auto begin = std::chrono::steady_clock::now();
  double said = 0.0;
  for (int points = 1; curve.advance(); ++points) {
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (seconds >= most_seconds) {
      curve.stop({.reason = EndReason::max_time, .detail = round_trip(most_seconds) + " s"});
      return;
    }
    if (seconds < said + pause) continue;
    said = seconds;
    if (curve.has_begun())
      give_json({{"curve", curve_json(curve.curve())}}, give);
    else
      give_json({{"progress", fmt::format("tracing the path up to the event: {} points", points)}}, give);
  }
}

}  // namespace

void trace_to_curve(const std::string& file, const std::string& request, double most_seconds, const LineSink& give) {
  give_or_say_why_not(give, [&] {
    const Json asked = Json::parse(request);
    CurveSession session({.deck = file,
                          .deck_text = asked.at("text").get<std::string>(),
                          .assignments = {asked_curve(asked)},
                          .traced = Traced::curve});
    trace(session.tracing(), most_seconds, give);
    const EventCurve curve = session.tracing().curve();
    if (!curve.problem.empty()) throw InputError(curve.problem);
    give_json({{"curve", curve_json(curve)}, {"ended", true}}, give);
  });
}

}  // namespace arcwall::explore
