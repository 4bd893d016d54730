#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "cost/sweep_plan.hpp"
#include "cost/trial.hpp"

namespace slod::cost {

/// What a sweep found. All are compared with the reference: the unclustered run with its frames in four steps
/// and with gravity opened finer.
struct Sweep {
    std::vector<Row> rows{}; ///< the unclustered one first
    Floor floor{};
    std::uint64_t particles = 0; ///< of the reference at its end
};

/// Told of what is going on: the name of the run, and the share of the whole that is done, in [0, 1].
using Progress = std::function<void(const std::string&, double)>;

/// Loads the scene's particles for a seed.
using Initial = std::function<ParticleSet(std::uint64_t seed)>;

/// Runs the plan. `scene` must have no problems(). Call it inside ThreadTeam::run.
Sweep run_sweep(const SimulationSettings& scene, const Initial& initial, const SweepPlan& plan,
                const Clock& clock, const Progress& progress);

} // namespace slod::cost
