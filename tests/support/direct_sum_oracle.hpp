#pragma once

#include <span>
#include <vector>

#include "core/vectors.hpp"

namespace slod::test {

/// A body that attracts and is attracted.
struct PointMass {
    Vector3d position;
    double mass = 0;
    double q = 0; ///< half its squared softening
};

/// Gravity by its definition, in double, pair by pair: the oracle for everything faster.
/// Acceleration of a massless probe, with half its squared softening `q`, by all bodies but `except`.
Vector3d acceleration_at(const Vector3d& x, double q, std::span<const PointMass> bodies, double G,
                         const PointMass* except = nullptr);

/// Sum over pairs of -G m_i m_j / r.
double potential_energy_of(std::span<const PointMass> bodies, double G);

} // namespace slod::test
