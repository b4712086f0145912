#include "apps/output/report_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <string_view>

#include "apps/output/event_marks.hpp"
#include "apps/output/events_text.hpp"
#include "apps/output/jump_rows.hpp"
#include "apps/output/markup.hpp"
#include "apps/output/path_lines.hpp"
#include "apps/output/report_data.hpp"
#include "apps/output/report_head.hpp"
#include "apps/output/roundoff.hpp"
#include "apps/output/search_rows.hpp"
#include "apps/output/sensitivity_rows.hpp"
#include "apps/output/shown_number.hpp"
#include "apps/output/svg_chart.hpp"

namespace arcwall {

namespace {

std::string cell(const std::string& text) { return "<td>" + escaped(text) + "</td>"; }
std::string figure_cell(const std::string& text) { return "<td class=\"figure\">" + escaped(text) + "</td>"; }

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
      "<div class=\"scroll\" tabindex=\"0\"><table id=\"{0}\"><thead><tr>",
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

}  // namespace

std::vector<const RecordEvent*> all_events(const Record& record) {
  std::vector<const RecordEvent*> events;
  for (const RecordEvent& event : record.events) events.push_back(&event);
  return events;
}

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

}  // namespace arcwall
