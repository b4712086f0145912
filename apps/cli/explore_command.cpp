#include <fcntl.h>
#include <spawn.h>
#include <unistd.h>

#include <array>
#include <iostream>

#include "apps/cli/commands.hpp"
#include "apps/explore/page_server.hpp"
#include "model/deck/toml_source.hpp"

namespace arcwall {

namespace {

// In a session of its own, so that the browser outlives this program and its terminal. False if there is no xdg-open.
bool open_in_browser(const std::string& address) {
  posix_spawn_file_actions_t quiet;
  posix_spawn_file_actions_init(&quiet);
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&quiet, descriptor, "/dev/null", O_RDWR, 0);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID);
  std::string program = "xdg-open", argument = address;
  const std::array<char*, 3> words{program.data(), argument.data(), nullptr};
  pid_t process = 0;
  const int error = ::posix_spawnp(&process, program.c_str(), &quiet, &attributes, words.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&quiet);
  return error == 0;
}

ExitStatus explore_deck(const Options& options) {
  const std::string file = options.words().front();
  explore::TraceLimits limits;
  limits.seconds = options.seconds("max-time").value_or(limits.seconds);
  const auto listening = [&](const std::string& address) {
    std::cout << address << std::endl;
    const bool opened = !options.has("no-browser") && open_in_browser(address);
    std::cerr << (opened ? "note: this page is opening in a browser; " : "note: open this address in a browser; ")
              << "the program ends with the page, or by Ctrl-C\n";
  };
  explore::serve({.file = file, .text = deck::read_text_file(file)}, limits, listening);
  return ExitStatus::success;
}

}  // namespace

Command explore_command() {
  return {.description = {.name = "explore",
                          .example = "trace-path explore channel.toml",
                          .usage = "DECK [options]",
                          .summary = "open a page with sliders for the deck's numbers; the curve follows them",
                          .options = {{"no-browser", "", "print the address of the page only"},
                                      {"max-time", "SECONDS", "of one trace; what was traced is shown (default: 60)"}},
                          .least_words = 1,
                          .most_words = 1},
          .run = explore_deck};
}

}  // namespace arcwall
