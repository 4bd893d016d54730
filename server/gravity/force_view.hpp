#pragma once

#include <cstdint>
#include <vector>

#include "core/aligned.hpp"
#include "core/ids.hpp"
#include "gravity/settings.hpp"
#include "tree/slod_tree.hpp"

namespace slod {

/// The clusters as bodies that attract each other, and a hierarchy above them: depth-first arrays over all
/// regions' subtrees, k-d nodes below each grid cell and octants of cells above. Carries no state: rebuilt
/// every frame in O(clusters). Bodies of a node are one run, and neighbours in space are near in the run.
struct ForceView {
    /// A node covers bodies [first, first + count); the next node that is not below it is `next`.
    struct Node {
        std::uint32_t first = 0, count = 0;
        std::uint32_t next = 0;
        double mass = 0;
        Vector3d centre{0, 0, 0}; ///< of mass; of number when massless
        double radius = 0;        ///< no body's centre is farther from the centre than this
    };

    // By body.
    AlignedVector<double> x, y, z; ///< scene length
    AlignedVector<double> mass;
    AlignedVector<double> q; ///< half the squared softening and size: eps^2 / 2 + c s
    std::vector<ClusterSlot> slot;

    std::vector<Node> nodes; ///< depth first; one root per region that holds anything

    std::size_t body_count() const { return slot.size(); }
    Vector3d position(std::size_t body) const { return {x[body], y[body], z[body]}; }

    // Scratch of build().
    struct CellRoot {
        std::uint64_t key; ///< Morton code of the cell
        Cell cell;
        NodeId root;
    };
    std::vector<CellRoot> cells;
};

/// Measures every cluster's position variance and, with the closure on, its members' own attraction.
void measure_shapes(ClusterStore& store, const GravitySettings& gravity, double gravitational_constant,
                    std::uint64_t frame);

/// Provides memory for views of so many bodies in so many pools.
void reserve(ForceView& view, std::size_t bodies, std::size_t pools);

/// Rebuilds the view of the clusters as they are. The variances must be measured.
void build(ForceView& view, const SlodTree& tree, const ClusterTable& clusters,
           const GravitySettings& gravity);

/// What breaks the view's invariants; empty when nothing does.
Problems problems(const ForceView& view, const ClusterTable& clusters);

} // namespace slod
