#include <algorithm>
#include <iostream>
#include <optional>

#include "answers/sessions.hpp"
#include "apps/cli/browser_print.hpp"
#include "apps/cli/commands.hpp"
#include "apps/output/files.hpp"
#include "apps/output/overlay.hpp"
#include "apps/output/printed_report.hpp"
#include "apps/output/report_html.hpp"
#include "core/error.hpp"
#include "model/regular_file.hpp"

namespace arcwall {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t most_runs = 20;

// Of the further runs and of measured points.
std::vector<Overlay> overlays(const Options& options, const Record& record) {
  std::vector<Overlay> all;
  const std::vector<std::string>& folders = options.words();
  for (auto folder = folders.begin() + 1; folder != folders.end(); ++folder)
    all.push_back(overlay_of(stored_session(*folder, Session::Resume::as_ended).record(), *folder));
  for (const std::string& file : options.texts("measured"))
    all.push_back(measured_points(bytes_of_regular_file(file, 1u << 28), file, record.columns));
  return all;
}

// What is drawn over what has the names of the first run's columns.
void require_common_columns(const std::vector<Overlay>& overlays, const Record& record) {
  for (const Overlay& overlay : overlays) {
    const auto is_there = [&](const RecordColumn& column) { return overlay.values.contains(column.name); };
    if (std::none_of(record.columns.begin(), record.columns.end(), is_there))
      throw InputError(overlay.name +
                       " has no monitor of the first run; give monitors that are compared the same names");
  }
}

// The page of a run alone goes into its folder, one of several where it is wanted.
fs::path page_of(const Options& options) {
  const auto wanted = options.text("out");
  if (wanted) return *wanted;
  if (options.has("pdf") || options.has("png")) return {};
  if (options.words().size() > 1 || !options.texts("measured").empty())
    throw InputError("--out is missing; name the file for a page of several runs or of measured points");
  return fs::path(options.words().front()) / "report.html";
}

ExitStatus write_report(const Options& options) {
  const fs::path folder = options.words().front();
  const fs::path file = page_of(options);
  std::error_code ignored;
  std::optional<FolderLock> lock;
  if (!options.has("out") && fs::is_directory(folder, ignored)) lock.emplace(folder);
  const Session run = stored_session(folder, Session::Resume::as_ended);
  const Record& record = run.record();
  ReportContent content = report_content(run.model(), record, scenes_to_draw(run.model(), record));
  content.overlays = overlays(options, record);
  require_common_columns(content.overlays, record);
  const auto tell = [](const fs::path& written) { std::cerr << "wrote " << written.string() << "\n"; };
  const auto pdf = options.text("pdf"), png = options.text("png");
  if (options.has("out") || (!pdf && !png)) {
    write_whole(file, ReportPage(record, content).pieces());
    tell(file);
  }
  if (pdf) {
    print_page(sheet_html(record, content), PrintFormat::pdf, *pdf);
    tell(*pdf);
  }
  if (png) {
    print_page(picture_html(record, content), PrintFormat::png, *png);
    tell(*png);
  }
  return ExitStatus::success;
}

}  // namespace

Command report_command() {
  return {.description = {.name = "report",
                          .example = "trace-path report coarse fine --measured test.csv --out both.html",
                          .usage = "DIR [DIR …] [options]",
                          .summary = "write report.html again, or overlay several runs in one page",
                          .options = {{.name = "measured",
                                       .value = "FILE.csv",
                                       .help = "draw measured points; the first line names lambda and monitors; may be "
                                               "repeated",
                                       .repeatable = true},
                                      {"pdf", "FILE", "write one sheet A4 with curve, shapes and tables (by Chromium)"},
                                      {"png", "FILE", "write the curve as a picture (by Chromium)"},
                                      {"out", "FILE", "page to write (default: report.html in the folder of the run)"}},
                          .least_words = 1,
                          .most_words = most_runs},
          .run = write_report};
}

}  // namespace arcwall
