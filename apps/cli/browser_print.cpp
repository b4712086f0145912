#include "apps/cli/browser_print.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "apps/output/files.hpp"
#include "apps/sweep/child.hpp"
#include "core/error.hpp"

namespace arcwall {

namespace fs = std::filesystem;

namespace {

constexpr double most_seconds = 120.0;  // some hundred times what a page takes

// Debian's and other names of the browser, in the folders of PATH.
std::optional<fs::path> browser() {
  const char* const path = std::getenv("PATH");
  const std::string folders = path == nullptr ? "/usr/bin:/bin" : path;
  for (const char* const name : {"chromium", "chromium-browser", "google-chrome", "google-chrome-stable"})
    for (std::size_t begin = 0; begin <= folders.size();) {
      const std::size_t end = std::min(folders.find(':', begin), folders.size());
      const fs::path program = fs::path(folders.substr(begin, end - begin)) / name;
      if (program.is_absolute() && ::access(program.c_str(), X_OK) == 0) return program;
      begin = end + 1;
    }
  return std::nullopt;
}

// A folder of its own, which is removed with all that is in it.
class OwnFolder {
 public:
  OwnFolder() {
    std::string name = (fs::temp_directory_path() / "trace-path-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr)
      throw OutputError(name + ": cannot be created: " + std::generic_category().message(errno));
    path_ = name;
  }
  OwnFolder(const OwnFolder&) = delete;
  OwnFolder& operator=(const OwnFolder&) = delete;
  ~OwnFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

// The page has no scripts and loads nothing, so that root may do without the sandbox, which Chromium refuses to root.
std::vector<std::string> arguments(PrintFormat format, const fs::path& folder, const fs::path& made) {
  std::vector<std::string> words{"--headless",        "--disable-gpu",
                                 "--no-first-run",    "--disable-background-networking",
                                 "--disable-sync",    "--disable-component-update",
                                 "--hide-scrollbars", "--user-data-dir=" + (folder / "profile").string()};
  if (::geteuid() == 0) words.push_back("--no-sandbox");
  if (format == PrintFormat::pdf) {
    words.insert(words.end(), {"--no-pdf-header-footer", "--print-to-pdf=" + made.string()});
  } else {
    words.insert(words.end(),
                 {"--window-size=1080,800", "--force-device-scale-factor=2", "--screenshot=" + made.string()});
  }
  words.push_back("file://" + (folder / "page.html").string());
  return words;
}

// Until it ends by itself, or the time is over.
void wait_for(pid_t process) {
  const auto begin = std::chrono::steady_clock::now();
  int status = 0;
  for (pid_t ended = 0; ended == 0;) {
    ended = ::waitpid(process, &status, WNOHANG);
    if (ended < 0 && errno == EINTR) ended = 0;
    if (ended != 0) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (seconds > most_seconds) ::kill(process, SIGKILL);
  }
}

std::string bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

}  // namespace

void print_page(std::string_view page, PrintFormat format, const fs::path& file) {
  const std::optional<fs::path> program = browser();
  if (!program)
    throw OutputError(file.string() + ": Chromium draws it and is not installed; install Debian's package chromium");
  const OwnFolder folder;
  const fs::path made = folder.path() / (format == PrintFormat::pdf ? "page.pdf" : "page.png");
  write_whole(folder.path() / "page.html", page);
  wait_for(sweep::start({.program = *program,
                         .arguments = arguments(format, folder.path(), made),
                         .folder = folder.path(),
                         .messages = folder.path() / "messages"}));
  const std::string bytes = bytes_of(made);
  const std::string_view begin = format == PrintFormat::pdf ? "%PDF-" : "\x89PNG";
  if (!bytes.starts_with(begin)) {
    const std::string said = bytes_of(folder.path() / "messages");
    throw OutputError(file.string() + ": " + program->string() + " did not draw it" +
                      (said.empty() ? "" : ": " + said.substr(said.size() - std::min<std::size_t>(said.size(), 400))));
  }
  write_whole(file, bytes);
}

}  // namespace arcwall
