#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "app/alarm.hpp"
#include "idl/duration_histogram.hpp"
#include "meter/error_window.hpp"
#include "sim/phase.hpp"
#include "sim/snapshot.hpp"

namespace slod {

/// What is kept of a run of any length, in bounded memory.
struct RunSummary {
    std::uint64_t frames = 0;
    double time = 0;              ///< scene time at the end
    std::uint64_t particles = 0;  ///< at the end
    std::uint64_t clusters = 0;   ///< at the end
    std::uint64_t state_hash = 0; ///< at the end
    double wall_s = 0;            ///< first frame's start to last frame's end, the pacer's waits included
    double processor_s = 0;       ///< of all threads of the process, over the same time
    FrameCounts events;           ///< for_each_event() of it: totals over the run
    Vector3d unanswered_force{0, 0, 0}; ///< at the end: Snapshot's
    Losses drained, killed;             ///< by sinks and by colliders, over the run
    Quarantined quarantined;            ///< over the run
    ConservedQuantities conserved_start;
    ConservedQuantities conserved_end;
    std::vector<Alarm> alarms;  ///< over the run, those that are over first
    ErrorEstimate error;        ///< of accelerations, at the end
    DurationHistogram frame_ms; ///< a frame's work, without the pacer's wait
    std::array<DurationHistogram, phase_count> phase_ms;

    /// Takes in one frame.
    void add(const Snapshot& snapshot, double work_ms);
};

/// Changes of the conserved quantities over a run, each relative to a scale of its own; NaN where the scale
/// is 0.
struct Drift {
    double mass;     ///< change / mass at the start
    double momentum; ///< |change| / sqrt(2 M K) at the start, the largest momentum of mass M and energy K
    double angular_momentum; ///< |change| / |angular momentum| at the start
    double kinetic_energy;   ///< change / kinetic energy at the start; physics as well as error
};
Drift drift(const ConservedQuantities& start, const ConservedQuantities& end);

} // namespace slod
