#include "apps/output/report_html.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string_view>
#include <vector>

#include "apps/output/answers.hpp"
#include "apps/output/branch_map_page.hpp"
#include "apps/output/event_marks.hpp"
#include "apps/output/events_text.hpp"
#include "apps/output/exit_status.hpp"
#include "apps/output/jump_rows.hpp"
#include "apps/output/library_versions.hpp"
#include "apps/output/markup.hpp"
#include "apps/output/path_lines.hpp"
#include "apps/output/report_data.hpp"
#include "apps/output/report_parts.hpp"
#include "apps/output/roundoff.hpp"
#include "apps/output/run_warnings.hpp"
#include "apps/output/search_rows.hpp"
#include "apps/output/sensitivity_rows.hpp"
#include "apps/output/shape_svg.hpp"
#include "apps/output/shown_number.hpp"
#include "apps/output/svg_chart.hpp"
#include "model/deck/key_list.hpp"
#include "model/deck/words.hpp"
#include "model/deck/writer.hpp"
#include "model/event_names.hpp"
#include "model/version.hpp"

namespace arcwall {

namespace {

using Fields = std::map<std::string, std::string, std::less<>>;
using Constants = std::map<std::string_view, std::string_view>;  // what every page has: a megabyte

// The page with `{{name}}` replaced, as views of the arguments. What is filled in is not looked at again.
Pieces filled(std::string_view page, const Constants& constants, const Fields& fields) {
  Pieces pieces;
  for (std::size_t open = page.find("{{"); open != std::string_view::npos; open = page.find("{{")) {
    const std::size_t close = page.find("}}", open);
    assert(close != std::string_view::npos);
    const std::string_view name = page.substr(open + 2, close - open - 2);
    pieces.push_back(page.substr(0, open));
    const auto constant = constants.find(name);
    const auto field = fields.find(name);
    assert(constant != constants.end() || field != fields.end());
    pieces.push_back(constant != constants.end() ? constant->second : std::string_view(field->second));
    page.remove_prefix(close + 2);
  }
  pieces.push_back(page);
  return pieces;
}

std::string words(EventKind kind) {
  std::string text(to_text(kind));
  std::replace(text.begin(), text.end(), '-', ' ');
  return text;
}

std::string counted(std::size_t count, const std::string& one, const std::string& several) {
  return fmt::format("{} {}", count, count == 1 ? one : several);
}

// --- the head of the page -------------------------------------------------------------------------------------------

std::string title(const Record& record) {
  constexpr std::size_t most = 200;
  const std::string text = plain(record.title, most);
  return text.find_first_not_of(" \t\n") == std::string::npos ? plain(record.deck, most) : text;
}

std::string description(const ReportContent& content) {
  if (content.description.empty()) return "";
  return fmt::format("<p class=\"description\">{}</p>", escaped(plain(content.description, 4000)));
}

std::string outcome(const Record& record) {
  std::string text =
      fmt::format("{}, {}, {}", counted(record.branches.size(), "branch", "branches"),
                  counted(record.points.size(), "point", "points"), counted(record.events.size(), "event", "events"));
  if (record.branches.size() == 1 && record.branches.front().end)
    text += ". It ended: " + plain(how_it_ended(*record.branches.front().end), 400);
  if (!record.branches.empty() && !record.branches.back().end) text += ". It is not finished";
  return text;
}

std::string list_of_answers(const Record& record) {
  constexpr std::size_t most = 4;
  std::vector<std::string> all = answers(record);
  if (all.empty()) return "";
  if (all.size() > most) {
    const std::size_t more = all.size() - most;
    all.resize(most);
    all.push_back(fmt::format("… and {} below.", counted(more, "further jump", "further jumps")));
  }
  std::string text = "<ul class=\"answers\">";
  for (const std::string& sentence : all) text += "<li>" + escaped(plain(sentence, 400)) + "</li>";
  return text + "</ul>";
}

// What the reader has to know first: which branches did not end where the deck says, why, and what can be done.
std::string early_ends(const Record& record, const std::string& warning) {
  constexpr std::size_t most = 8;
  std::string text = warning.empty() ? "" : "<p class=\"early\"><b>Warning</b>: " + escaped(warning) + ".</p>";
  std::size_t count = 0;
  for (const RecordBranch& branch : record.branches) {
    if (!branch.end || exit_status(branch.end->reason) == ExitStatus::success || ++count > most) continue;
    std::string where;
    for (const RecordEvent& event : record.events)
      if (event.branch == branch.id && event.branch_end) where = " at λ = " + shown_lambda(event, 8);
    const std::string_view advice = what_to_try(branch.end->reason);
    text += fmt::format("<p class=\"early\"><b>Branch {} ended early{}</b>: {}.{}</p>", branch.id, escaped(where),
                        escaped(plain(how_it_ended(*branch.end), 400)),
                        advice.empty() ? "" : fmt::format(" To go on: {}.", escaped(plain(advice, 400))));
  }
  if (count > most)
    text +=
        fmt::format("<p class=\"early\">{} further branches ended early; the tree of branches gives the reasons.</p>",
                    count - most);
  return text;
}

constexpr const char* jump_colour = "#d55e00";

// --- load over monitors ---------------------------------------------------------------------------------------------

std::string event_text(const Record& record, const RecordEvent& event, const std::vector<double>& zero) {
  const std::string detail = plain(event_detail(event), 200);
  std::string text = fmt::format("{}: {}{}{}, λ = {}", event.id, words(event.kind), detail.empty() ? "" : " – ", detail,
                                 shown_lambda(event, 8));
  for (std::size_t i = 0; i < record.columns.size(); ++i)
    text += fmt::format(", {} = {}", shown_name(record.columns[i].name),
                        shown_number(without_roundoff(event.monitors[i], zero[i]), 6));
  return text;
}

// Other runs, each line of which is a branch, and measured points.
void add_overlays(const ReportContent& content, const std::string& across, Chart& chart) {
  for (std::size_t i = 0; i < content.overlays.size(); ++i) {
    const Overlay& overlay = content.overlays[i];
    const auto x = overlay.values.find(across), y = overlay.values.find("lambda");
    if (x == overlay.values.end() || y == overlay.values.end()) continue;
    for (std::size_t k = 0; k < x->second.size(); ++k) {
      const bool begins = std::find(overlay.firsts.begin(), overlay.firsts.end(), k) != overlay.firsts.end();
      if (overlay.measured || begins) chart.lines.push_back({.colour = overlay_colour(i)});
      const Vec2 at(x->second[k], y->second[k]);
      ChartLine& line = chart.lines.back();
      line.points.push_back(at);
      if (overlay.measured) line.points.push_back(at);  // a line of no length, which its round ends make a dot
      if (!overlay.measured && !begins) line.steps.push_back(cubic_step(overlay, k, across, "lambda"));
    }
  }
}

// The derivatives at the ends of a step along which a quantity that changes by `chord` is known to be monotone: Fritsch
// and Carlson (1980). One of the other sense is that behind a kink; the parabola of the other one takes its place.
void keep_monotone(double chord, double& begin, double& end) {
  const double first = begin, last = end;
  if (first * chord < 0.0) begin = 2.0 * chord - last;
  if (last * chord < 0.0) end = 2.0 * chord - first;
  const double least = std::min(0.0, 3.0 * chord), most = std::max(0.0, 3.0 * chord);
  begin = std::clamp(begin, least, most);
  end = std::clamp(end, least, most);
}

// λ is monotone between points, and so are monitors whose turning points are known.
void keep_monotone(const ReportContent& content, const std::string& across, ChartLine& line) {
  const auto& known = content.turning_known;
  const bool is_known = std::find(known.begin(), known.end(), across) != known.end();
  for (std::size_t i = 0; i < line.steps.size(); ++i) {
    if (!line.steps[i]) continue;
    const Vec2 chord = line.points[i + 1] - line.points[i];
    CubicStep& step = *line.steps[i];
    if (is_known) keep_monotone(chord.x(), step.begin.x(), step.end.x());
    keep_monotone(chord.y(), step.begin.y(), step.end.y());
  }
}

// The same with its axes exchanged.
void exchange_axes(Chart& chart) {
  const auto exchange = [](Vec2& one) { std::swap(one.x(), one.y()); };
  std::swap(chart.across, chart.up);
  for (ChartLine& line : chart.lines) {
    for (Vec2& point : line.points) exchange(point);
    for (std::optional<CubicStep>& step : line.steps) {
      if (!step) continue;
      exchange(step->begin);
      exchange(step->end);
    }
  }
  for (ChartMark& mark : chart.marks) exchange(mark.at);
}

// Load over one monitor; without monitors over the arc length. Of a movement λ is the way, which is drawn across.
Chart chart(const Record& record, const ReportContent& content, std::optional<std::size_t> monitor) {
  const auto across = [&](const RecordPoint& point) { return monitor ? point.monitors[*monitor] : point.arc; };
  const std::string axis = monitor ? shown_title(record.columns[*monitor]) : "arc length";
  Chart result{.name = "Load factor over " + axis, .across = axis, .up = title_of_lambda(content.loads)};
  for (const PathLine& line : path_lines(record)) {
    ChartLine& added = result.lines.emplace_back();
    added.colour = branch_colour(line.branch);
    added.stability = line.stability;
    for (std::size_t i = line.first; i <= line.last; ++i) {
      added.points.emplace_back(across(record.points[i]), record.points[i].lambda);
      if (i > line.first) added.steps.push_back(cubic_step(record, i, monitor));
    }
    keep_monotone(content, monitor ? record.columns[*monitor].name : "", added);
  }
  if (monitor) add_overlays(content, record.columns[*monitor].name, result);
  if (monitor)
    for (const Jump& jump : jumps(record))
      result.lines.push_back({.points = {{jump.from[*monitor], jump.lambda}, {jump.to[*monitor], jump.lambda}},
                              .colour = jump_colour,
                              .is_arrow = true});
  const std::vector<std::size_t> first = first_points(record);
  const std::vector<double> zero = roundoff(record);
  for (const RecordEvent& event : record.events) {
    const std::size_t point = point_of(event, first);
    result.marks.push_back({.at = {across(record.points[point]), event.lambda},
                            .kind = event.kind,
                            .text = event_text(record, event, zero),
                            .point = point});
  }
  if (monitor && is_movement(content.loads)) {
    exchange_axes(result);
    result.name = axis + " over " + result.across;
  }
  return result;
}

std::string charts(const Record& record, const ReportContent& content) {
  if (record.columns.empty())
    return "<figure class=\"load\">" + svg_chart(chart(record, content, std::nullopt)) + "</figure>";
  std::string text;
  for (std::size_t i = 0; i < record.columns.size(); ++i)
    text += "<figure class=\"load\">" + svg_chart(chart(record, content, i)) + "</figure>";
  return text;
}

std::string monitor_choices(const Record& record) {
  if (record.columns.empty()) return "<option>arc length</option>";
  std::string text;
  for (const RecordColumn& column : record.columns)
    text += fmt::format("<option>{}</option>", escaped(shown_title(column)));
  return text;
}

std::string legend_of_lines(const Record& record, const std::vector<Overlay>& overlays) {
  std::string text = "<ul class=\"legend\">";
  std::set<Stability> met;
  for (const PathLine& line : path_lines(record)) met.insert(line.stability);
  if (record.branches.size() > 1) {
    constexpr std::size_t most = 12;
    for (std::size_t i = 0; i < std::min(record.branches.size(), most); ++i)
      text += fmt::format("<li>{}branch {}</li>", svg_line(branch_colour(static_cast<Index>(i)), Stability::stable), i);
    if (record.branches.size() > most) text += "<li>… colours repeat</li>";
  }
  for (const Stability stability : met)
    text += fmt::format("<li>{}{}</li>", svg_line(record.branches.size() > 1 ? "#555" : branch_colour(0), stability),
                        to_text(stability));
  for (std::size_t i = 0; i < overlays.size(); ++i)
    text += fmt::format("<li>{}{}{}</li>", svg_line(overlay_colour(i), Stability::stable),
                        overlays[i].measured ? "measured: " : "", escaped(shown_name(overlays[i].name)));
  if (!jumps(record).empty()) text += fmt::format("<li>{}jump at constant λ</li>", svg_arrow(jump_colour));
  return text + "</ul>";
}

std::string legend(const Record& record, const std::vector<Overlay>& overlays) {
  std::string text = legend_of_lines(record, overlays) + "<ul class=\"legend\">";
  std::set<EventKind> kinds;
  for (const RecordEvent& event : record.events) kinds.insert(event.kind);
  for (const EventKind kind : kinds)
    text += fmt::format("<li>{}<span><b>{}</b> {}</span></li>", svg_mark(kind), words(kind), meaning(kind));
  return text + "</ul>";
}

// --- deformed shapes ------------------------------------------------------------------------------------------------

bool concerns_all(const ShapePictures& shapes, const DrawnWall& wall) {
  const auto is_concerned = [&](const DrawnMember& member) {
    return std::find(wall.members.begin(), wall.members.end(), member.name) != wall.members.end();
  };
  return wall.members.empty() || std::all_of(shapes.members.begin(), shapes.members.end(), is_concerned);
}

// A body hides the half of its surface's line that lies in it, and of the lines of others all that does.
std::string walls(const ShapePictures& shapes) {
  std::string text = "<g id=\"walls\">";
  const auto light = [&](std::size_t i) { return concerns_all(shapes, shapes.walls[i]) ? "" : "light "; };
  for (std::size_t i = 0; i < shapes.surfaces.size(); ++i)
    text += fmt::format("<path class=\"{}surface\" d=\"{}\"/>", light(i), shapes.surfaces[i]);
  for (std::size_t i = 0; i < shapes.bodies.size(); ++i)
    text += fmt::format("<path class=\"{}body\" d=\"{}\"/>", light(i), shapes.bodies[i]);
  return text + "</g>";
}

std::string first_members(const ShapePictures& shapes) {
  std::string text;
  for (std::size_t i = 0; i < shapes.classes.size(); ++i)
    if (shapes.classes[i] == "member")
      text += fmt::format("<path class=\"first member\" data-member=\"{}\" d=\"{}\"/>", i,
                          shapes.pictures.front().paths[i]);
  return text;
}

// The picture that the script moves: walls, the first shape in grey, and a shape.
std::string stage(const ShapePictures& shapes) {
  if (shapes.pictures.empty()) return "";
  return fmt::format(
      "<svg id=\"stage\" class=\"shape\" viewBox=\"{0}\" data-whole=\"{0}\" role=\"img\" aria-label=\"Deformed "
      "shape\">{1}<g>{2}</g>"
      "<g id=\"drawn-forces\"></g><g id=\"shown\">{3}</g><g id=\"named-points\"></g></svg>",
      view_box(shapes), walls(shapes), first_members(shapes), shape_paths(shapes, shapes.pictures.front()));
}

std::string shape_notes(const Record& record, const ShapePictures& shapes) {
  std::vector<std::string> notes;
  if (shapes.greatest_force > 0.0)
    notes.push_back(fmt::format(
        "Arrows at the walls: their forces on the structure. Arrow scale: {}{}{}, the maximum of the run.",
        shown_number(shapes.greatest_force, 4), record.force_unit.empty() ? "" : " ", shown_name(record.force_unit)));
  if (shapes.pictures.size() < record.points.size())
    notes.push_back(fmt::format("Shapes are kept of {} of the {} points; a point without one shows the nearest.",
                                shapes.pictures.size(), record.points.size()));
  std::string text;
  for (const std::string& note : notes) text += (text.empty() ? "" : " ") + escaped(note);
  return text;
}

// One event a point, and of many some that are spread evenly over the path.
std::vector<const RecordEvent*> events_of_strip(const Record& record) {
  constexpr std::size_t most = 12;
  std::vector<const RecordEvent*> events;
  std::set<std::pair<Index, Index>> places;
  for (const RecordEvent& event : record.events)
    if (places.insert({event.branch, event.step}).second) events.push_back(&event);
  if (events.size() <= most) return events;
  std::vector<const RecordEvent*> chosen;
  for (std::size_t i = 0; i < most; ++i) chosen.push_back(events[i * (events.size() - 1) / (most - 1)]);
  return chosen;
}

const ShapePicture* picture_at(const ShapePictures& shapes, std::size_t point) {
  const auto found = std::lower_bound(shapes.pictures.begin(), shapes.pictures.end(), point,
                                      [](const ShapePicture& picture, std::size_t at) { return picture.point < at; });
  return found != shapes.pictures.end() && found->point == point ? &*found : nullptr;
}

std::string strip_figure(const ShapePictures& shapes, const ShapePicture& picture, const std::string& place,
                         const std::string& label, const std::string& caption) {
  return fmt::format(
      "<figure {}><svg class=\"shape\" viewBox=\"{}\" role=\"img\" aria-label=\"Shape {}\">"
      "<use href=\"#walls\"/>{}</svg><figcaption>{}</figcaption></figure>",
      place, view_box(shapes), label, shape_paths(shapes, picture), caption);
}

// Each event is followed by the states after its jumps.
std::string strip(const Record& record, const ShapePictures& shapes, const std::vector<const RecordEvent*>& events) {
  const std::vector<std::size_t> first = first_points(record);
  const std::vector<Jump> all = jumps(record);
  std::string text;
  for (const RecordEvent* event : events) {
    const std::size_t point = point_of(*event, first);
    const ShapePicture* picture = picture_at(shapes, point);
    if (picture == nullptr) continue;
    text +=
        strip_figure(shapes, *picture, fmt::format("data-point=\"{}\"", point), fmt::format("at event {}", event->id),
                     fmt::format("{}<b>{} {}</b><span>λ = {}</span>", svg_mark(event->kind), event->id,
                                 words(event->kind), shown_lambda(*event, 6)));
    for (std::size_t i = 0; i < std::min(all.size(), shapes.after_jumps.size()); ++i)
      if (all[i].event == event && !all[i].returns)
        text += strip_figure(
            shapes, shapes.after_jumps[i], fmt::format("data-jump=\"{}\"", i),
            fmt::format("after the jump from event {}", event->id),
            fmt::format("{}<b>after the jump</b><span>from event {}</span>", svg_arrow(jump_colour), event->id));
  }
  return text;
}

// --- tables ---------------------------------------------------------------------------------------------------------

std::string cell(const std::string& text) { return "<td>" + escaped(text) + "</td>"; }
std::string figure_cell(const std::string& text) { return "<td class=\"figure\">" + escaped(text) + "</td>"; }

std::vector<const RecordEvent*> all_events(const Record& record) {
  std::vector<const RecordEvent*> events;
  for (const RecordEvent& event : record.events) events.push_back(&event);
  return events;
}

// `columns`: how many monitors are there.
std::string event_rows(const Record& record, const std::vector<const RecordEvent*>& events, std::size_t columns) {
  const std::vector<std::size_t> first = first_points(record);
  const std::vector<double> zero = roundoff(record);
  std::string text;
  for (const RecordEvent* const one : events) {
    const RecordEvent& event = *one;
    text += fmt::format("<tr data-point=\"{}\">", point_of(event, first)) + figure_cell(std::to_string(event.id));
    for (const Index beside : {event.branch, event.step})
      text += fmt::format("<td class=\"beside figure\">{}</td>", beside);
    text += figure_cell(shown_lambda(event, 10));
    text += fmt::format("<td class=\"kind\">{}{}</td>", svg_mark(event.kind), words(event.kind));
    text += "<td class=\"what\">" + escaped(plain(event_detail(event), 400)) + "</td>";
    for (std::size_t i = 0; i < columns; ++i)
      text += fmt::format("<td class=\"beside figure\">{}</td>",
                          shown_number(without_roundoff(event.monitors[i], zero[i]), 6));
    text += cell(unstable_change(event)) + "</tr>\n";
  }
  return text;
}

std::string event_titles(const Record& record, std::size_t columns) {
  std::string text = "<tr>";
  text += "<th class=\"figure\">id</th><th class=\"beside figure\">branch</th><th class=\"beside figure\">step</th>";
  text += "<th class=\"figure\">λ</th><th>kind</th><th>what</th>";
  for (std::size_t i = 0; i < columns; ++i)
    text += fmt::format("<th class=\"beside figure\">{}</th>", escaped(shown_title(record.columns[i])));
  return text + "<th title=\"number of negative eigenvalues; ?: undecided\">unstable</th></tr>";
}

std::string event_note(const Record& record) {
  std::string text;
  for (const std::string& note : {uncertainty_note(record), count_note(record)})
    if (!note.empty()) text += "<p class=\"note\">" + escaped(note) + "</p>";
  return text;
}

// A section with one table; empty without rows.
// `of_row`: attributes of a row.
std::string table_section(
    std::string_view id, std::string_view title, std::string_view note, const std::vector<TableColumn>& columns,
    const std::vector<std::vector<std::string>>& rows,
    const std::function<std::string(std::size_t)>& of_row = [](std::size_t) { return ""; }) {
  if (rows.empty()) return "";
  const auto is_figure = [&](std::size_t i) { return columns[i].side == TableColumn::Side::right; };
  std::string text = fmt::format(
      "<section aria-labelledby=\"{0}-title\"><h2 id=\"{0}-title\">{1}</h2>"
      "<div class=\"scroll\"><table id=\"{0}\"><thead><tr>",
      id, title);
  for (std::size_t i = 0; i < columns.size(); ++i)
    text += fmt::format("<th{}>{}</th>", is_figure(i) ? " class=\"figure\"" : "", escaped(columns[i].title));
  text += "</tr></thead><tbody>\n";
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const std::vector<std::string>& row = rows[r];
    text += "<tr" + of_row(r) + ">";
    for (std::size_t i = 0; i < row.size(); ++i) text += is_figure(i) ? figure_cell(row[i]) : cell(plain(row[i], 400));
    text += "</tr>\n";
  }
  text += "</tbody></table></div>";
  if (!note.empty()) text += fmt::format("<p class=\"note\">{}</p>", note);
  return text + "</section>";
}

std::string sensitivities(const Record& record) {
  return table_section("sensitivity", "Sensitivity of the event loads", "", sensitivity_columns(record),
                       sensitivity_rows(record));
}

std::string jump_table(const Record& record) {
  const std::vector<const RecordJump*> of_rows = jumps_of_rows(record);
  const std::vector<Jump> all = jumps(record);
  const auto number = [&](std::size_t row) -> std::string {
    const auto is_same = [&](const Jump& jump) { return jump.end == of_rows[row]; };
    const auto found = std::find_if(all.begin(), all.end(), is_same);
    return found == all.end() ? "" : fmt::format(" data-jump=\"{}\"", found - all.begin());
  };
  return table_section("jumps", "Jumps at constant λ",
                       "Where the path loses stability, the structure jumps. Each row gives destination, energy "
                       "released, return load and energy dissipated. An empty cell: no return jump is known.",
                       jump_columns(record), jump_rows(record), number);
}

// The branches that leave a branch, and those that leave them in turn.
std::string branch_tree(const Record& record, std::optional<Index> parent) {
  std::string items;
  const std::vector<std::size_t> first = first_points(record);
  for (const RecordBranch& branch : record.branches) {
    if (branch.parent != parent) continue;
    items += fmt::format("<li>{}<span data-point=\"{}\"><b>branch {}</b></span>",
                         svg_line(branch_colour(branch.id), Stability::stable),
                         first[static_cast<std::size_t>(branch.id)], branch.id);
    if (branch.origin) {
      const RecordEvent& origin = record.events[static_cast<std::size_t>(*branch.origin)];
      items += fmt::format(" {} <span data-point=\"{}\">event {}</span>, λ = {};",
                           branch.after_jump ? "begins after a jump at" : "leaves at", point_of(origin, first),
                           origin.id, shown_lambda(origin, 10));
    }
    if (branch.found) items += " begins " + escaped(found_at(record, branch)) + ";";
    items += fmt::format(" {}", counted(static_cast<std::size_t>(branch.points), "point", "points"));
    if (branch.end) items += "; ended: " + escaped(plain(how_it_ended(*branch.end), 400));
    if (branch.mirror_image) items += "; its mirror image is not traced";
    items += branch_tree(record, branch.id) + "</li>";
  }
  return items.empty() ? "" : "<ul class=\"tree\">" + items + "</ul>";
}

std::string facts(const ReportContent& content) {
  std::string text;
  for (const auto& [name, value] : content.facts)
    text += fmt::format("<dt>{}</dt><dd>{}</dd>", escaped(plain(name, 200)), escaped(plain(value, 1000)));
  return text;
}

}  // namespace

