#include "apps/cli/progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdlib>
#include <iostream>
#include <string_view>

#include "apps/output/text_table.hpp"
#include "core/printable.hpp"

namespace arcwall {

namespace {

// A line that wraps could not be erased: it is cut to the terminal's width.
std::string cut(std::string text, std::size_t columns) {
  while (display_width(text) > columns) text.pop_back();
  return text;
}

std::size_t terminal_columns() {
  constexpr std::size_t usual = 80;
  winsize size{};
  const bool known = ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return (known ? size.ws_col : usual) - 1;
}

// Past std::cerr, which lets no control characters through. What cannot be shown is not worth an error.
void to_terminal(const std::string& text) {
  std::cerr << std::flush;
  if (::write(STDERR_FILENO, text.data(), text.size()) < 0) return;
}

}  // namespace

// A dumb terminal obeys no escapes, and its users do not want any; so with NO_COLOR.
Progress progress_wanted() {
  const char* const terminal = std::getenv("TERM");
  const bool obeys = terminal == nullptr || std::string_view(terminal) != "dumb";
  const bool wanted = obeys && ::isatty(STDERR_FILENO) == 1 && std::getenv("NO_COLOR") == nullptr;
  return wanted ? Progress::shown : Progress::hidden;
}

ProgressLine::~ProgressLine() {
  if (visible_) to_terminal("\r\x1b[K");
}

bool ProgressLine::is_due() const {
  constexpr auto pause = std::chrono::milliseconds(100);
  return progress_ == Progress::shown && !(visible_ && Clock::now() - last_ < pause);
}

void ProgressLine::show(const Record& record, const std::vector<std::string>& lambda_is) {
  if (is_due() && !record.points.empty()) show(progress_text(record, record.points.back(), lambda_is));
}

void ProgressLine::show(const std::string& text) {
  if (!is_due()) return;
  to_terminal("\r" + cut(printable(text), terminal_columns()) + "\x1b[K");
  last_ = Clock::now();
  visible_ = true;
}

std::string progress_text(const Record& record, const RecordPoint& point, const std::vector<std::string>& lambda_is) {
  const auto stage = static_cast<std::size_t>(record.branches[static_cast<std::size_t>(point.branch)].stage);
  std::string text = fmt::format("branch {}  {} points  λ={:.6g}", point.branch, point.step + 1, point.lambda);
  if (stage < lambda_is.size() && !lambda_is[stage].empty()) text += " (" + lambda_is[stage] + ")";
  for (std::size_t i = 0; i < point.monitors.size(); ++i)  // −0 + 0 is 0
    text += fmt::format("  {}={:.5g}", record.columns[i].name, point.monitors[i] + 0.0);
  text += "  unstable " + (point.count.unstable ? std::to_string(*point.count.unstable) : "?");
  return text + fmt::format("  contacts {}", point.contacts);
}

}  // namespace arcwall
