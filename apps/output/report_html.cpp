#include "apps/output/report_html.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "apps/output/events_text.hpp"
#include "apps/output/markup.hpp"
#include "apps/output/report_chart.hpp"
#include "apps/output/report_data.hpp"
#include "apps/output/report_head.hpp"
#include "apps/output/report_shapes.hpp"
#include "apps/output/report_tables.hpp"
#include "apps/output/shape_svg.hpp"
#include "apps/output/svg_chart.hpp"

namespace arcwall {

namespace {

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

std::string charts(const Record& record, const ReportContent& content) {
  if (record.columns.empty())
    return "<figure class=\"load\">" + svg_chart(path_chart(record, content, std::nullopt)) + "</figure>";
  std::string text;
  for (std::size_t i = 0; i < record.columns.size(); ++i)
    text += "<figure class=\"load\">" + svg_chart(path_chart(record, content, i)) + "</figure>";
  return text;
}

std::string monitor_choices(const Record& record) {
  if (record.columns.empty()) return "<option>arc length</option>";
  std::string text;
  for (const RecordColumn& column : record.columns)
    text += fmt::format("<option>{}</option>", escaped(shown_title(column)));
  return text;
}

std::string facts(const ReportContent& content) {
  std::string text;
  for (const auto& [name, value] : content.facts)
    text += fmt::format("<dt>{}</dt><dd>{}</dd>", escaped(plain(name, 200)), escaped(plain(value, 1000)));
  return text;
}

// `of`: a stage; empty without stages.
std::string load_note(const std::vector<LoadText>& loads, const std::string& of) {
  constexpr std::size_t most = 4;
  std::string text;
  for (std::size_t i = 0; i < std::min(loads.size(), most); ++i)
    text += (i == 0 ? "" : "; ") + plain(loads[i].text, 200);
  if (text.empty()) return "";
  return "<p class=\"note\">" + escaped(of) + "λ multiplies the " + escaped(text) + (loads.size() > most ? "; …" : "") +
         ".</p>";
}

std::string load_notes(const Record& record, const ReportContent& content) {
  if (content.loads_of_stages.empty()) return load_note(content.loads, "");
  std::string text;
  for (std::size_t stage = 0; stage < content.loads_of_stages.size(); ++stage)
    text += load_note(content.loads_of_stages[stage], "Stage " + shown_name(record.stages[stage]) + ": ");
  return text;
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
          {"title", escaped(report_title(record))},
          {"source", report_source(record)},
          {"description", description(content)},
          {"outcome", escaped(outcome(record))},
          {"answers", list_of_answers(record, content)},
          {"early", early_ends(record, content.warning)},
          {"monitors", monitor_choices(record)},
          {"charts", charts(record, content)},
          {"load_note", load_notes(record, content)},
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

std::string ReportPage::text() const { return joined_pieces(pieces_); }

std::string curve_html(const Record& record, const std::vector<LoadText>& loads, std::optional<std::size_t> monitor) {
  const ReportContent content{.loads = loads};
  return framed_chart(path_chart(record, content, monitor), legend(record, content.overlays));
}

}  // namespace arcwall
