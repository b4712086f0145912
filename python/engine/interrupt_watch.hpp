#pragma once

#include <chrono>

#include "python/engine/python.hpp"

namespace arcwall::python {

using Clock = std::chrono::steady_clock;

inline double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// How long Ctrl-C may wait before it is looked at [s].
inline constexpr double between_signals = 0.05;

/// Whether a call that works without the interpreter's lock is to stop, since something waits in Python, such as an
/// interrupt by Ctrl-C. For one thread.
class InterruptWatch {
 public:
  /// Takes the lock for a moment, at most once in `between_signals`.
  bool stopped() {
    if (interrupted_ || seconds_since(since_) < between_signals) return interrupted_;
    since_ = Clock::now();
    const py::gil_scoped_acquire with_lock;
    return interrupted_ = PyErr_CheckSignals() != 0;
  }

  /// Raises what waited. The lock is held.
  void raise() const {
    if (interrupted_) throw py::error_already_set();
  }

 private:
  Clock::time_point since_ = Clock::now();
  bool interrupted_ = false;
};

}  // namespace arcwall::python
