#pragma once

#include <functional>
#include <vector>

#include "cluster/forming.hpp"
#include "cost/force_errors.hpp"
#include "cost/trial.hpp"
#include "gravity/forces.hpp"
#include "tree/slod_tree.hpp"

namespace slod::cost {

/// Single particles, and the forces between them (G = 1) as a frame of the simulation evaluates them: the
/// view is rebuilt from nothing, then the tree is walked or all pairs are summed.
class ForceWorld {
public:
    /// `bodies` have ids 1, 2, 3, ... and attract each other with one softening length. Their velocities do
    /// not matter.
    ForceWorld(const ParticleSet& bodies, double softening);

    /// What the next evaluations go by.
    void set_gravity(const GravitySettings& gravity) { gravity_ = with_accuracy(gravity); }

    void rebuild();
    ForceCounts evaluate();

    std::vector<Vector3d> accelerations() const; ///< of the last evaluation, by the order of the bodies
    std::size_t bytes() const; ///< of view, lists, accelerations and last pulls, of one evaluation

private:
    ClusterStore store_;
    SlodTree tree_;
    GravitySettings gravity_;
    ForceView view_;
    ForceLists lists_;
};

/// What evaluations of the forces took. Times are in seconds.
struct ForceTrial {
    double seconds = 0;       ///< median of the whole, from clusters in their tree to accelerations
    double build_seconds = 0; ///< median of the view's part in it
    ForceCounts counts;       ///< of one evaluation
    ForceErrors error;
};

/// Evaluates once for the pulls that the relative criterion goes by, and then `repeats` times.
ForceTrial measure_forces(ForceWorld& world, const ExactForces& exact, int repeats, const Clock& clock);

} // namespace slod::cost
