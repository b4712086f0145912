#pragma once

#include "answers/curve_session.hpp"
#include "apps/cli/call_options.hpp"
#include "apps/output/exit_status.hpp"
#include "apps/output/files.hpp"

namespace arcwall {

/// Traces a curve of events until its ends, a limit or a signal, keeps checkpoints on the way and writes all files.
ExitStatus trace_curve_and_write(CurveSession& session, const OutputFolder& folder, const CallOptions& options);

}  // namespace arcwall
