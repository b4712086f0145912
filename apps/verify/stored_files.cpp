#include "apps/verify/stored_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>

#include "core/text.hpp"
#include "model/event_names.hpp"

namespace arcwall::verify {

using Json = nlohmann::json;
using Row = std::vector<std::string>;

namespace {

// As read, or NaN where it is no number.
double number(const std::string& cell) {
  char* end = nullptr;
  const double value = std::strtod(cell.c_str(), &end);
  return !cell.empty() && *end == '\0' ? value : std::numeric_limits<double>::quiet_NaN();
}

double number(const Json& value) {
  return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

// 0 also of two that are infinite, as gaps are where no wall is, or no numbers, as the use of friction without contact.
double difference(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)) ? 0.0 : std::abs(a - b); }

// A value of this size written and read again, and computed on another machine.
double rounding(double size) { return 1e-12 * size; }

// What may have been edited has any kind of value anywhere; what is not there is null.
const Json& part(const Json& of, const std::string& key) {
  static const Json none;
  const auto found = of.is_object() ? of.find(key) : of.end();
  return found == of.end() ? none : *found;
}
const Json& part(const Json& of, std::size_t index) {
  static const Json none;
  return of.is_array() && index < of.size() ? of[index] : none;
}
std::string text(const Json& of, const std::string& key) {
  const Json& value = part(of, key);
  return value.is_string() ? value.get<std::string>() : "";
}
std::optional<Index> whole_number(const Json& of, const std::string& key) {
  const Json& value = part(of, key);
  return value.is_number_integer() ? std::optional(value.get<Index>()) : std::nullopt;
}

void expect_same(const std::string& check, const std::string& cell, const std::string& expected,
                 const std::string& what, Findings& findings) {
  findings.require(check, cell == expected, what + " is \"" + cell + "\" instead of \"" + expected + "\"");
}

}  // namespace

std::vector<Row> csv_rows(const std::string& text) {
  std::vector<Row> rows(1, Row(1));
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"') {
      if (quoted && i + 1 < text.size() && text[i + 1] == '"')
        rows.back().back() += text[++i];
      else
        quoted = !quoted;
    } else if (quoted || (c != ',' && c != '\n')) {
      rows.back().back() += c;
    } else if (c == ',') {
      rows.back().emplace_back();
    } else {
      rows.emplace_back(1);
    }
  }
  if (rows.back() == Row(1)) rows.pop_back();
  if (!rows.empty()) rows.erase(rows.begin());
  return rows;
}

