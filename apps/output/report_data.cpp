#include "apps/output/report_data.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>

#include "apps/output/event_marks.hpp"
#include "apps/output/events_text.hpp"
#include "apps/output/jump_rows.hpp"
#include "apps/output/markup.hpp"
#include "apps/output/path_lines.hpp"
#include "apps/output/roundoff.hpp"
#include "apps/output/shown_number.hpp"
#include "model/event_names.hpp"

namespace arcwall {

using OrderedJson = nlohmann::ordered_json;

namespace {

// Ten digits are more than a picture shows, and half as long as all of them.
OrderedJson number(double value, int digits = 10) {
  if (!std::isfinite(value)) return nullptr;
  std::array<char, 64> text;
  const auto written = std::to_chars(text.begin(), text.end(), value, std::chars_format::general, digits);
  double rounded = value;
  std::from_chars(text.begin(), written.ptr, rounded);
  return rounded;
}

OrderedJson count(const std::optional<Index>& value) { return value ? OrderedJson(*value) : OrderedJson(nullptr); }

template <class Value>
OrderedJson of_points(const Record& record, Value value) {
  OrderedJson list = OrderedJson::array();
  for (const RecordPoint& point : record.points) list.push_back(value(point));
  return list;
}

// Below which size a quantity is round-off: far below its greatest.
template <class Value>
double roundoff_of(const Record& record, Value value) {
  constexpr double part = 1e-12;
  double greatest = 0.0;
  for (const RecordPoint& point : record.points)
    if (std::isfinite(value(point))) greatest = std::max(greatest, std::abs(value(point)));
  return part * greatest;
}

OrderedJson points_json(const Record& record) {
  const auto energy = [](const RecordPoint& point) { return point.energy; };
  const auto lambda = [](const RecordPoint& point) { return point.lambda; };
  const double no_energy = roundoff_of(record, energy), no_load = roundoff_of(record, lambda);
  const std::vector<double> zero = roundoff(record);
  OrderedJson monitors = OrderedJson::array();
  for (std::size_t i = 0; i < record.columns.size(); ++i)
    monitors.push_back(of_points(
        record, [&, i](const RecordPoint& point) { return number(without_roundoff(point.monitors[i], zero[i])); }));
  return {
      {"branch", of_points(record, [](const RecordPoint& point) { return OrderedJson(point.branch); })},
      {"step", of_points(record, [](const RecordPoint& point) { return OrderedJson(point.step); })},
      {"arc", of_points(record, [](const RecordPoint& point) { return number(point.arc); })},
      {"lambda",
       of_points(record, [&](const RecordPoint& point) { return number(without_roundoff(point.lambda, no_load)); })},
      {"monitors", std::move(monitors)},
      {"unstable", of_points(record, [](const RecordPoint& point) { return count(point.count.unstable); })},
      {"stability", of_points(record, [](const RecordPoint& point) { return to_text(point.count.stability); })},
      {"contacts", of_points(record, [](const RecordPoint& point) { return OrderedJson(point.contacts); })},
      {"energy",
       of_points(record, [&](const RecordPoint& point) { return number(without_roundoff(point.energy, no_energy)); })}};
}

// Of λ, the monitors and the energy.
OrderedJson rates_json(const RecordRates& rates) {
  constexpr int digits = 6;
  OrderedJson list = OrderedJson::array({number(rates.lambda, digits)});
  for (const double rate : rates.monitors) list.push_back(number(rate, digits));
  list.push_back(number(rates.energy, digits));
  return list;
}

// [point, rates before it, rates after it where they are others] of the points with known rates.
OrderedJson all_rates_json(const Record& record) {
  OrderedJson list = OrderedJson::array();
  for (std::size_t i = 0; i < record.points.size(); ++i) {
    const RecordPoint& point = record.points[i];
    if (!point.rates) continue;
    OrderedJson& added = list.emplace_back(OrderedJson::array({i, rates_json(*point.rates)}));
    if (point.rates_after) added.push_back(rates_json(*point.rates_after));
  }
  return list;
}

OrderedJson columns_json(const Record& record) {
  OrderedJson columns = OrderedJson::array();
  for (const RecordColumn& column : record.columns)
    columns.push_back({{"name", shown_name(column.name)}, {"title", shown_title(column)}});
  return columns;
}

// Of each branch the number of its stage; empty without stages.
OrderedJson stages_json(const Record& record) {
  OrderedJson stages = OrderedJson::array();
  if (record.stages.empty()) return stages;
  for (const RecordBranch& branch : record.branches) stages.push_back(branch.stage);
  return stages;
}

OrderedJson lines_json(const Record& record) {
  OrderedJson lines = OrderedJson::array();
  for (const PathLine& line : path_lines(record))
    lines.push_back({{"branch", line.branch},
                     {"colour", branch_colour(line.branch)},
                     {"stability", to_text(line.stability)},
                     {"first", line.first},
                     {"last", line.last}});
  return lines;
}

OrderedJson events_json(const Record& record) {
  const std::vector<std::size_t> first = first_points(record);
  OrderedJson events = OrderedJson::array();
  for (const RecordEvent& event : record.events) {
    const EventMark mark = mark_of(event.kind);
    events.push_back({{"point", point_of(event, first)},
                      {"kind", to_text(event.kind)},
                      {"what", plain(event_detail(event), 200)},
                      {"jumps", event.jump != nullptr},
                      {"symbol", mark.symbol},
                      {"size", 11.0 * mark.size},
                      {"filled", mark.filled}});
  }
  return events;
}

// Points with an event whose λ has fewer sure digits than the page shows of others: the point, and λ as text.
OrderedJson uncertain_json(const Record& record) {
  constexpr int digits = 8;
  const std::vector<std::size_t> first = first_points(record);
  std::map<std::size_t, std::pair<double, std::string>> texts;  // with how uncertain it is
  for (const RecordEvent& event : record.events) {
    auto& [uncertain, text] = texts[point_of(event, first)];
    if (event.lambda_uncertainty <= uncertain) continue;
    uncertain = event.lambda_uncertainty;
    text = shown_lambda(event, digits);
  }
  OrderedJson list = OrderedJson::array();
  for (const auto& [point, of_point] : texts)
    if (const std::string& text = of_point.second;
        !text.empty() && text != shown_number(record.points[point].lambda, digits))
      list.push_back(OrderedJson::array({point, text}));
  return list;
}

// `greatest`: of the forces of all shapes.
OrderedJson contact_json(const ContactMark& contact, double greatest) {
  return OrderedJson::array({shown_name(contact.label.wall), shown_name(contact.label.member),
                             number(contact.label.fraction, 6),
                             number(without_roundoff(contact.force.norm(), 1e-12 * greatest), 6),
                             contact.pressure ? number(*contact.pressure, 6) : OrderedJson(nullptr)});
}

// With friction, behind these: what the contact does, T, p and |T|/(μ p).
void add_friction(const ContactMark& contact, OrderedJson& json) {
  if (!contact.friction) return;
  const FrictionOfContact& friction = *contact.friction;
  const double p = (contact.force - friction.force * friction.tangent).norm();
  const bool has_slip = slips(friction.mode);
  const double use = has_slip ? 1.0 : p > 0.0 ? std::abs(friction.force) / (friction.coefficient * p) : 0.0;
  json.insert(json.end(), {has_slip ? "slips" : "sticks", number(friction.force, 6), number(p, 6), number(use, 6)});
}

struct GreatestForces {
  double force = 0.0, moment = 0.0;
};

GreatestForces greatest_forces(const ShapePictures& shapes) {
  GreatestForces greatest;
  for (const auto* const pictures : {&shapes.pictures, &shapes.after_jumps})
    for (const ShapePicture& picture : *pictures)
      for (const auto& member : picture.forces)
        for (const ForceSample& sample : member) {
          greatest.force = std::max({greatest.force, std::abs(sample.axial_force), std::abs(sample.shear_force)});
          greatest.moment = std::max(greatest.moment, std::abs(sample.moment));
        }
  return greatest;
}

// Of each member a list of [point of the path, fraction, N, Q, M], and A, I, EI and half the height of a section that
// tapers.
OrderedJson forces_json(const std::vector<std::vector<ForceSample>>& forces, const std::vector<DrawnMember>& drawn,
                        const GreatestForces& greatest) {
  constexpr int digits = 6;
  constexpr double part = 1e-10;  // forces of elements are differences of large numbers
  OrderedJson members = OrderedJson::array();
  for (std::size_t m = 0; m < forces.size(); ++m) {
    OrderedJson& samples = members.emplace_back(OrderedJson::array());
    for (const ForceSample& sample : forces[m]) {
      samples.push_back({sample.at, number(sample.fraction, digits),
                         number(without_roundoff(sample.axial_force, part * greatest.force), digits),
                         number(without_roundoff(sample.shear_force, part * greatest.force), digits),
                         number(without_roundoff(sample.moment, part * greatest.moment), digits)});
      if (!drawn[m].section_at) continue;
      const DrawnSection here = drawn[m].section_at(sample.fraction);
      for (const double size : {here.A, here.I, here.EI, here.half_height})
        samples.back().push_back(number(size, digits));
    }
  }
  return members;
}

OrderedJson members_json(const ShapePictures& shapes) {
  OrderedJson list = OrderedJson::array();
  for (const DrawnMember& member : shapes.members)
    list.push_back({{"name", shown_name(member.name)},
                    {"from", shown_name(member.from)},
                    {"to", shown_name(member.to)},
                    {"A", member.section.A},
                    {"I", member.section.I},
                    {"EI", member.section.EI},
                    {"half", member.section.half_height},
                    {"allowable", member.allowable}});
  return list;
}

OrderedJson walls_json(const ShapePictures& shapes) {
  OrderedJson list = OrderedJson::array();
  for (const DrawnWall& wall : shapes.walls) {
    OrderedJson members = OrderedJson::array();
    for (const std::string& member : wall.members) members.push_back(shown_name(member));
    list.push_back({{"name", shown_name(wall.name)}, {"members", std::move(members)}});
  }
  return list;
}

OrderedJson shape_json(const ShapePictures& shapes, const ShapePicture& picture, const GreatestForces& greatest) {
  OrderedJson contacts = OrderedJson::array();
  for (const ContactMark& contact : picture.contacts) {
    contacts.push_back(contact_json(contact, shapes.greatest_force));
    add_friction(contact, contacts.back());
  }
  return {{"point", picture.point},
          {"paths", picture.paths},
          {"moves", picture.moves},
          {"contacts", std::move(contacts)},
          {"forces", forces_json(picture.forces, shapes.members, greatest)}};
}

OrderedJson shapes_json(const ShapePictures& shapes, const GreatestForces& greatest) {
  OrderedJson list = OrderedJson::array();
  for (const ShapePicture& picture : shapes.pictures) list.push_back(shape_json(shapes, picture, greatest));
  return list;
}

// `behind`: the last point of a traced branch before the state after the jump; null off the branches.
OrderedJson jumps_json(const Record& record, const ShapePictures& shapes, const GreatestForces& greatest) {
  const std::vector<std::size_t> first = first_points(record);
  const auto list = [](const std::vector<double>& values) {
    OrderedJson json = OrderedJson::array();
    for (const double value : values) json.push_back(number(value));
    return json;
  };
  const std::vector<Jump> all = jumps(record);
  OrderedJson json = OrderedJson::array();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Jump& jump = all[i];
    OrderedJson& added = json.emplace_back(
        OrderedJson{{"event", jump.event->id},
                    {"point", point_of(*jump.event, first)},
                    {"returns", jump.returns},
                    {"lambda", number(jump.lambda)},
                    {"from", list(jump.from)},
                    {"to", list(jump.to)},
                    {"energy", number(jump.end->energy)},
                    {"released", number(jump.end->energy_released)},
                    {"behind", jump.end->on_branch ? OrderedJson(jump.end->point) : OrderedJson(nullptr)}});
    if (i < shapes.after_jumps.size()) added["shape"] = shape_json(shapes, shapes.after_jumps[i], greatest);
  }
  return json;
}

}  // namespace

