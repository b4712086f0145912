#include "apps/sweep/job_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

namespace arcwall::sweep {

namespace {

// The command itself names no file: GNU parallel would see its own signs in a name, and shells theirs.
constexpr const char* one_case = R"("$TRACE_PATH" sweep run "$SWEEP" --case)";

std::string names(const JobScript& job) {
  return fmt::format("[ -n \"${{TRACE_PATH:-}}\" ] || TRACE_PATH={}\nSWEEP={}\nexport TRACE_PATH SWEEP\n",
                     shell_word(job.program.string()), shell_word(job.folder.string()));
}

std::string parallel(const JobScript& job) {
  return fmt::format(
      "#!/bin/sh\n"
      "# Runs the cases of a sweep with GNU parallel. Cases that have results are not run again.\n"
      "set -eu\n{}PARALLEL_SHELL=/bin/sh\nexport PARALLEL_SHELL\n"
      "seq 0 {} | parallel{} '{} {{}}'\n",
      names(job), job.cases - 1, job.jobs ? fmt::format(" --jobs {}", *job.jobs) : "", one_case);
}

// Clusters limit the size of an array, mostly to 1001 tasks, so that a task of a large sweep runs several cases.
std::string slurm(const JobScript& job) {
  constexpr int most_tasks = 1000;
  const int tasks = std::min(job.cases, most_tasks);
  return fmt::format(
      "#!/bin/sh\n"
      "#SBATCH --job-name=sweep\n"
      "#SBATCH --array=0-{}{}\n"
      "#SBATCH --ntasks=1\n"
      "# Runs the cases of a sweep as an array of Slurm. Cases that have results are not run again.\n"
      "set -u\n{}"
      "status=0\n"
      "case=$SLURM_ARRAY_TASK_ID\n"
      "while [ \"$case\" -lt {} ]; do\n"
      "  {} \"$case\" || status=$?\n"
      "  case=$((case + {}))\n"
      "done\n"
      "exit \"$status\"\n",
      tasks - 1, job.jobs ? fmt::format("%{}", *job.jobs) : "", names(job), job.cases, one_case, tasks);
}

}  // namespace

std::string shell_word(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

std::string script(Engine engine, const JobScript& job) {
  switch (engine) {
    case Engine::parallel:
      return parallel(job);
    case Engine::slurm:
      return slurm(job);
  }
  assert(false);
  return {};
}

}  // namespace arcwall::sweep
