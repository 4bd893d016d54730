#pragma once

#include <cstdint>
#include <vector>

#include "gravity/force_view.hpp"
#include "gravity/target_runs.hpp"
#include "simd/kernels.hpp"

namespace slod {

/// What one evaluation of the forces did.
struct ForceCounts {
    std::uint64_t interactions = 0; ///< pairs of a body with another one or with a node
    std::uint64_t far_nodes = 0;    ///< that act on many bodies at once, by an expansion
    std::uint64_t groups = 0;       ///< of bodies that walked the tree together
    std::uint64_t nodes_tested = 0;
    /// Force by bodies on such as do not pull them in turn: momentum that nothing loses, per time.
    Vector3d unanswered{0, 0, 0};
};

/// Lists of an evaluation, kept for their memory.
struct ForceLists {
    std::vector<TargetRun> runs;
    std::vector<ForceCounts> counts; ///< by run
};

/// Provides memory for evaluations of so many bodies.
void reserve(ForceLists& lists, std::size_t bodies);

/// Accelerations of all clusters by gravity, and tidal tensors where the table has them, written to the
/// table: sums of G m_j d / (d^2 + q_i + q_j)^(3/2) over the bodies of all regions that act. Where fewer than
/// direct_below act they are sums over all pairs, else by walks of the tree: BranchWalk. The relative
/// criterion compares with the pull of the last evaluation. The view must be built with the same settings.
ForceCounts evaluate_gravity(const ForceView& view, const simd::KernelTable& kernels,
                             const GravitySettings& gravity, double gravitational_constant, ForceLists& lists,
                             ClusterTable& clusters);

} // namespace slod