namespace {

std::optional<std::size_t> first_force(const Model& model) {
  using enum deck::Component;
  const auto is_force = [](const MonitorColumn& column) {
    const deck::Component of = column.component;
    return of == reaction_x || of == reaction_z || of == reaction_moment || of == force_x || of == force_z ||
           of == axial_force;
  };
  const auto& all = model.monitors();
  const auto found = std::find_if(all.begin(), all.end(), is_force);
  return found == all.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - all.begin()));
}

}  // namespace

namespace {

// `column: euler-bernoulli, 40 elements, E = 21000 kN/cm², A = 0.02 cm², I = 2e-05 cm⁴`
std::string member_text(const deck::Deck& deck, const deck::Member& member) {
  const auto quantity = [&](const char* name, double value, const deck::Dimension& unit) {
    return fmt::format(", {} = {}", name, with_unit(shown_number(value, 6), unit_text(unit, deck.units)));
  };
  std::string text = fmt::format("{}: {}, {}", member.name, deck::text_of(deck::theory_words, member.theory),
                                 counted(static_cast<std::size_t>(member.elements), "element", "elements"));
  if (const deck::Material* const material = find(deck.materials, member.material))
    text += quantity("E", material->E, deck::unit::stress);
  if (const deck::Section* const section = find(deck.sections, member.section)) {
    const auto add = [&](const deck::SectionProperties& of) {
      text += quantity("A", of.A, deck::unit::area);
      if (member.theory != Theory::truss) text += quantity("I", of.I, deck::unit::second_moment);
      if (of.height) text += quantity("h", *of.height, deck::unit::length);
    };
    add(properties(*section, 0.0));
    if (!tapers(*section)) return text;
    text += "; at its end";
    add(properties(*section, 1.0));
  }
  return text;
}

template <class List, class Text>
std::string joined(const List& list, Text text) {
  constexpr std::size_t most = 4;
  std::string all;
  for (std::size_t i = 0; i < std::min(list.size(), most); ++i) all += (i == 0 ? "" : "; ") + text(list[i]);
  return all + (list.size() > most ? fmt::format("; and {} more", list.size() - most) : "");
}

std::vector<std::pair<std::string, std::string>> key_numbers_of(const Model& model) {
  const deck::Deck& deck = model.whole_deck();
  std::vector<std::pair<std::string, std::string>> numbers;
  const auto add = [&](const std::string& name, const std::string& value) {
    if (!value.empty()) numbers.emplace_back(name, value);
  };
  add("λ multiplies", joined(driven_by_lambda(deck), [](const LoadText& load) { return load.text; }));
  add("members", joined(deck.members, [&](const deck::Member& member) { return member_text(deck, member); }));
  add("walls", joined(deck.walls, [](const deck::Wall& wall) { return wall.name; }));
  add("springs", joined(deck.springs, [&](const deck::Spring& spring) { return spring_text(spring, deck.units); }));
  add("mesh", fmt::format("{}, {}", counted(static_cast<std::size_t>(model.structure().node_count()), "node", "nodes"),
                          counted(static_cast<std::size_t>(model.structure().size({})), "unknown", "unknowns")));
  for (const std::string& assignment : deck.source.assignments) add("--set", assignment);
  return numbers;
}

std::vector<std::string> turning_known(const Model& model) {
  std::vector<std::string> names;
  for (const Watch& watch : model.watched()) names.push_back(watch.label);
  return names;
}

}  // namespace

