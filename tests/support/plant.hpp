#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "control/controller.hpp"
#include "core/random.hpp"

namespace slod::test {

/// A server in place of a server: its work follows from the clusters, and they follow the level of detail
/// with a lag. Scene sizes are 64 particles in one region.
struct Plant {
    double particles = 64'000;
    double overhead_ms = 1;   ///< of a frame, whatever the clusters
    double cost_ms = 0.01;    ///< of a cluster
    double exponent = 1;      ///< of the number of clusters in the work
    double lag_frames = 6;    ///< of the clusters behind the level of detail
    double noise = 0;         ///< largest relative error of a measured work
    double load = 1;          ///< factor of all work, by what else the machine does
    double clusters = 1000;   ///< at present
    std::uint64_t frames = 0; ///< run so far

    /// Runs a frame; returns its work in milliseconds.
    double run(const Detail& detail)
    {
        clusters += (particles / size(detail) - clusters) / lag_frames;
        const double error = noise * (2 * Random(7, 1, frames).uniform() - 1);
        ++frames;
        return load * (1 + error) * (overhead_ms + cost_ms * std::pow(clusters, exponent));
    }

    /// What a controller is told of the frame.
    FrameWork told(double work_ms, double target_ms) const
    {
        return {work_ms, target_ms, std::uint64_t(particles), std::uint64_t(clusters)};
    }

    /// Particles per cluster that the detail allows.
    static double size(const Detail& detail)
    {
        return std::clamp(64 * detail.cluster_size, detail.least_size, detail.most_size);
    }
};

/// Runs `frames` of the plant under the controller; calls each(work, detail) after every one.
template <class Each>
void run(Plant& plant, Controller& controller, Detail& detail, int frames, double target_ms, const Each& each)
{
    for (int frame = 0; frame < frames; ++frame) {
        const double work = plant.run(detail);
        detail = controller.next(plant.told(work, target_ms));
        each(work, detail);
    }
}

} // namespace slod::test
