#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "cost/trial.hpp"

namespace slod::cost {

/// What is run, and for how long.
struct SweepPlan {
    std::vector<Setting> settings; ///< the unclustered one apart
    int frames = 300;
    int seeds = 5; ///< unclustered runs that say how far two runs are that nobody could tell apart

    /// All motions at sizes from 2 to 256, or a few of them over fewer frames.
    static SweepPlan full();
    static SweepPlan quick();
};

/// Distances from the unclustered run, each in units of the noise floor: the mean distance of unclustered
/// runs of other seeds from it. 1: as another seed; below 2 good, above 3 visible.
struct Errors {
    double position = 0; ///< sliced Wasserstein distance
    double velocity = 0; ///< likewise
    double coarse = 0;   ///< of densities in cubes of a quarter of the rms radius
    double fine = 0;     ///< and of a sixteenth

    double largest() const;
};

/// The outcome for one setting.
struct Row {
    Setting setting;
    double ms_median = 0, ms_p10 = 0, ms_p90 = 0;
    std::uint64_t clusters = 0;
    Errors errors;
    double median_displacement = 0;   ///< of each particle, in rms radii; chaotic where there is gravity
    double r10 = 0, r50 = 0, r90 = 0; ///< Lagrangian radii over the unclustered run's
    double momentum_drift = 0, energy_change = 0;
};

/// The noise floor itself.
struct Floor {
    double position = 0, velocity = 0; ///< scene units
    double coarse = 0, fine = 0;
    double rms_radius = 0;  ///< scene length
    bool resampled = false; ///< the scene has no random numbers: bootstrap samples stand in for other seeds
};

struct Sweep {
    std::vector<Row> rows; ///< the unclustered one first
    Floor floor;
};

/// Told of what is going on: the name of the run, and the share of the whole that is done, in [0, 1].
using Progress = std::function<void(const std::string&, double)>;

/// Loads the scene's particles for a seed.
using Initial = std::function<ParticleSet(std::uint64_t seed)>;

/// Runs the plan. `scene` must have no problems(). Call it inside ThreadTeam::run.
Sweep run_sweep(const SimulationSettings& scene, const Initial& initial, const SweepPlan& plan,
                const Clock& clock, const Progress& progress);

} // namespace slod::cost
