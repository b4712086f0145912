#include "apps/sweep/child.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <csignal>
#include <ctime>
#include <iostream>

#include "core/error.hpp"

namespace arcwall::sweep {

namespace {

// What the child needs, made before the fork. This program has one thread, so that a body may allocate behind it.
struct Prepared {
  std::vector<char*> arguments{};
  const char* program = nullptr;
  const char* folder = nullptr;
  const char* messages = nullptr;
  pid_t parent = 0;
  int kept_open = -1;
  const ChildCommand* command = nullptr;
};

[[noreturn]] void become(const Prepared& prepared) {
  // The parent may have ended before prctl() was called.
  if (::prctl(PR_SET_PDEATHSIG, SIGKILL) != 0 || ::getppid() != prepared.parent) ::_exit(not_started);
  const int nothing = ::open("/dev/null", O_RDWR);
  const int messages = ::open(prepared.messages, O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW, 0666);
  if (nothing < 0 || messages < 0 || ::dup2(nothing, STDIN_FILENO) < 0 || ::dup2(nothing, STDOUT_FILENO) < 0 ||
      ::dup2(messages, STDERR_FILENO) < 0)
    ::_exit(not_started);
  ::close(nothing);
  ::close(messages);
  if (::chdir(prepared.folder) != 0) ::_exit(not_started);
  if (prepared.kept_open >= 0 && ::fcntl(prepared.kept_open, F_SETFD, 0) != 0) ::_exit(not_started);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  if (prepared.command->body) {
    const int status = prepared.command->body(prepared.command->arguments);
    std::cout.flush();
    ::_exit(status);
  }
  ::execv(prepared.program, prepared.arguments.data());
  ::_exit(not_started);
}

}  // namespace

pid_t start(const ChildCommand& command) {
  std::vector<std::string> words{"trace-path"};
  words.insert(words.end(), command.arguments.begin(), command.arguments.end());
  Prepared prepared{.program = command.program.c_str(),
                    .folder = command.folder.c_str(),
                    .messages = command.messages.c_str(),
                    .parent = ::getpid(),
                    .kept_open = command.kept_open,
                    .command = &command};
  for (std::string& word : words) prepared.arguments.push_back(word.data());
  prepared.arguments.push_back(nullptr);
  const pid_t child = ::fork();
  if (child == 0) become(prepared);
  if (child < 0) throw OutputError("no process can be started: " + std::generic_category().message(errno));
  return child;
}

SignalQueue::SignalQueue() {
  ::sigemptyset(&waiting_);
  for (const int signal : {SIGCHLD, SIGINT, SIGTERM}) ::sigaddset(&waiting_, signal);
  ::sigprocmask(SIG_BLOCK, &waiting_, &before_);
}

SignalQueue::~SignalQueue() { ::sigprocmask(SIG_SETMASK, &before_, nullptr); }

int SignalQueue::next(double seconds) const {
  const double whole = std::floor(seconds);
  const timespec time{.tv_sec = static_cast<time_t>(whole), .tv_nsec = static_cast<long>((seconds - whole) * 1e9)};
  const int signal = ::sigtimedwait(&waiting_, nullptr, &time);
  return signal > 0 ? signal : 0;
}

}  // namespace arcwall::sweep
