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
    /// A node covers bodies [first, first + count); the next node that is not below it is `next`. It has no
    /// parts, or two to eight. One cache line: the walk waits for memory. Lengths are float, as nothing
    /// depends on their last bits.
    struct alignas(64) Node {
        std::uint32_t first = 0, count = 0;
        std::uint32_t next = 0;
        float radius = 0;         ///< no body's centre is farther from the centre than this
        Vector3d centre{0, 0, 0}; ///< of mass; of number when massless
        double mass = 0;
        /// Half the squared softening and size of the node as one body: the mass-weighted mean of its
        /// bodies'. The node's own extent is not added: its bodies pull as points of their own softening, and
        /// a sphere of them pulls from afar as a point in its middle does. What that misses is what the
        /// opening criterion bounds.
        double q = 0;
        float blur = 0;     ///< (15/8 var(q))^(1/4), what the bodies' q miss q by, as a length
        float q_spread = 0; ///< no body's q is farther from q
    };
    static_assert(sizeof(Node) == 64);

    /// Whether the node holds the other one, or is it; else it holds none of its bodies, or is one of its
    /// parts.
    friend bool holds(const Node& node, const Node& other)
    {
        return other.first - node.first < node.count; // below 0 wraps beyond any count
    }

    /// What belongs to one region of interest.
    struct Region {
        std::uint32_t first_body = 0, last_body = 0;
        std::uint32_t first_node = 0, last_node = 0;
        Attracts attracts = Attracts::Everything;

        std::uint32_t body_count() const { return last_body - first_body; }
    };

    // By body.
    AlignedVector<double> x, y, z; ///< scene length
    AlignedVector<double> mass;
    AlignedVector<double> q; ///< half the squared softening and size: eps^2 / 2 + c s
    std::vector<ClusterSlot> slot;

    AlignedVector<Node> nodes; ///< depth first; one root per region that holds anything
    /// Of the nodes, sum of m o o^T / sum of m with o the offset of a body's centre from the node's:
    /// length^2. Of massless ones 0. Empty where none are asked for. Bodies have none of their own: their
    /// extent softens them.
    AlignedVector<Symmetric3> second_moments;
    std::vector<Region> regions; ///< that hold anything, by row; bodies and nodes go region by region

    std::size_t body_count() const { return slot.size(); }
    Vector3d position(std::size_t body) const { return {x[body], y[body], z[body]}; }

    /// Whether the bodies of `source` pull those of `target`.
    bool acts(std::size_t source, std::size_t target) const
    {
        const Attracts attracts = regions[source].attracts;
        return attracts == Attracts::Everything || (attracts == Attracts::OwnRegion && source == target);
    }

    // Scratch of build().
    struct CellRoot {
        std::uint64_t key; ///< Morton code of the cell
        Cell cell;
        NodeId root;
    };
    std::vector<CellRoot> cells;
    struct PoolPlace {
        RegionRow region;
        PoolId pool;
        std::uint32_t first_body, first_node;
    };
    std::vector<PoolPlace> pools; ///< that hold anything
};

/// Measures every cluster's position variance and, with the closure on, its members' own attraction.
void measure_shapes(ClusterStore& store, const GravitySettings& gravity, double gravitational_constant,
                    std::uint64_t frame);

/// Provides memory for views of so many bodies in so many pools of so many regions.
void reserve(ForceView& view, std::size_t bodies, std::size_t pools, std::size_t regions,
             const GravitySettings& gravity);

/// Rebuilds the view of the clusters as they are. The variances must be measured.
void build(ForceView& view, const SlodTree& tree, const ClusterTable& clusters,
           const GravitySettings& gravity);

/// What breaks the view's invariants; empty when nothing does.
Problems problems(const ForceView& view, const ClusterTable& clusters);

} // namespace slod
