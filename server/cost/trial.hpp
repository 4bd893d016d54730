#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "cluster/particles.hpp"
#include "scene/scene.hpp"

namespace slod::cost {

/// One way to run the scene.
struct Setting {
    Motion motion = Motion::Flow;
    double max_cluster_size = 1; ///< of the background; regions keep their proportion to it

    std::string name() const; ///< "flow 16", "unclustered"
    bool unclustered() const { return max_cluster_size < 2; }
};

/// The scene's simulation with this setting.
SimulationSettings with_setting(const SimulationSettings& scene, const Setting& setting);

/// How a run went and what came out.
struct Trial {
    double ms_median = 0, ms_p10 = 0, ms_p90 = 0; ///< of a frame's step, wall time
    std::uint64_t clusters = 0;                   ///< at the end
    double momentum_drift = 0; ///< |change| over sqrt(2 M K) at the end, the largest momentum there could be
    double energy_change = 0;  ///< of kinetic energy, relative; physics as well as error
    ParticleSet particles;     ///< at the end, by id
};

/// Milliseconds of wall time since any fixed moment.
using Clock = std::function<double()>;
double wall_milliseconds(); ///< by the system's clock

/// Runs `frames` frames from `initial`. `progress` is told of each. The times of the first tenth are left
/// out: memory grows there.
Trial run_trial(const SimulationSettings& settings, const ParticleSet& initial, int frames,
                const Clock& clock, const std::function<void(int)>& progress);

} // namespace slod::cost
