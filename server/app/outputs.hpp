#pragma once

#include <optional>

#include "app/command_line.hpp"
#include "app/input_log.hpp"
#include "app/job.hpp"
#include "app/output_file.hpp"
#include "app/run_summary.hpp"
#include "app/server.hpp"
#include "app/trace.hpp"

namespace slod {

/// The files that a run leaves behind. Opened before it, so that what the command line could not foresee ends
/// the program at once and not after the run.
class Outputs {
public:
    /// Throws std::system_error, naming the place.
    Outputs(const CommandLine& line, const InputLogHeader& origin);

    /// Adds a change to the input log, if there is one. When that fails the log ends there, without a last
    /// line, and the run goes on.
    void record(const LoggedCommand& command);

    /// Adds a frame to the trace, if there is one. When that fails the trace ends there.
    void trace(const Snapshot& snapshot, const FrameTime& took, const ControlReport& regulation);

    /// Writes each by itself, and says of each that cannot be written why.
    Problems write(const Job& job, const Server& server, const RunSummary& summary);

private:
    std::optional<OutputFile> report_;
    std::optional<OutputFile> picture_;
    std::optional<InputLogWriter> input_log_;
    std::optional<TraceWriter> trace_;
};

/// Whether a run came out as its log says, which it prints; a run that is no replay always succeeds.
ExitCode compare_with_log(const Job& job, const RunSummary& summary);

} // namespace slod
