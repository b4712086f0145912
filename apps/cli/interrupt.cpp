#include "apps/cli/interrupt.hpp"

namespace arcwall {

namespace {

volatile std::sig_atomic_t signal_came = 0;

void note_signal(int) { signal_came = 1; }

constexpr std::array<int, 5> wishes_to_end{SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGUSR1};

}  // namespace

InterruptGuard::InterruptGuard() {
  signal_came = 0;
  struct sigaction action {};
  action.sa_handler = note_signal;
  action.sa_flags = SA_RESTART;
  for (std::size_t i = 0; i < wishes_to_end.size(); ++i) {
    ::sigaction(wishes_to_end[i], nullptr, &before_[i]);
    const bool ignored_by_nohup = wishes_to_end[i] == SIGHUP && before_[i].sa_handler == SIG_IGN;
    if (!ignored_by_nohup) ::sigaction(wishes_to_end[i], &action, nullptr);
  }
}

InterruptGuard::~InterruptGuard() {
  for (std::size_t i = 0; i < wishes_to_end.size(); ++i) ::sigaction(wishes_to_end[i], &before_[i], nullptr);
}

bool InterruptGuard::interrupted() const { return signal_came != 0; }

void let_writes_fail() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace arcwall
