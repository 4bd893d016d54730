#pragma once

#include <array>
#include <cstddef>

#include "gravity/force_view.hpp"
#include "gravity/kernel_bodies.hpp"
#include "simd/kernels.hpp"

namespace slod {

/// What far nodes do about a point, in a system's ScaledUnits.
using Expansion = simd::FarExpansion<double>;

/// The same about another point, `offset` (in lengths of the units) away from that one, in powers of the
/// offset over `reach` > 0. Exact, as it is a polynomial.
Expansion moved(const Expansion& expansion, const Vector3d& offset, double reach);

/// Both together: of one point and one reach.
Expansion operator+(const Expansion& a, const Expansion& b);

/// What far nodes do to targets within a ball: their pull at its centre and the first three of its
/// derivatives there, the first two with the nodes' second moments (Greengard and Rokhlin 1987, J. Comput.
/// Phys. 73, 325; in Cartesian coordinates, as softened gravity is not harmonic). A node takes the time of a
/// pair with one target, however many targets there are.
template <class Real>
class FarField {
public:
    FarField(const simd::GravityKernels<Real>& kernels, const ScaledUnits& units)
        : kernels_(kernels), units_(units)
    {}

    /// Begins anew for the bodies of `targets`.
    void begin(const ForceView::Node& targets);

    /// Adds a node; its centre is farther from the targets' than the radii of both.
    void add(const ForceView::Node& node, const Symmetric3& second_moments);

    bool empty() const { return added_ == 0; }

    /// What has been added, about the targets' centre in powers of the offset over their radius.
    Expansion sum();

private:
    static constexpr std::size_t most_nodes = 128; ///< of one chunk, a multiple of the kernels' tile

    void flush();

    const simd::GravityKernels<Real>& kernels_;
    ScaledUnits units_;
    Vector3d centre_{0, 0, 0};
    double reach_ = 0, q_ = 0; ///< in units
    std::size_t count_ = 0, added_ = 0;
    KernelNodes<Real, most_nodes> nodes_;
    std::array<double, simd::FarTerm::count> terms_;
};

extern template class FarField<float>;
extern template class FarField<double>;

} // namespace slod
