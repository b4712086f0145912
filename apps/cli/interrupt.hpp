#pragma once

#include <array>
#include <csignal>

namespace arcwall {

/// While it lives, the signals that ask a program to end (SIGINT and SIGTERM, SIGHUP of a terminal that is closed,
/// SIGXCPU and SIGUSR1 of batch systems before their limits) only set a flag, so that a run can finish its arc and
/// write what it has. At most one at a time.
class InterruptGuard {
 public:
  InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
  ~InterruptGuard();

  bool interrupted() const;

 private:
  std::array<struct sigaction, 5> before_{};
};

/// From here on what cannot be written (a pipe that nobody reads, a file beyond its allowed size) is an error of the
/// call that writes, not a signal that ends the program.
void let_writes_fail();

}  // namespace arcwall
