#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "gravity/force_view.hpp"
#include "simd/kernels.hpp"

namespace slod {

/// Powers of two amid a system's lengths and near its mass. Kernels compute in these units, so that no power
/// of a distance leaves the range of a float; scaling by them is exact.
struct ScaledUnits {
    double length = 1, mass = 1;
};

/// Of a view that holds bodies.
ScaledUnits units_of(const ForceView& view);

/// A point near which most of the bodies [first, last) are, at most BlockSum's: the median of each
/// coordinate. An outlier must not draw the origin away from the others.
Vector3d middle_of_block(const ForceView& view, std::size_t first, std::size_t last);

/// A block of bodies as kernels take them.
template <class Real, std::size_t capacity>
struct alignas(64) KernelBodies {
    std::array<Real, capacity> x, y, z, mass, q;

    void put(std::size_t place, const Vector3d& relative, double body_mass, double body_q,
             const ScaledUnits& units)
    {
        const double per_length = 1 / units.length;
        x[place] = Real(relative.x() * per_length);
        y[place] = Real(relative.y() * per_length);
        z[place] = Real(relative.z() * per_length);
        mass[place] = Real(body_mass / units.mass);
        q[place] = Real(body_q * per_length * per_length);
    }

    /// Puts bodies [first, last) of a view from `place` on.
    void load(std::size_t place, const ForceView& view, std::size_t first, std::size_t last,
              const Vector3d& origin, const ScaledUnits& units)
    {
        for (std::size_t body = first; body < last; ++body)
            put(place + body - first, view.position(body) - origin, view.mass[body], view.q[body], units);
    }

    /// Makes everything from `place` on a finite nothing.
    void pad(std::size_t place)
    {
        for (auto* column : {&x, &y, &z, &mass, &q})
            std::fill(column->begin() + std::ptrdiff_t(place), column->end(), Real(0));
    }
};

/// A block of nodes as kernels take them.
template <class Real, std::size_t capacity>
struct alignas(64) KernelNodes : KernelBodies<Real, capacity> {
    std::array<Real, capacity> xx, xy, xz, yy, yz, zz; ///< three times the second moments per mass
    std::array<Real, capacity> trace;                  ///< half of theirs

    void put_moments(std::size_t place, const Symmetric3& moments, double node_mass, const ScaledUnits& units)
    {
        const double scale = node_mass > 0 ? 3 / (node_mass * units.length * units.length) : 0;
        xx[place] = Real(scale * moments.xx);
        xy[place] = Real(scale * moments.xy);
        xz[place] = Real(scale * moments.xz);
        yy[place] = Real(scale * moments.yy);
        yz[place] = Real(scale * moments.yz);
        zz[place] = Real(scale * moments.zz);
        trace[place] = Real(0.5 * scale * moments.trace());
    }
};

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
