#include "apps/explore/traced_page.hpp"

#include <fmt/format.h>

#include <chrono>

#include "answers/sessions.hpp"
#include "apps/explore/deck_numbers.hpp"
#include "apps/explore/lines.hpp"
#include "apps/output/markup.hpp"
#include "apps/output/report_html.hpp"
#include "apps/output/report_parts.hpp"
#include "apps/output/run_warnings.hpp"
#include "core/error.hpp"
#include "core/text.hpp"

namespace arcwall::explore {

namespace {

Json numbers_json(const EditedDeck& deck) {
  constexpr std::size_t most = 2000;
  Json list = Json::array();
  for (const WrittenNumber& number : written_numbers(deck.text, deck.file, most))
    list.push_back({{"key", number.key},
                    {"unit", number.unit},
                    {"value", number.value},
                    {"whole", number.whole},
                    {"line", number.position.line},
                    {"column", number.position.column}});
  return list;
}

Json warnings_json(const std::vector<std::string>& warnings) {
  Json list = Json::array();
  for (const std::string& warning : warnings) list.push_back(plain(warning, most_characters));
  return list;
}

std::string progress(const Record& record) {
  const RecordPoint& last = record.points.back();
  return fmt::format("tracing branch {}: {} points, λ = {:.5g}", last.branch, record.points.size(), last.lambda);
}

// Until all branches have ended, or the time is over.
void trace(Session& run, double most_seconds, const LineSink& give) {
  constexpr double pause = 0.25;  // of what is said of the progress [s]
  const auto begin = std::chrono::steady_clock::now();
  double said = 0.0;
  while (run.next() != nullptr) {
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (seconds >= most_seconds) {
      run.stop({.reason = EndReason::max_time, .detail = round_trip(most_seconds) + " s"});
      run.next();
      return;
    }
    if (seconds < said + pause || run.record().points.empty()) continue;
    said = seconds;
    give_json({{"progress", progress(run.record())}}, give);
  }
}

void trace_and_give(const EditedDeck& deck, double most_seconds, const LineSink& give) {
  Json answer{{"numbers", numbers_json(deck)}};
  try {
    Session run = make_session({.deck = deck.file, .deck_text = deck.text});
    if (!run.begin()) throw InputError("there is no equilibrium at the start: " + run.problem());
    trace(run, most_seconds, give);
    const Record& record = run.record();
    if (record.points.empty()) throw InputError("there is no equilibrium at the start");
    const ReportContent content = report_content(run.model(), record, scenes_to_draw(run.model(), record));
    answer["warnings"] = warnings_json(run_warnings(run.model(), record));
    answer["page"] = ReportPage(record, content, {.page = report_parts().page}).text();
  } catch (const InputError& error) {
    answer["errors"] = errors_json(error);
  }
  give_json(answer, give);
}

}  // namespace

void trace_to_page(const EditedDeck& deck, double most_seconds, const LineSink& give) {
  give_or_say_why_not(give, [&] { trace_and_give(deck, most_seconds, give); });
}

}  // namespace arcwall::explore
