#include "apps/output/report_head.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "apps/output/answers.hpp"
#include "apps/output/events_text.hpp"
#include "apps/output/exit_status.hpp"
#include "apps/output/markup.hpp"
#include "apps/output/shown_number.hpp"
#include "model/event_names.hpp"
#include "model/version.hpp"

namespace arcwall {

std::string words(EventKind kind) {
  std::string text(to_text(kind));
  std::replace(text.begin(), text.end(), '-', ' ');
  return text;
}

std::string counted(std::size_t count, const std::string& one, const std::string& several) {
  return fmt::format("{} {}", count, count == 1 ? one : several);
}
std::string report_title(const Record& record) {
  constexpr std::size_t most = 200;
  const std::string text = plain(record.title, most);
  return text.find_first_not_of(" \t\n") == std::string::npos ? plain(record.deck, most) : text;
}
std::string report_source(const Record& record) {
  return escaped(fmt::format("{}, trace-path {}", plain(record.deck, 200), program_version()));
}

std::string list_of_answers(const Record& record, const ReportContent& content) {
  constexpr std::size_t most = 4;
  std::vector<std::string> all = answers(record, is_movement(content.loads) ? content.force : std::nullopt);
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

}  // namespace arcwall
