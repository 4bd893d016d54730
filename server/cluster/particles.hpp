#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/vectors.hpp"

namespace slod {

/// A particle by itself, mapped out of its cluster or not yet in one.
struct Particle {
    Vector3d position;                  ///< scene length
    Vector3d velocity;                  ///< scene length / time
    std::uint64_t id = 0;               ///< never used for another particle
    float mass = 0;                     ///< scene mass, >= 0
    std::uint32_t expiry_frame = never; ///< gone at the end of this frame
    std::uint8_t kind = 0;              ///< row of the scene's kinds

    static constexpr std::uint32_t never = std::numeric_limits<std::uint32_t>::max();
};

/// Particles as a file or a model delivers them, in any order.
using ParticleSet = std::vector<Particle>;

/// What all particles of a kind share.
struct ParticleKind {
    std::string name;     ///< [a-z0-9_-]{1,32}
    double softening = 0; ///< Plummer softening length eps; a pair is softened by (eps_i^2 + eps_j^2) / 2

    friend bool operator==(const ParticleKind&, const ParticleKind&) = default;
};

} // namespace slod