std::string branch_colour(Index branch) {
  constexpr std::array<const char*, 7> colours{"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                               "#E69F00", "#56B4E9", "#000000"};
  return colours[static_cast<std::size_t>(branch) % colours.size()];
}

std::string overlay_colour(std::size_t number) {
  constexpr std::array<const char*, 6> colours{"#8C6BB1", "#B15928", "#7F8C3A", "#C2477F", "#4E79A7", "#999999"};
  return colours[number % colours.size()];
}

OrderedJson overlays_json(const std::vector<Overlay>& overlays) {
  constexpr int digits = 6;
  const auto list_of = [](const std::vector<double>& column, auto... of) {
    OrderedJson numbers = OrderedJson::array();
    for (const double value : column) numbers.push_back(number(value, of...));
    return numbers;
  };
  const auto columns_of = [&](const std::map<std::string, std::vector<double>>& columns, auto... of) {
    OrderedJson values = OrderedJson::object();
    for (const auto& [name, column] : columns) values[name] = list_of(column, of...);
    return values;
  };
  OrderedJson list = OrderedJson::array();
  for (std::size_t i = 0; i < overlays.size(); ++i) {
    list.push_back({{"name", shown_name(overlays[i].name)},
                    {"measured", overlays[i].measured},
                    {"colour", overlay_colour(i)},
                    {"firsts", overlays[i].firsts},
                    {"values", columns_of(overlays[i].values)},
                    {"arc", list_of(overlays[i].arc)},
                    {"before", columns_of(overlays[i].rates_before, digits)},
                    {"after", columns_of(overlays[i].rates_after, digits)}});
  }
  return list;
}

std::string shown_name(const std::string& name) {
  constexpr std::size_t most = 40;
  return plain(name, most);
}

std::string shown_title(const RecordColumn& column) {
  return shown_name(column.name) + (column.unit.empty() ? "" : " [" + shown_name(column.unit) + "]");
}

OrderedJson report_data(const Record& record, const ShapePictures& shapes) {
  const GreatestForces greatest = greatest_forces(shapes);
  return {{"columns", columns_json(record)},
          {"force_unit", shown_name(record.force_unit)},
          {"length_unit", shown_name(record.length_unit)},
          {"energy_unit", shown_name(record.energy_unit)},
          {"points", points_json(record)},
          {"rates", all_rates_json(record)},
          {"stages", stages_json(record)},
          {"lines", lines_json(record)},
          {"events", events_json(record)},
          {"jumps", jumps_json(record, shapes, greatest)},
          {"uncertain", uncertain_json(record)},
          {"members", members_json(shapes)},
          {"walls", walls_json(shapes)},
          {"greatest_move", number(shapes.greatest_move, 4)},
          {"move_unit", number(shapes.move_unit)},
          {"shapes", shapes_json(shapes, greatest)}};
}

}  // namespace arcwall