ReportContent report_content(const Model& model, const Record& record, const DrawnScenes& drawn) {
  ReportContent content{.description = model.deck().description,
                        .warning = warning_of_start(model, record),
                        .loads = driven_by_lambda(model.whole_deck()),
                        .force = first_force(model),
                        .turning_known = turning_known(model),
                        .deck_text = deck::to_toml(model.whole_deck()),
                        .shapes = draw(drawn, setting_of(model)),
                        .branch_map = branch_map_section(record, branch_map_of(model, record)),
                        .key_numbers = key_numbers_of(model)};
  const auto add = [&](const std::string& name, const std::string& value) { content.facts.emplace_back(name, value); };
  add("deck", record.deck);
  for (const std::string& assignment : model.deck().source.assignments) add("--set", assignment);
  add("nodes", std::to_string(model.structure().node_count()));
  add("unknowns", std::to_string(model.structure().size({})));
  Index iterations = 0;
  for (const RecordPoint& point : record.points) iterations += point.iterations;
  add("iterations", std::to_string(iterations));
  add("trace-path", program_version());
  for (const auto& [name, version] : library_versions()) add(name, version);
  return content;
}

namespace {

std::string load_note(const ReportContent& content) {
  constexpr std::size_t most = 4;
  std::string text;
  for (std::size_t i = 0; i < std::min(content.loads.size(), most); ++i)
    text += (i == 0 ? "" : "; ") + plain(content.loads[i].text, 200);
  if (text.empty()) return "";
  return "<p class=\"note\">λ multiplies the " + escaped(text) + (content.loads.size() > most ? "; …" : "") + ".</p>";
}

nlohmann::ordered_json data_of(const Record& record, const ReportContent& content) {
  nlohmann::ordered_json data = report_data(record, content.shapes);
  data["load_title"] = title_of_lambda(content.loads);
  data["turning_known"] = nlohmann::ordered_json::array();
  for (const std::string& name : content.turning_known) data["turning_known"].push_back(shown_name(name));
  data["moved"] = is_movement(content.loads);
  data["force"] = content.force ? nlohmann::ordered_json(*content.force) : nlohmann::ordered_json(nullptr);
  data["overlays"] = overlays_json(content.overlays);
  return data;
}

}  // namespace

