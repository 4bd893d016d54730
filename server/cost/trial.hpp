#pragma once

#include <cstdint>
#include <functional>
#include <limits>

#include "cluster/particles.hpp"
#include "sim/phase.hpp"
#include "sim/settings.hpp"

namespace slod::cost {

/// Errors of members' accelerations, |a - exact| / |exact|; NaN where nobody is accelerated.
struct AccelerationErrors {
    double median = std::numeric_limits<double>::quiet_NaN();
    double p90 = median, p99 = median, max = median;
};

/// How a run went and what came out. A frame is one of the scene's, of however many steps.
struct Trial {
    double ms_median = 0, ms_p10 = 0, ms_p90 = 0; ///< of a frame's steps, wall time
    StepProfile phases;         ///< of a frame, means; what is measured between phases is in none of them
    std::uint64_t clusters = 0; ///< at the end
    AccelerationErrors force;   ///< at the end
    ParticleSet particles;      ///< at the end, by id
};

/// Milliseconds of wall time since any fixed moment.
using Clock = std::function<double()>;
double wall_milliseconds(); ///< by the system's clock

/// How long a run is.
struct TrialLength {
    int frames = 300;
    std::uint32_t steps = 1;    ///< of a frame, each of settings.time.step
    bool measures_error = true; ///< of accelerations, after the last frame
};

/// Runs the frames from `initial`. `progress` is told of each. The times of the first tenth are left out:
/// memory grows there.
Trial run_trial(const SimulationSettings& settings, const ParticleSet& initial, const TrialLength& length,
                const Clock& clock, const std::function<void(int)>& progress);

} // namespace slod::cost
