#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/regulator.hpp"
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
    explicit TraceWriter(std::filesystem::path file);

    /// Throws std::system_error.
    void add(const Snapshot& snapshot, const FrameTime& took, const Regulator::Report& regulation);

    /// Writes what is still in memory. Throws std::system_error.
    void finish();

private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    void check(bool written) const;

    std::filesystem::path place_;
    std::unique_ptr<std::FILE, Close> file_;
};

} // namespace slod
