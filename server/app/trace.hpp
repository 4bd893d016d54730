#pragma once

#include <filesystem>

#include "app/line_file.hpp"
#include "control/controller.hpp"
#include "sim/snapshot.hpp"

namespace slod {

/// What one frame took.
struct FrameTime {
    double wall_s;    ///< its end, since the run began
    double step_ms;   ///< wall time of the step and the hand-over to the publisher
    double encode_ms; ///< processor time of the publisher's, if a frame was encoded meanwhile
};

/// Writes a line per frame as the run goes: CSV, for plots.
class TraceWriter {
public:
    /// Creates or empties the file. Throws std::system_error.
    explicit TraceWriter(const std::filesystem::path& file);

    /// Throws std::system_error.
    void add(const Snapshot& snapshot, const FrameTime& took, const ControlReport& regulation);

    /// Writes what is still in memory. Throws std::system_error.
    void finish() { file_.flush(); }

private:
    LineFile file_;
};

} // namespace slod
