#include <iostream>

#include "apps/cli/commands.hpp"
#include "apps/output/files.hpp"
#include "apps/output/report_html.hpp"
#include "model/session.hpp"

namespace arcwall {

namespace {

ExitStatus write_report(const Options& options) {
  const std::filesystem::path folder = options.words().front();
  std::error_code ignored;
  std::optional<FolderLock> lock;
  if (std::filesystem::is_directory(folder, ignored)) lock.emplace(folder);
  const Session run = stored_session(folder, Session::Resume::as_ended);
  const std::filesystem::path file = folder / "report.html";
  const DrawnScenes drawn = scenes_to_draw(run.model(), run.record());
  write_whole(file, ReportPage(run.record(), report_content(run.model(), run.record(), drawn)).pieces());
  std::cerr << "wrote " << file.string() << "\n";
  return ExitStatus::success;
}

}  // namespace

Command report_command() {
  return {.description = {.name = "report",
                          .example = "trace-path report results",
                          .usage = "DIR",
                          .summary = "writes report.html of a run again",
                          .least_words = 1,
                          .most_words = 1},
          .run = write_report};
}

}  // namespace arcwall