// branch, step, arc, lambda, monitors …, unstable, stability, contacts, energy, iterations, event, and perhaps
// unstable_load_control and stage; with friction `slipping` behind contacts, and `dissipation` behind energy
void check_path_row(const Row& row, const RecordPoint& point, const PathExpectation& expected, Findings& findings) {
  const std::size_t monitors = expected.monitors.size();
  const std::size_t cells =
      monitors + 10 + (expected.slipping ? 2 : 0) + (expected.moves_supports ? 1 : 0) + (expected.stage ? 1 : 0);
  findings.require("path.csv has its columns", row.size() == cells, "number of cells");
  if (row.size() != cells) return;
  const auto same = [&](std::size_t cell, const std::string& what, const std::string& value) {
    expect_same("path.csv matches the states", row[cell], value, what, findings);
  };
  same(0, "branch", std::to_string(point.branch));
  same(1, "step", std::to_string(point.step));
  findings.compare("path.csv matches the states", std::abs(number(row[2]) - point.arc), 0.0, "arc");
  findings.compare("path.csv matches the states", std::abs(number(row[3]) - point.state.lambda), 0.0, "lambda");
  for (std::size_t i = 0; i < monitors; ++i)
    if (std::isfinite(expected.allowed[i]))
      findings.compare("path.csv matches the states", difference(number(row[4 + i]), expected.monitors[i]),
                       expected.allowed[i], "monitor " + expected.names[i]);
  Row rest(row.begin() + 4 + static_cast<std::ptrdiff_t>(monitors), row.end());
  if (expected.slipping) {
    constexpr std::ptrdiff_t slipping = 3, dissipation = 5;
    const double total = std::accumulate(point.dissipation.begin(), point.dissipation.end(), 0.0);
    expect_same("path.csv matches the states", rest[slipping], std::to_string(*expected.slipping), "slipping",
                findings);
    findings.compare("path.csv matches the states", difference(number(rest[dissipation]), total), 0.0, "dissipation");
    rest.erase(rest.begin() + dissipation);
    rest.erase(rest.begin() + slipping);
  }
  if (expected.unstable && !rest[0].empty()) {
    const double count = number(rest[0]);
    const auto [least, most] = *expected.unstable;
    findings.compare("unstable directions", std::max(double(least) - count, count - double(most)), 0.0,
                     fmt::format("unstable is {}, eigenvalues give {}{}", rest[0], least,
                                 least == most ? "" : fmt::format(" to {}", most)));
    findings.require("unstable directions", rest[1] != "stable" || count == 0.0, "stability is stable");
    findings.require("unstable directions", rest[1] != "unstable" || most > 0, "stability is unstable");
  }
  if (expected.unstable_load_control && expected.moves_supports && !rest[6].empty()) {
    const double count = number(rest[6]);
    const auto [least, most] = *expected.unstable_load_control;
    findings.compare("unstable directions under dead loads", std::max(double(least) - count, count - double(most)), 0.0,
                     fmt::format("unstable_load_control is {}, eigenvalues give {}{}", rest[6], least,
                                 least == most ? "" : fmt::format(" to {}", most)));
  }
  expect_same("path.csv matches the states", rest[0], point.count.unstable ? std::to_string(*point.count.unstable) : "",
              "unstable", findings);
  expect_same("path.csv matches the states", rest[1], std::string(to_text(point.count.stability)), "stability",
              findings);
  expect_same("path.csv matches the states", rest[2], std::to_string(expected.contacts), "contacts", findings);
  if (expected.energy)
    findings.compare("path.csv matches the states", std::abs(number(rest[3]) - expected.energy->value),
                     rounding(expected.energy->magnitude) + expected.energy->rounded, "energy");
  expect_same("path.csv matches the states", rest[4], std::to_string(point.iterations), "iterations", findings);
  if (expected.moves_supports)
    expect_same("path.csv matches the states", rest[6],
                point.unstable_load_control ? std::to_string(*point.unstable_load_control) : "",
                "unstable_load_control", findings);
  if (expected.stage) expect_same("path.csv matches the states", rest.back(), *expected.stage, "stage", findings);
  expect_same("path.csv matches the states", rest[5], point.event ? std::string(to_text(*point.event)) : "", "event",
              findings);
}

// The cells behind those of all contacts: friction, state, slip and anchor.
void check_friction_cells(const Row& row, const std::string& name, const ContactPoint& contact, const Model& model,
                          Findings& findings) {
  const std::string check = "contacts.csv matches the states";
  if (!contact.friction) {
    for (std::size_t cell = 9; cell < row.size(); ++cell)
      expect_same(check, row[cell], "", "friction of " + name, findings);
    return;
  }
  const FrictionOfContact& friction = *contact.friction;
  const double factor = model.frame().factor();
  findings.compare(check, std::abs(number(row[9]) - friction.force), rounding(std::abs(friction.force)),
                   "friction of " + name);
  expect_same(check, row[10], std::string(to_text(friction.mode)), "state of " + name, findings);
  findings.compare(check, std::abs(number(row[11]) - factor * friction.slip), rounding(model.size()),
                   "slip of " + name);
  if (friction.anchor)
    findings.compare(check, std::abs(number(row[12]) - model.frame().place(contact.place).x()), rounding(model.size()),
                     "anchor of " + name);
  else
    expect_same(check, row[12], "", "anchor of " + name, findings);
}

// branch, step, lambda, wall, member, fraction, x, force, pressure of a contact that is `force` by other means
void check_contact_cells(const Row& row, const RecordPoint& point, const ContactLabel& label, const Vec2& place,
                         double force, double told, const std::string& name, const Model& model, Findings& findings) {
  const std::string check = "contacts.csv matches the states";
  expect_same(check, row[0], std::to_string(point.branch), "branch of " + name, findings);
  expect_same(check, row[1], std::to_string(point.step), "step of " + name, findings);
  expect_same(check, row[3], label.wall, "wall of " + name, findings);
  expect_same(check, row[4], label.member, "member of " + name, findings);
  const auto near = [&](std::size_t cell, double value, double bound, const char* what) {
    findings.compare(check, std::abs(number(row[cell]) - value), bound, std::string(what) + " of " + name);
  };
  near(2, point.state.lambda, 0.0, "lambda");
  near(5, label.fraction, rounding(1.0), "fraction");
  const double x = model.frame().place(place).x();
  near(6, x, rounding(std::max(model.size(), std::abs(x))), "x");
  near(7, told, rounding(std::abs(force)), "force");
  if (const double tributary = label.tributary; tributary > 0.0)
    near(8, force / (model.frame().factor() * tributary),
         rounding(std::abs(force / (model.frame().factor() * tributary))), "pressure");
  else
    expect_same(check, row[8], "", "pressure of " + name, findings);
}

