#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "gravity/force_view.hpp"
#include "simd/kernels.hpp"

namespace slod {

/// Powers of two amid a system's lengths and near its mass. Kernels compute in these units, so that no power
/// of a distance leaves the range of a float; scaling by them is exact.
struct ScaledUnits {
    double length = 1, mass = 1;
    double per_length = 1 / length, per_mass = 1 / mass;
};

/// Of a view that holds bodies.
ScaledUnits units_of(const ForceView& view);

/// A block of bodies as kernels take them.
template <class Real, std::size_t capacity>
struct alignas(64) KernelBodies {
    std::array<Real, capacity> x, y, z, mass, q;

    void put(std::size_t place, const Vector3d& relative, double body_mass, double body_q,
             const ScaledUnits& units)
    {
        x[place] = Real(relative.x() * units.per_length);
        y[place] = Real(relative.y() * units.per_length);
        z[place] = Real(relative.z() * units.per_length);
        mass[place] = Real(body_mass * units.per_mass);
        q[place] = Real(body_q * units.per_length * units.per_length);
    }

    /// Puts bodies [first, last) of a view from `place` on.
    void load(std::size_t place, const ForceView& view, std::size_t first, std::size_t last,
              const Vector3d& origin, const ScaledUnits& units)
    {
        for (std::size_t body = first; body < last; ++body)
            put(place + body - first, view.position(body) - origin, view.mass[body], view.q[body], units);
    }

    /// Makes [first, last) a finite nothing.
    void pad(std::size_t first, std::size_t last)
    {
        for (auto* column : {&x, &y, &z, &mass, &q})
            std::fill(column->begin() + std::ptrdiff_t(first), column->begin() + std::ptrdiff_t(last),
                      Real(0));
    }

    simd::GravitySources<Real> list(std::size_t count) const
    {
        return {count, x.data(), y.data(), z.data(), mass.data(), q.data()};
    }
};

/// A block of nodes as kernels take them.
template <class Real, std::size_t capacity>
struct alignas(64) KernelNodes : KernelBodies<Real, capacity> {
    std::array<Real, capacity> xx, xy, xz, yy, yz, zz; ///< three times the second moments per mass
    std::array<Real, capacity> trace;                  ///< half of theirs

    /// `moments` are per mass.
    void put_moments(std::size_t place, const Symmetric3& moments, const ScaledUnits& units)
    {
        const double scale = 3 * units.per_length * units.per_length;
        xx[place] = Real(scale * moments.xx);
        xy[place] = Real(scale * moments.xy);
        xz[place] = Real(scale * moments.xz);
        yy[place] = Real(scale * moments.yy);
        yz[place] = Real(scale * moments.yz);
        zz[place] = Real(scale * moments.zz);
        trace[place] = Real(0.5 * scale * moments.trace());
    }

    void pad(std::size_t first, std::size_t last)
    {
        KernelBodies<Real, capacity>::pad(first, last);
        for (auto* column : {&xx, &xy, &xz, &yy, &yz, &zz, &trace})
            std::fill(column->begin() + std::ptrdiff_t(first), column->begin() + std::ptrdiff_t(last),
                      Real(0));
    }

    simd::GravityNodes<Real> list(std::size_t count) const
    {
        return {KernelBodies<Real, capacity>::list(count),
                xx.data(),
                xy.data(),
                xz.data(),
                yy.data(),
                yz.data(),
                zz.data(),
                trace.data()};
    }
};

} // namespace slod
