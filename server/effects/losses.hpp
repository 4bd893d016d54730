#pragma once

#include <cstdint>

#include "core/vectors.hpp"

namespace slod {

/// What left the scene with particles that died, in one frame or in several.
struct Losses {
    std::uint64_t particles = 0;
    double mass = 0;            ///< scene mass
    Vector3d momentum{0, 0, 0}; ///< scene mass * length / time

    /// A particle that died at this velocity.
    void add(double particle_mass, const Vector3d& velocity)
    {
        ++particles;
        mass += particle_mass;
        momentum += particle_mass * velocity;
    }

    Losses& operator+=(const Losses& other)
    {
        particles += other.particles;
        mass += other.mass;
        momentum += other.momentum;
        return *this;
    }
};

} // namespace slod