// Of compliant walls the rows are what the state has.
void check_compliant_rows(const std::vector<Row>& rows, std::size_t& next, const RecordPoint& point,
                          const std::vector<ContactPoint>& contacts, const Model& model, Findings& findings) {
  for (const ContactPoint& contact : contacts) {
    const std::string name =
        contact.label.wall + " at " + contact.label.member + ":" + round_trip(contact.label.fraction);
    const std::size_t cells = deck::has_friction(model.deck()) ? 13 : 9;
    const bool is_there = next < rows.size() && rows[next].size() == cells;
    findings.require("contacts.csv matches the states", is_there, "no row of " + name);
    if (!is_there) return;
    const Row& row = rows[next++];
    check_contact_cells(row, point, contact.label, contact.place, contact.force, contact.force, name, model, findings);
    if (cells == 13) check_friction_cells(row, name, contact, model, findings);
  }
}

// What is told of contacts and of pressures beside them is what acts: nothing is told twice or left out.
void check_sum_of_forces(const std::vector<ContactPoint>& contacts, const Touches& touches, const Model& model,
                         const State& state, Findings& findings) {
  double told = 0.0, acts = 0.0, size = 0.0;
  const auto add = [](const std::vector<ContactPoint>& points, double& sum) {
    for (const ContactPoint& point : points) sum += point.force;
  };
  add(contacts, told);
  add(model.contacts()->pressed_nodes(state), told);
  for (const Touch& touch : touches.all)
    if (touch.closed) {
      acts += touch.force;
      size += std::abs(touch.force);
    }
  findings.compare("contact forces and pressures make up what acts", std::abs(told - acts), 100.0 * rounding(size), "");
}

// branch, step, lambda, wall, member, fraction, x, force, pressure; with friction four more
void check_contact_rows(const std::vector<Row>& rows, std::size_t& next, const RecordPoint& point,
                        const Touches& touches, const Model& model, Findings& findings) {
  const std::string check = "contacts.csv matches the states";
  check_compliant_rows(rows, next, point, touches.of_compliant_walls, model, findings);
  if (touches.all.empty()) return;
  const std::vector<ContactPoint> contacts = model.contacts()->closed_contacts(point.state);
  check_sum_of_forces(contacts, touches, model, point.state, findings);
  std::size_t listed = 0;
  for (const Touch& touch : touches.all) {
    if (!touch.closed || !touch.listed) continue;
    findings.require(check, listed < contacts.size(), "a contact too many");
    if (listed == contacts.size()) return;
    const ContactPoint& contact = contacts[listed++];
    const std::string name = touch.label.wall + " at " + touch.label.member + ":" + round_trip(touch.label.fraction);
    const std::size_t cells = deck::has_friction(model.deck()) ? 13 : 9;
    findings.require(check, next < rows.size() && rows[next].size() == cells, "no row of " + name);
    if (next >= rows.size() || rows[next].size() != cells) return;
    const Row& row = rows[next++];
    check_contact_cells(row, point, touch.label, touch.place, touch.force, contact.force, name, model, findings);
    if (cells == 9) continue;
    check_friction_cells(row, name, contact, model, findings);
  }
}

