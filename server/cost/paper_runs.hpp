#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "cluster/particles.hpp"
#include "cost/figure5.hpp"
#include "cost/trial.hpp"
#include "sim/settings.hpp"

namespace slod::cost {

/// What is run for Figure 5, and for how long.
struct PaperPlan {
    std::vector<Motion> motions{Motion::Flow, Motion::Rigid};
    std::vector<double> sizes{4, 6, 8, 16, 32, 64}; ///< with those of the figure
    int settle_frames = 16;                         ///< before frames count; after those that fill a fountain
    int least_frames = 3, most_frames = 300;        ///< that count
    double run_ms = 3000;                           ///< after which, beyond the least, no more do
};

/// Told of what is going on.
using Announce = std::function<void(const std::string&)>;

/// The galaxy without clusters, by a plain direct sum in double, by our direct sum and by our tree, and with
/// clusters. Call these inside ThreadTeam::run.
PaperRun run_galaxy(const SimulationSettings& scene, const ParticleSet& stars, const PaperPlan& plan,
                    const Clock& clock, const Announce& announce);

/// The fountain when it is full, of at least so many droplets: without clusters, by a plain loop over
/// droplets, by our own with each droplet by itself, and by a loop as fast as we can make it; and with
/// clusters. Who has no clusters has no use for regions of interest, which would only cost time.
PaperRun run_fountain(const SimulationSettings& scene, std::size_t droplets, const PaperPlan& plan,
                      const Clock& clock, const Announce& announce);

/// The fountain with streams of so many droplets together, all from the start on: whole registers of them
/// are born by each emitter in each frame.
SimulationSettings filled_fountain(const SimulationSettings& scene, std::size_t droplets);

/// Frames that a droplet of the scene's first emitter lives.
std::size_t lifetime_frames(const SimulationSettings& scene);

} // namespace slod::cost
