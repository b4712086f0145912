#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace arcwall::sweep {

/// What a process does in place of another program: it takes arguments and gives its exit status.
using ChildBody = std::function<int(const std::vector<std::string>&)>;

/// A program to be started, with its arguments, in a folder. It reads nothing, and writes its messages into a file.
struct ChildCommand {
  std::filesystem::path program{};
  ChildBody body{};  ///< in place of the program: a process of this one, which need not be loaded anew
  std::vector<std::string> arguments{};
  std::filesystem::path folder{};
  std::filesystem::path messages{};
  int kept_open = -1;  ///< a descriptor that the program inherits, though it is closed in others; −1: none
};

/// How a process ended.
struct ChildEnd {
  int status = 0;  ///< its exit status, if no signal ended it
  int signal = 0;  ///< 0: none
};

/// The exit status of a child whose program could not be started.
inline constexpr int not_started = 127;

/// Starts a process, which is killed when this one ends. Throws OutputError.
pid_t start(const ChildCommand& command);

/// While it lives, SIGCHLD, SIGINT and SIGTERM wait until they are asked for; in children they are as before. At most
/// one at a time.
class SignalQueue {
 public:
  SignalQueue();
  SignalQueue(const SignalQueue&) = delete;
  SignalQueue& operator=(const SignalQueue&) = delete;
  ~SignalQueue();

  /// The next of these signals; 0 if none comes in that time [s].
  int next(double seconds) const;

 private:
  sigset_t waiting_{}, before_{};
};

}  // namespace arcwall::sweep
