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
    const auto& [name, measured, values, firsts] = content.overlays[i];
    const auto x = values.find(across), y = values.find("lambda");
    if (x == values.end() || y == values.end()) continue;
    for (std::size_t k = 0; k < x->second.size(); ++k) {
      if (measured || std::find(firsts.begin(), firsts.end(), k) != firsts.end())
        chart.lines.push_back({.colour = overlay_colour(i)});
      const Vec2 at(x->second[k], y->second[k]);
      std::vector<Vec2>& points = chart.lines.back().points;
      points.push_back(at);
      if (measured) points.push_back(at);  // a line of no length, which its round ends make a dot
    }
  }
}

// Load over one monitor; without monitors over the arc length.
Chart chart(const Record& record, const ReportContent& content, std::optional<std::size_t> monitor) {
  const auto across = [&](const RecordPoint& point) { return monitor ? point.monitors[*monitor] : point.arc; };
  const std::string axis = monitor ? shown_title(record.columns[*monitor]) : "arc length";
  Chart result{.name = "Load factor over " + axis, .across = axis, .up = title_of_lambda(content.loads)};
  for (const PathLine& line : path_lines(record)) {
    ChartLine& added = result.lines.emplace_back();
    added.colour = branch_colour(line.branch);
    added.stability = line.stability;
    for (std::size_t i = line.first; i <= line.last; ++i)
      added.points.emplace_back(across(record.points[i]), record.points[i].lambda);
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

std::string legend(const Record& record, const std::vector<Overlay>& overlays) {
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
  text += "</ul><ul class=\"legend\">";
  std::set<EventKind> kinds;
  for (const RecordEvent& event : record.events) kinds.insert(event.kind);
  for (const EventKind kind : kinds)
    text += fmt::format("<li>{}<span><b>{}</b> {}</span></li>", svg_mark(kind), words(kind), meaning(kind));
  return text + "</ul>";
}

// --- deformed shapes ------------------------------------------------------------------------------------------------

std::string walls(const ShapePictures& shapes) {
  std::string text = "<g id=\"walls\">";
  for (std::size_t i = 0; i < shapes.surfaces.size(); ++i)
    text += fmt::format("<path class=\"body\" d=\"{}\"/><path class=\"surface\" d=\"{}\"/>", shapes.bodies[i],
                        shapes.surfaces[i]);
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

std::string strip(const Record& record, const ShapePictures& shapes) {
  const std::vector<std::size_t> first = first_points(record);
  std::string text;
  for (const RecordEvent* event : events_of_strip(record)) {
    const std::size_t point = point_of(*event, first);
    const ShapePicture* picture = picture_at(shapes, point);
    if (picture == nullptr) continue;
    text += fmt::format(
        "<figure data-point=\"{}\"><svg class=\"shape\" viewBox=\"{}\" role=\"img\" aria-label=\"Shape at event {}\">"
        "<use href=\"#walls\"/>{}</svg><figcaption>{}<b>{} {}</b><span>λ = {}</span></figcaption></figure>",
        point, view_box(shapes), event->id, shape_paths(shapes, *picture), svg_mark(event->kind), event->id,
        words(event->kind), shown_lambda(*event, 6));
  }
  return text;
}

// --- tables ---------------------------------------------------------------------------------------------------------

std::string cell(const std::string& text) { return "<td>" + escaped(text) + "</td>"; }
std::string figure_cell(const std::string& text) { return "<td class=\"figure\">" + escaped(text) + "</td>"; }

std::string event_rows(const Record& record) {
  const std::vector<std::size_t> first = first_points(record);
  const std::vector<double> zero = roundoff(record);
  std::string text;
  for (const RecordEvent& event : record.events) {
    text += fmt::format("<tr data-point=\"{}\">", point_of(event, first)) + figure_cell(std::to_string(event.id));
    for (const Index beside : {event.branch, event.step})
      text += fmt::format("<td class=\"beside figure\">{}</td>", beside);
    text += figure_cell(shown_lambda(event, 10));
    text += fmt::format("<td class=\"kind\">{}{}</td>", svg_mark(event.kind), words(event.kind));
    text += "<td class=\"what\">" + escaped(plain(event_detail(event), 400)) + "</td>";
    for (std::size_t i = 0; i < zero.size(); ++i)
      text += fmt::format("<td class=\"beside figure\">{}</td>",
                          shown_number(without_roundoff(event.monitors[i], zero[i]), 6));
    text += cell(unstable_change(event)) + "</tr>\n";
  }
  return text;
}

std::string event_titles(const Record& record) {
  std::string text = "<tr>";
  text += "<th class=\"figure\">id</th><th class=\"beside figure\">branch</th><th class=\"beside figure\">step</th>";
  text += "<th class=\"figure\">λ</th><th>kind</th><th>what</th>";
  for (const RecordColumn& column : record.columns)
    text += fmt::format("<th class=\"beside figure\">{}</th>", escaped(shown_title(column)));
  return text + "<th title=\"number of negative eigenvalues; ?: undecided\">unstable</th></tr>";
}

std::string event_note(const Record& record) {
  std::string text;
  for (const std::string& note : {uncertainty_note(record), count_note(record)})
    if (!note.empty()) text += "<p class=\"note\">" + escaped(note) + "</p>";
  return text;
}

// A section with one table; empty without rows.
std::string table_section(std::string_view id, std::string_view title, std::string_view note,
                          const std::vector<TableColumn>& columns, const std::vector<std::vector<std::string>>& rows) {
  if (rows.empty()) return "";
  const auto is_figure = [&](std::size_t i) { return columns[i].side == TableColumn::Side::right; };
  std::string text = fmt::format(
      "<section aria-labelledby=\"{0}-title\"><h2 id=\"{0}-title\">{1}</h2>"
      "<div class=\"scroll\"><table id=\"{0}\"><thead><tr>",
      id, title);
  for (std::size_t i = 0; i < columns.size(); ++i)
    text += fmt::format("<th{}>{}</th>", is_figure(i) ? " class=\"figure\"" : "", escaped(columns[i].title));
  text += "</tr></thead><tbody>\n";
  for (const std::vector<std::string>& row : rows) {
    text += "<tr>";
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
  return table_section("jumps", "Jumps at constant λ",
                       "Where the path loses stability, the structure jumps. Each row gives destination, energy "
                       "released, return load and energy dissipated. An empty cell: no return jump is known.",
                       jump_columns(record), jump_rows(record));
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

ReportContent report_content(const Model& model, const Record& record, const DrawnScenes& drawn) {
  ReportContent content{.description = model.deck().description,
                        .warning = warning_of_start(model, record),
                        .loads = driven_by_lambda(model.whole_deck()),
                        .deck_text = deck::to_toml(model.whole_deck()),
                        .shapes = draw(drawn, setting_of(model)),
                        .branch_map = branch_map_section(record, branch_map_of(model, record))};
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
          {"strip", strip(record, content.shapes)},
          {"event_titles", event_titles(record)},
          {"event_rows", event_rows(record)},
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

std::string curve_html(const Record& record, const std::vector<LoadText>& loads, std::optional<std::size_t> monitor) {
  const ReportContent content{.loads = loads};
  return framed_chart(chart(record, content, monitor), legend(record, content.overlays));
}

}  // namespace arcwall
