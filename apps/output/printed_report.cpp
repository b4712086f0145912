#include "apps/output/printed_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "apps/output/filled_page.hpp"
#include "apps/output/jump_rows.hpp"
#include "apps/output/markup.hpp"
#include "apps/output/report_chart.hpp"
#include "apps/output/report_head.hpp"
#include "apps/output/report_parts.hpp"
#include "apps/output/report_shapes.hpp"
#include "apps/output/report_tables.hpp"
#include "model/event_names.hpp"

namespace arcwall {

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

PageFields sheet_fields(const Record& record, const ReportContent& content) {
  constexpr std::size_t most_events = 9, most_shapes = 6, most_columns = 3;
  const std::size_t columns = std::min(record.columns.size(), most_columns);
  const std::vector<const RecordEvent*> events = events_that_matter(record, most_events);
  const std::string more = events.size() == record.events.size() ? ""
                                                                 : fmt::format("<p class=\"note\">{} of {} events.</p>",
                                                                               events.size(), record.events.size());
  const std::string defined_walls =
      fmt::format("<svg class=\"defined\" aria-hidden=\"true\"><defs>{}</defs></svg>", wall_paths(content.shapes));
  return {{"title", escaped(report_title(record))},
          {"source", report_source(record)},
          {"answers", list_of_answers(record, content)},
          {"early", early_ends(record, content.warning)},
          {"curve", svg_chart(path_chart(record, content, main_monitor(record, content)))},
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
  const PageFields fields = sheet_fields(record, content);
  return joined_pieces(filled(page, {{"style", parts.style}, {"sheet_style", parts.sheet_style}}, fields));
}

}  // namespace

std::string sheet_html(const Record& record, const ReportContent& content) {
  return printed(report_parts().sheet, record, content);
}

std::string picture_html(const Record& record, const ReportContent& content) {
  return printed(report_parts().picture, record, content);
}

}  // namespace arcwall
