#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "cost/finished_runs.hpp"
#include "cost/sweep_plan.hpp"
#include "cost/trial.hpp"

namespace slod::cost {

/// What a sweep found. All are compared with the reference: the unclustered run with its frames in four steps
/// and with gravity opened finer.
struct Sweep {
    std::vector<Row> rows{}; ///< the unclustered one first
    Floor floor{};
    int runs = 0;  ///< that it took, references and other seeds apart
    int known = 0; ///< of them: finished before
};

/// Told of what is going on: the name of the run, and the share of the whole that is done, in [0, 1].
using Progress = std::function<void(const std::string&, double)>;

/// Loads the scene's particles for a seed.
using Initial = std::function<ParticleSet(std::uint64_t seed)>;

/// Runs the plan, but for the runs that are finished, and adds what it runs to them. The reference is run
/// once if any run is left. `scene` must have no problems(). Call it inside ThreadTeam::run.
Sweep run_sweep(const SimulationSettings& scene, const Initial& initial, const SweepPlan& plan,
                const Clock& clock, const Progress& progress, FinishedRuns& finished);

} // namespace slod::cost
