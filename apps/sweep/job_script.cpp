#include "apps/sweep/job_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

namespace arcwall::sweep {

namespace {

// A task has a share of the cases. The command itself names no file: GNU parallel would see its own signs in a name,
// and shells theirs. The options stand behind `set --`, for which any text is a word.
std::string one_task(const JobScript& job) {
  return std::string(R"("$TRACE_PATH" sweep run "$SWEEP" --quiet --tolerant)") + (job.records ? " --records" : "") +
         " --part";
}

// Clusters limit the size of an array, mostly to 1001 tasks.
int tasks_of(const JobScript& job) {
  constexpr int most_tasks = 1000;
  return std::min(job.cases, job.tasks.value_or(most_tasks));
}

std::string names(const JobScript& job) {
  return fmt::format("[ -n \"${{TRACE_PATH:-}}\" ] || TRACE_PATH={}\nSWEEP={}\nexport TRACE_PATH SWEEP\n",
                     shell_word(job.program.string()), shell_word(job.folder.string()));
}

std::string options(const JobScript& job) {
  std::string words;
  for (const std::string& option : job.options) words += " " + shell_word(option);
  return words;
}

// Options are passed by a file of their own words: the shell that parallel starts takes its command apart once more.
std::string parallel(const JobScript& job) {
  const int tasks = tasks_of(job);
  const std::string words = options(job);
  return fmt::format(
      "#!/bin/sh\n"
      "# Runs the cases of a sweep with GNU parallel. Cases that have results are not run again.\n"
      "set -eu\n{}PARALLEL_SHELL=/bin/sh\nOPTIONS={}\nexport PARALLEL_SHELL OPTIONS\n"
      "seq 0 {} | parallel{} 'eval \"set --$OPTIONS\"; {} {{}}/{} -- \"$@\"'\n",
      names(job), shell_word(words), tasks - 1, job.jobs ? fmt::format(" --jobs {}", *job.jobs) : "", one_task(job),
      tasks);
}

std::string directive(const char* name, const std::string& value) {
  return value.empty() ? "" : fmt::format("#SBATCH --{}={}\n", name, value);
}

// Half a minute before its time is over a task is told, so that the case that it runs keeps a checkpoint; the next
// submission goes on from there.
std::string slurm(const JobScript& job) {
  const int tasks = tasks_of(job);
  return fmt::format(
             "#!/bin/sh\n"
             "#SBATCH --job-name=sweep\n"
             "#SBATCH --array=0-{}{}\n"
             "#SBATCH --ntasks=1\n"
             "#SBATCH --signal=B:TERM@30\n",
             tasks - 1, job.jobs ? fmt::format("%{}", *job.jobs) : "") +
         directive("time", job.time) + directive("mem", job.memory) + directive("partition", job.partition) +
         directive("output", job.log) +
         fmt::format(
             "# Runs the cases of a sweep as an array of Slurm. Cases that have results are not run again.\n"
             "set -u\n{}set --{}\n"
             "exec {} \"$SLURM_ARRAY_TASK_ID/{}\" -- \"$@\"\n",
             names(job), options(job), one_task(job), tasks);
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
