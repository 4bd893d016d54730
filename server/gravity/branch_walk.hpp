#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "gravity/block_sum.hpp"
#include "gravity/far_field.hpp"
#include "gravity/forces.hpp"
#include "gravity/node_sieve.hpp"
#include "gravity/opening.hpp"

namespace slod {

/// What all forces of an evaluation have in common.
template <class Real>
struct ForceTerms {
    const ForceView& view;
    const simd::GravityKernels<Real>& kernels;
    const GravitySettings& gravity;
    double gravitational_constant;
    ScaledUnits units;
};

/// The forces on a branch of the tree: from its root down to groups of neighbouring bodies, each node of
/// targets takes what it may of the sources that its parent has left to it. Nodes far from all its targets go
/// into an expansion, which is handed down (Dehnen 2002, J. Comput. Phys. 179, 27); those of more than its
/// own size are opened; the rest is left to its children. A group walks what is left to it (Barnes 1990), and
/// the kernels sum up over its bodies.
template <class Real>
class BranchWalk {
public:
    /// Bodies of one group, at most. What is far of a group takes the same time for any number of bodies, so
    /// that groups are smaller than without expansions. Plummer sphere of 100,000, tolerance 0.002, one
    /// thread, for 48, 64, 96 and 128: 93, 91, 90 and 88 ms, median error 7.6, 6.6, 5.9 and 5.4e-4.
    static constexpr std::uint32_t most_in_group = 96;

    /// Sources in the lists of all nodes on the way to a group, at most: those of a million bodies take some
    /// 3,000. Where there is no room for a list, children are left what their parent was.
    static constexpr std::size_t most_listed = 16384;

    /// With `room` for so many beyond the roots.
    BranchWalk(const ForceTerms<Real>& terms, std::uint32_t region, ClusterTable& clusters,
               std::size_t room = most_listed - most_roots);

    /// Writes the accelerations of the bodies below the node, and their tides where the table has them.
    ForceCounts run(std::uint32_t branch);

private:
    static constexpr std::size_t most_roots = 8192; ///< one for each region

    /// What acts on a node's targets.
    struct Sources {
        std::span<const std::uint32_t> nodes; ///< with all below them
        Expansion far{};                      ///< of others, about `point`; of reach 0: there are none
        Vector3d point{0, 0, 0};
    };

    /// Those that the targets act on in turn, and those that they do not.
    struct AllSources {
        Sources answered, unanswered;
    };

    Sources roots(bool answered);
    void descend(std::uint32_t targets, const AllSources& above);
    Sources settle(const ForceView::Node& targets, const Sources& above);
    bool leave(std::span<const std::uint32_t> nodes);
    bool leave_smaller(std::span<const std::uint32_t> nodes, const ForceView::Node& targets);
    void add_far();
    void finish(const ForceView::Node& targets, const AllSources& sources);
    void add(const Sources& sources, const ForceView::Node& targets,
             const simd::OpeningTerms<double>& opening, BlockSum<Real>& sum);
    Expansion moved_here(const Sources& sources, const ForceView::Node& targets);

    const ForceTerms<Real>& terms_;
    const ForceView& view_;
    std::uint32_t region_;
    ClusterTable& clusters_;
    double gross_pull_ = 0; ///< on the branch, over G
    ForceCounts counts_;
    NodeSieve<Real> sieve_;
    FarField<Real> far_;
    std::array<std::uint32_t, most_listed> lists_; ///< each behind that of its targets' parent
    std::size_t listed_ = 0;
    const std::size_t room_; ///< beyond the roots
    std::size_t end_ = 0;    ///< of the room
};

extern template class BranchWalk<float>;
extern template class BranchWalk<double>;

} // namespace slod