ReportPage::ReportPage(const Record& record, const ReportContent& content, const ReportParts& carried)
    : fields_{
          {"library_note", report_parts().library.empty()
                               ? "This trace-path was built without plotly: the curves are still pictures without zoom."
                               : "Curves are drawn with plotly.js, whose licence (MIT) is in the source of this page."},
          {"title", escaped(title(record))},
          {"source", escaped(fmt::format("{}, trace-path {}", plain(record.deck, 200), program_version()))},
          {"description", description(content)},
          {"outcome", escaped(outcome(record))},
          {"answers", list_of_answers(record)},
          {"early", early_ends(record, content.warning)},
          {"monitors", monitor_choices(record)},
          {"charts", charts(record, content)},
          {"load_note", load_note(content)},
          {"legend", legend(record, content.overlays)},
          {"stage", stage(content.shapes)},
          {"stretch_note", stretch_note(content.shapes)},
          {"shape_notes", shape_notes(record, content.shapes)},
          {"touching", record.has_walls ? "touching" : "without-walls"},
          {"last_shape", std::to_string(std::max<std::size_t>(content.shapes.pictures.size(), 1) - 1)},
          {"strip", strip(record, content.shapes, events_of_strip(record))},
          {"event_titles", event_titles(record, record.columns.size())},
          {"event_rows", event_rows(record, all_events(record), record.columns.size())},
          {"event_note", event_note(record)},
          {"jump_table", jump_table(record)},
          {"sensitivities", sensitivities(record)},
          {"branches", branch_tree(record, std::nullopt)},
          {"branch_map", content.branch_map},
          {"deck", escaped(plain(content.deck_text))},
          {"facts", facts(content)},
          {"data", script_json(data_of(record, content))}} {
  constexpr std::string_view start = "show_report(JSON.parse(document.getElementById('data').textContent));\n";
  pieces_ = filled(carried.page,
                   {{"style", carried.style},
                    {"script", carried.script},
                    {"library", carried.library},
                    {"start", carried.script.empty() ? "" : start}},
                   fields_);
}

