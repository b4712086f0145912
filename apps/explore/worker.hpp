#pragma once

#include <sys/types.h>

#include "apps/explore/traced_page.hpp"

namespace arcwall::explore {

/// How far one trace goes.
struct TraceLimits {
  double seconds = 60.0;   ///< after which it is stopped; of the processor it gets twice as much
  double gigabytes = 4.0;  ///< of memory
};

/// What a process does: it traces, and gives lines.
using Traces = std::function<void(const LineSink& give)>;

/// A process that traces and writes its lines into a pipe. It ends with this object, and with this program; it writes
/// no file. This program must have one thread.
class Worker {
 public:
  /// Throws OutputError where no process can be started.
  Worker(const Traces& traces, const TraceLimits& limits);
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  ~Worker();

  /// The end of the pipe that is read. It belongs to the caller.
  int output() const { return output_; }

  /// The signal that ended the process, which has closed its pipe; 0: none.
  int signal();

 private:
  pid_t process_ = 0;
  int output_ = -1;
};

}  // namespace arcwall::explore
