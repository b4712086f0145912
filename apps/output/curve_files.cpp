#include "apps/output/curve_files.hpp"

#include <fmt/format.h>

#include <cmath>
#include <system_error>

#include "apps/output/csv.hpp"
#include "apps/output/events_json.hpp"
#include "apps/output/result_json.hpp"
#include "apps/output/shown_number.hpp"
#include "apps/output/text_table.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "model/event_names.hpp"
#include "model/version.hpp"

namespace arcwall {

using OrderedJson = nlohmann::ordered_json;

namespace {

std::string cell(const std::optional<double>& value) { return value ? round_trip(*value) : ""; }
std::string cell(const std::optional<Index>& value) { return value ? std::to_string(*value) : ""; }

OrderedJson number(double value) { return std::isfinite(value) ? OrderedJson(value) : OrderedJson(nullptr); }

const CurvePoint& point_of(const EventCurve& curve, const CurveSpecial& special) { return curve.points[special.point]; }

OrderedJson special_json(const EventCurve& curve, const CurveSpecial& special) {
  const CurvePoint& point = point_of(curve, special);
  OrderedJson monitors = OrderedJson::object();
  for (std::size_t i = 0; i < point.monitors.size(); ++i) monitors[curve.columns[i].name] = number(point.monitors[i]);
  OrderedJson json;
  json["kind"] = to_text(special.kind);
  json["point"] = special.point;
  json["key"] = number(point.key);
  json["lambda"] = number(point.lambda);
  json["monitors"] = std::move(monitors);
  json["why"] = special.why;
  const bool is_end = special.kind == CurveSpecialKind::begins || special.kind == CurveSpecialKind::ends;
  if (is_end) json["reason"] = to_text(special.reason);
  return json;
}

std::vector<std::vector<std::string>> special_rows(const EventCurve& curve) {
  std::vector<std::vector<std::string>> rows;
  for (const CurveSpecial& special : curve.specials) {
    const CurvePoint& point = point_of(curve, special);
    rows.push_back(
        {std::string(to_text(special.kind)), shown_number(point.key, 12), shown_number(point.lambda, 12), special.why});
  }
  return rows;
}

}  // namespace

std::string followed_event(const EventCurve& curve) {
  return fmt::format("{} {} over {}", to_text(curve.event), curve.number, curve.key);
}

std::string curve_csv(const EventCurve& curve, UnitLabels labels) {
  std::string text = "point,arc," + csv_title("key", curve.key_unit, labels) + ",lambda";
  for (const RecordColumn& column : curve.columns) text += "," + csv_title(column.name, column.unit, labels);
  text += ",slope,unstable_before,unstable_after,contacts";
  for (const RecordColumn& column : curve.columns) text += ",slope-" + column.name;
  text += "\n";
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const CurvePoint& point = curve.points[i];
    text +=
        std::to_string(i) + "," + round_trip(point.arc) + "," + round_trip(point.key) + "," + round_trip(point.lambda);
    for (const double value : point.monitors) text += "," + round_trip(value);
    text += "," + cell(point.slope) + "," + cell(point.unstable_before) + "," + cell(point.unstable_after) + "," +
            std::to_string(point.contacts);
    for (const std::optional<double>& slope : point.slopes) text += "," + cell(slope);
    text += "\n";
  }
  return text;
}

OrderedJson curve_json(const EventCurve& curve, const RunDescription& run) {
  OrderedJson json;
  json["deck"] = deck_json(identity_of(run), curve.title, run.assignments);
  json["version"] = program_version();
  json["event"] = {{"kind", to_text(curve.event)}, {"number", curve.number}};
  json["parameter"] = curve.key;
  json["unit"] = curve.key_unit;
  json["value"] = curve.own_value;
  json["points"] = curve.points.size();
  json["specials"] = OrderedJson::array();
  for (const CurveSpecial& special : curve.specials) json["specials"].push_back(special_json(curve, special));
  return json;
}

NamedTexts curve_files(const EventCurve& curve, const std::vector<LoadText>& loads, UnitLabels labels,
                       const RunDescription& run) {
  return {{"curve.csv", curve_csv(curve, labels)},
          {"report.html", curve_html(curve, loads)},
          {"curve.json", to_text(curve_json(curve, run), JsonLayout::lines)}};
}

void require_no_run(const std::filesystem::path& folder, Foreign foreign) {
  std::error_code ignored;
  if (foreign == Foreign::overwrite || !std::filesystem::exists(folder / "result.json", ignored)) return;
  throw OutputError(folder.string() +
                    ": is the folder of a run, whose report.html the curve's would replace: name another folder with "
                    "--out, or write over it with --force");
}

std::string curve_text(const EventCurve& curve) {
  return fmt::format("{}: {} points\n\n", followed_event(curve), curve.points.size()) +
         text_table({{"special point"}, {"number", TableColumn::Side::right}, {"λ", TableColumn::Side::right}, {"why"}},
                    special_rows(curve));
}

OrderedJson worst_json(const deck::Deck& deck, const WorstCombination& worst, const RunDescription& run) {
  OrderedJson json;
  json["deck"] = deck_json(identity_of(run), deck.title, run.assignments);
  json["version"] = program_version();
  json["event"] = {{"kind", to_text(deck.curve->event)}, {"number", deck.curve->number}};
  json["radius"] = *deck.curve->radius;
  json["own_lambda"] = number(worst.own_lambda);
  json["lambda"] = number(worst.lambda);
  json["settled"] = worst.settled;
  json["runs"] = worst.runs;
  json["worst"] = OrderedJson::array();
  for (std::size_t i = 0; i < worst.keys.size(); ++i)
    json["worst"].push_back({{"key", worst.keys[i]},
                             {"own", number(worst.own[i])},
                             {"value", number(worst.values[i])},
                             {"slope", number(worst.slopes[i])}});
  return json;
}

std::string worst_text(const deck::Deck& deck, const WorstCombination& worst) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < worst.keys.size(); ++i)
    rows.push_back({worst.keys[i], shown_number(worst.own[i], 8), shown_number(worst.values[i], 8),
                    shown_number(worst.slopes[i], 6)});
  const auto figure = [](const char* title) { return TableColumn{title, TableColumn::Side::right}; };
  return fmt::format("{} {}: λ decreases from {} to {} within a radius of {}{}\n\n", to_text(deck.curve->event),
                     deck.curve->number, shown_number(worst.own_lambda, 10), shown_number(worst.lambda, 10),
                     shown_number(*deck.curve->radius, 6),
                     worst.settled ? "" : " (the direction has not converged; this is the lowest λ found)") +
         text_table({{"number"}, figure("deck"), figure("worst"), figure("dλ/dn")}, rows);
}

ExitStatus curve_status(const EventCurve& curve) {
  ExitStatus status = ExitStatus::success;
  for (const CurveSpecial& special : curve.specials) {
    if (special.kind != CurveSpecialKind::begins && special.kind != CurveSpecialKind::ends) continue;
    const ExitStatus one = exit_status(special.reason);
    if (one == ExitStatus::interrupted) return one;
    if (status == ExitStatus::success || one == ExitStatus::limit_met)
      status = one == ExitStatus::success ? status : one;
  }
  return status;
}

}  // namespace arcwall