std::string ReportPage::text() const {
  std::string text;
  for (const std::string_view piece : pieces_) text += piece;
  return text;
}

// --- one sheet -------------------------------------------------------------------------------------------------------

namespace {

// The lower, the more the event matters.
int rank(const RecordEvent& event) {
  if (event.jump) return 0;
  if (event.kind == EventKind::limit_point || event.kind == EventKind::contact_limit_point) return 1;
  if (event.kind == EventKind::branch_point) return 2;
  if (event.kind == EventKind::start || event.kind == EventKind::end) return 3;
  return changes_contact(event.kind) ? 4 : 5;
}

// At most so many that matter, in the order of the path.
std::vector<const RecordEvent*> events_that_matter(const Record& record, std::size_t most) {
  std::vector<const RecordEvent*> events = all_events(record);
  std::stable_sort(events.begin(), events.end(),
                   [](const RecordEvent* a, const RecordEvent* b) { return rank(*a) < rank(*b); });
  events.resize(std::min(events.size(), most));
  std::sort(events.begin(), events.end(), [](const RecordEvent* a, const RecordEvent* b) { return a->id < b->id; });
  return events;
}

// Those of which no more than so many shapes are drawn: an event with a jump has one more for each end.
std::vector<const RecordEvent*> events_of_shapes(const Record& record, std::size_t most) {
  const std::vector<Jump> all = jumps(record);
  const auto shapes_of = [&](const RecordEvent* event) {
    const auto is_its = [&](const Jump& jump) { return jump.event == event && !jump.returns; };
    return 1 + static_cast<std::size_t>(std::count_if(all.begin(), all.end(), is_its));
  };
  for (std::size_t count = most; count > 1; --count) {
    const std::vector<const RecordEvent*> events = events_that_matter(record, count);
    std::size_t shapes = 0;
    for (const RecordEvent* const event : events) shapes += shapes_of(event);
    if (shapes <= most) return events;
  }
  return events_that_matter(record, 1);
}

std::optional<std::size_t> main_monitor(const Record& record, const ReportContent& content) {
  if (record.columns.empty()) return std::nullopt;
  return is_movement(content.loads) ? content.force.value_or(0) : 0;
}

std::string key_numbers(const ReportContent& content) {
  std::string text;
  for (const auto& [name, value] : content.key_numbers)
    text += fmt::format("<dt>{}</dt><dd>{}</dd>", escaped(plain(name, 80)), escaped(plain(value, 300)));
  return text;
}

Fields sheet_fields(const Record& record, const ReportContent& content) {
  constexpr std::size_t most_events = 9, most_shapes = 6, most_columns = 3;
  const std::size_t columns = std::min(record.columns.size(), most_columns);
  const std::vector<const RecordEvent*> events = events_that_matter(record, most_events);
  const std::string more = events.size() == record.events.size() ? ""
                                                                 : fmt::format("<p class=\"note\">{} of {} events.</p>",
                                                                               events.size(), record.events.size());
  const std::string defined_walls =
      fmt::format("<svg class=\"defined\" aria-hidden=\"true\"><defs>{}</defs></svg>", walls(content.shapes));
  return {{"title", escaped(title(record))},
          {"source", escaped(fmt::format("{}, trace-path {}", plain(record.deck, 200), program_version()))},
          {"answers", list_of_answers(record)},
          {"early", early_ends(record, content.warning)},
          {"curve", svg_chart(chart(record, content, main_monitor(record, content)))},
          {"legend", legend_of_lines(record, content.overlays)},
          {"key_numbers", key_numbers(content)},
          {"strip", defined_walls + strip(record, content.shapes, events_of_shapes(record, most_shapes))},
          {"event_titles", event_titles(record, columns)},
          {"event_rows", event_rows(record, events, columns)},
          {"event_note", more + event_note(record)},
          {"jump_table", jump_table(record)}};
}

std::string printed(std::string_view page, const Record& record, const ReportContent& content) {
  const ReportParts& parts = report_parts();
  const Fields fields = sheet_fields(record, content);
  std::string text;
  for (const std::string_view piece :
       filled(page, {{"style", parts.style}, {"sheet_style", parts.sheet_style}}, fields))
    text += piece;
  return text;
}

}  // namespace

std::string sheet_html(const Record& record, const ReportContent& content) {
  return printed(report_parts().sheet, record, content);
}

std::string picture_html(const Record& record, const ReportContent& content) {
  return printed(report_parts().picture, record, content);
}

std::string curve_html(const Record& record, const std::vector<LoadText>& loads, std::optional<std::size_t> monitor) {
  const ReportContent content{.loads = loads};
  return framed_chart(chart(record, content, monitor), legend(record, content.overlays));
}

}  // namespace arcwall