namespace {

const std::string events_check = "events.json matches the states";

using PointIndex = std::map<std::pair<Index, Index>, const RecordPoint*>;

PointIndex by_branch_and_step(const Record& record) {
  PointIndex index;
  for (const RecordPoint& point : record.points) index[{point.branch, point.step}] = &point;
  return index;
}

void check_branches(const Json& branches, const Record& record, Findings& findings) {
  for (const Json& branch : branches) {
    const Index id = whole_number(branch, "id").value_or(-1);
    findings.at("events.json", id, 0);
    Index points = 0;
    double least = infinity, greatest = -infinity;
    for (const RecordPoint& point : record.points) {
      if (point.branch != id) continue;
      ++points;
      least = std::min(least, point.state.lambda);
      greatest = std::max(greatest, point.state.lambda);
    }
    findings.require(events_check, whole_number(branch, "points") == points, "points of the branch");
    if (points == 0) continue;
    const Json& lambda = part(branch, "lambda");
    findings.compare(events_check, std::abs(number(part(lambda, 0)) - least), 0.0, "minimum lambda of the branch");
    findings.compare(events_check, std::abs(number(part(lambda, 1)) - greatest), 0.0, "maximum lambda");
  }
}

void check_monitors(const Json& monitors, const Record& record, const RecordPoint& point, Findings& findings) {
  for (std::size_t i = 0; i < record.columns.size(); ++i) {
    const std::string& name = record.columns[i].name;
    const double value = point.monitors[i];
    if (!std::isfinite(value)) continue;
    findings.compare(events_check, std::abs(number(part(monitors, name)) - value), rounding(std::abs(value)),
                     "monitor " + name);
  }
}

// Where a contact that is named stands in the state at all, it is where it is said to be, and touches.
void check_named_contacts(const Json& contacts, const Model& model, const Touches& touches, Findings& findings) {
  for (const Json& contact : contacts) {
    const std::string wall = text(contact, "wall"), member = text(contact, "member");
    const double fraction = number(part(contact, "fraction")), x = number(part(contact, "x"));
    const auto meant = [&](const Touch& touch) {
      return touch.label.wall == wall && touch.label.member == member &&
             std::abs(touch.label.fraction - fraction) <= 1e-9;
    };
    const auto found = std::find_if(touches.all.begin(), touches.all.end(), meant);
    const std::string name = wall + " at " + member + ":" + round_trip(fraction);
    const bool at_nodes = model.contact() != nullptr && model.sliding() == nullptr;
    findings.require(events_check, !at_nodes || found != touches.all.end(), "no contact is " + name);
    if (found == touches.all.end()) continue;
    findings.compare(events_check, std::abs(x - model.frame().place(found->place).x()), 1e-9 * model.size(),
                     "x of " + name);
  }
}

ListedEvent listed_event(const Json& event) {
  ListedEvent listed{.kind = text(event, "kind"),
                     .branch = whole_number(event, "branch").value_or(-1),
                     .step = whole_number(event, "step").value_or(-1),
                     .unstable_before = whole_number(event, "unstable_before"),
                     .unstable_after = whole_number(event, "unstable_after"),
                     .lambda_uncertainty = number(part(event, "lambda_uncertainty")),
                     .unconfirmed = part(event, "unconfirmed") == true,
                     .monitor = text(event, "monitor")};
  if (const Json& value = part(event, "value"); value.is_number()) listed.value = number(value);
  for (const Json& contact : part(event, "contact"))
    listed.contacts.push_back({.wall = text(contact, "wall"),
                               .member = text(contact, "member"),
                               .fraction = number(part(contact, "fraction"))});
  return listed;
}

}  // namespace

std::vector<ListedEvent> check_events(const std::string& text, const Record& record, const Model& model,
                                      const WallsOfStages& walls, Findings& findings) {
  findings.at("events.json", 0, 0);
  const Json json = Json::parse(text, nullptr, false);
  const bool readable = json.is_object() && json.contains("branches") && json.contains("events");
  findings.require(events_check, readable, "it cannot be read");
  if (!readable) return {};
  check_branches(json["branches"], record, findings);
  const PointIndex points = by_branch_and_step(record);
  std::vector<ListedEvent> listed;
  Index id = 0;
  for (const Json& event : json["events"]) {
    const Index branch = whole_number(event, "branch").value_or(-1), step = whole_number(event, "step").value_or(-1);
    findings.at("events.json", branch, step);
    findings.require(events_check, whole_number(event, "id") == id++, "id");
    const auto found = points.find({branch, step});
    findings.require(events_check, found != points.end(), "the event is at no point");
    if (found == points.end()) continue;
    listed.push_back(listed_event(event));
    const RecordPoint& point = *found->second;
    findings.compare(events_check, std::abs(number(part(event, "lambda")) - point.state.lambda), 0.0, "lambda");
    findings.compare(events_check, std::abs(number(part(event, "arc")) - point.arc), 0.0, "arc");
    check_monitors(part(event, "monitors"), record, point, findings);
    const Index stage = record.stage_number(point.branch);
    const Model& here = model.at_stage(stage);
    const auto& walls_here = walls[static_cast<std::size_t>(stage)];
    if (!part(event, "contact").is_null())
      check_named_contacts(part(event, "contact"), here,
                           touches(here, walls_at(walls_here, point.state.lambda), point.state), findings);
  }
  return listed;
}

}  // namespace arcwall::verify
