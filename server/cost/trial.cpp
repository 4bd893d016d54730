#include "cost/trial.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

#include "cost/quantile.hpp"
#include "sim/simulation.hpp"

namespace slod::cost {

double wall_milliseconds()
{
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

std::string Setting::name() const
{
    if (unclustered())
        return "unclustered";
    return std::string(names(motion)[std::size_t(motion)]) + " " +
           std::to_string(std::uint64_t(max_cluster_size));
}

SimulationSettings with_setting(const SimulationSettings& scene, const Setting& setting)
{
    SimulationSettings settings = scene;
    settings.motion.motion = setting.motion;
    if (setting.motion != Motion::Rigid) { // what the two others do not have
        settings.motion.merged_velocities = MergedVelocities::Keep;
        settings.motion.build_respects_limits = false;
    }
    const double factor = setting.max_cluster_size / scene.background.max_cluster_size;
    settings.background.max_cluster_size = setting.max_cluster_size;
    for (RegionOfInterest& region : settings.regions)
        region.partition.max_cluster_size = std::max(region.partition.max_cluster_size * factor, 1.0);
    return settings;
}

Trial run_trial(const SimulationSettings& settings, const ParticleSet& initial, int frames,
                const Clock& clock, const std::function<void(int)>& progress)
{
    Simulation simulation(settings, initial, {.isa = "auto", .tick = {}});
    const ConservedQuantities start = simulation.snapshot({.conserved = true}).conserved;
    std::vector<double> times;
    for (int frame = 0; frame < frames; ++frame) {
        const double begin = clock();
        simulation.step({});
        if (frame >= frames / 10)
            times.push_back(clock() - begin);
        progress(frame);
    }
    const Snapshot& end = simulation.snapshot({.conserved = true});
    const double scale = std::sqrt(2 * end.conserved.mass * end.conserved.kinetic_energy);
    Trial trial{.ms_median = quantile(times, 0.5),
                .ms_p10 = quantile(times, 0.1),
                .ms_p90 = quantile(times, 0.9),
                .clusters = end.counts.clusters,
                .particles = simulation.particles()};
    if (scale > 0)
        trial.momentum_drift = (end.conserved.momentum - start.momentum).norm() / scale;
    if (start.kinetic_energy > 0)
        trial.energy_change = end.conserved.kinetic_energy / start.kinetic_energy - 1;
    return trial;
}

} // namespace slod::cost
