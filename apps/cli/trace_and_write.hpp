#pragma once

#include "apps/cli/call_options.hpp"
#include "apps/output/exit_status.hpp"
#include "apps/output/files.hpp"
#include "apps/output/result_json.hpp"
#include "model/session.hpp"

namespace arcwall {

/// Traces until the end, a limit or a signal, keeps checkpoints on the way and writes all files.
ExitStatus trace_and_write(Session& run, const OutputFolder& folder, const CallOptions& options,
                           const Stopwatch& since_begin);

/// Writes all files of what was traced so far, which may be a run under way: then as one that `stopped` there, though
/// the session itself goes on. The run has a point. Throws OutputError.
void write_run(Session& run, const OutputFolder& folder, const CallOptions& options, const BranchEnd& stopped,
               const RunSeconds& seconds);

}  // namespace arcwall
