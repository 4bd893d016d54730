#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "gravity/far_field.hpp"
#include "gravity/force_view.hpp"
#include "gravity/kernel_bodies.hpp"
#include "simd/kernels.hpp"

namespace slod {

/// A point near which most of the bodies [first, last) are, at most BlockSum's: the median of each
/// coordinate. An outlier must not draw the origin away from the others.
Vector3d middle_of_block(const ForceView& view, std::size_t first, std::size_t last);

/// The forces on a block of neighbouring bodies: targets [first, last) of a view, sources added one by one
/// or in runs, kernels called for a chunk of sources at a time, of points or of nodes. Positions are relative
/// to the middle of the block; sums of a chunk are Real, sums of chunks double.
template <class Real>
class BlockSum {
public:
    static constexpr std::size_t most_targets = 256; ///< a multiple of the kernels' tile
    static constexpr std::size_t most_sources = 512; ///< of one chunk
    static constexpr std::size_t most_nodes = 256;   ///< of one chunk; no more memory than that of points

    /// With `tide`, the tidal tensor is summed too.
    BlockSum(const ForceView& view, const simd::GravityKernels<Real>& kernels, const ScaledUnits& units,
             std::size_t first, std::size_t last, bool tide);

    /// Adds bodies of the view: all of the targets, each one's own pair left out, or none of them.
    void add_bodies(std::size_t first, std::size_t last);

    /// Adds one source that is no body of the view.
    void add_point(const Vector3d& position, double mass, double q);

    /// Adds a node with its second moments; it holds none of the targets.
    void add_node(const ForceView::Node& node, const Symmetric3& second_moments);

    /// Adds what far nodes do about `point`.
    void add_expansion(const Expansion& expansion, const Vector3d& point);

    /// Sum over the targets of mass times acceleration / G, by the sources so far.
    Vector3d force();

    /// Writes the targets' accelerations, tides and pulls.
    void store(double gravitational_constant, ClusterTable& clusters);

    /// Pairs that were summed, without those of a target with itself. After store().
    std::uint64_t interactions() const { return interactions_; }

private:
    static constexpr std::size_t sum_count = 9; ///< three of acceleration, six of tide

    std::size_t used_sums() const { return tide_ ? sum_count : 3; }
    Vector3d sum(std::size_t target) const
    {
        return {total_[0][target], total_[1][target], total_[2][target]};
    }
    simd::GravityTargets<Real> cleared_sums();
    void take_sums(std::size_t source_count);
    void flush_points();
    void flush_nodes();
    void flush();

    const ForceView& view_;
    const simd::GravityKernels<Real>& kernels_;
    ScaledUnits units_;
    std::size_t first_, last_;
    std::size_t padded_count_;
    bool tide_;
    Vector3d origin_;
    std::uint64_t interactions_ = 0;
    std::size_t source_count_ = 0, node_count_ = 0;
    std::ptrdiff_t self_ = simd::no_self; ///< place of the first target among the sources
    KernelBodies<Real, most_targets> targets_;
    KernelBodies<Real, most_sources> sources_;
    KernelNodes<Real, most_nodes> nodes_;
    alignas(64) std::array<std::array<Real, most_targets>, sum_count> partial_;
    alignas(64) std::array<std::array<double, most_targets>, sum_count> total_;
};

extern template class BlockSum<float>;
extern template class BlockSum<double>;

} // namespace slod
