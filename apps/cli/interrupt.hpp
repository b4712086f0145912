#pragma once

#include <csignal>

namespace arcwall {

/// While it lives, SIGINT and SIGTERM only set a flag, so that a run can finish its arc and write what it has. At most
/// one at a time.
class InterruptGuard {
 public:
  InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
  ~InterruptGuard();

  bool interrupted() const;

 private:
  struct sigaction old_interrupt_ {
  }, old_terminate_{};
};

}  // namespace arcwall
