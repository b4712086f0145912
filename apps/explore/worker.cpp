#include "apps/explore/worker.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <system_error>

#include "apps/sweep/child.hpp"
#include "core/error.hpp"

namespace arcwall::explore {

namespace {

void limit(decltype(RLIMIT_AS) what, double most) {
  constexpr double without = 1e15;
  const rlim_t value = most < without ? static_cast<rlim_t>(std::ceil(most)) : RLIM_INFINITY;
  const rlimit both{.rlim_cur = value, .rlim_max = value};
  ::prlimit(0, what, &both, nullptr);
}

void write_all(int descriptor, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t written = ::write(descriptor, text.data() + done, text.size() - done);
    if (written < 0 && errno != EINTR) ::_exit(0);  // nobody reads any more
    if (written > 0) done += static_cast<std::size_t>(written);
  }
}

// What the process does. A file that the deck names may be read; none is written.
int trace_into(int pipe, const Traces& traces, const TraceLimits& limits) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_DFL);
  limit(RLIMIT_AS, limits.gigabytes * 1e9);
  limit(RLIMIT_CPU, 2.0 * limits.seconds);
  limit(RLIMIT_FSIZE, 0.0);
  limit(RLIMIT_CORE, 0.0);
  traces([&](const std::string& line) { write_all(pipe, line); });
  return 0;
}

}  // namespace

Worker::Worker(const Traces& traces, const TraceLimits& limits) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0)
    throw OutputError("no pipe can be opened: " + std::generic_category().message(errno));
  const auto body = [&, into = ends[1]](const std::vector<std::string>&) { return trace_into(into, traces, limits); };
  try {
    process_ = sweep::start({.body = body, .folder = ".", .messages = "/dev/null"});
  } catch (const OutputError&) {
    for (const int end : ends) ::close(end);
    throw;
  }
  ::close(ends[1]);
  output_ = ends[0];
}

Worker::~Worker() {
  if (process_ == 0) return;
  ::kill(process_, SIGKILL);
  signal();
}

int Worker::signal() {
  int status = 0;
  while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) continue;
  process_ = 0;
  return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
}

}  // namespace arcwall::explore
