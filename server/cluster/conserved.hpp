#pragma once

#include <cstdint>

#include "cluster/forming.hpp"
#include "core/vectors.hpp"

namespace slod {

/// Quantities that an isolated system conserves, in scene units.
struct ConservedQuantities {
    double mass = 0;
    Vector3d momentum{0, 0, 0};
    Vector3d angular_momentum{0, 0, 0}; ///< about the scene's origin, internal part included
    double kinetic_energy = 0;          ///< internal part included
    Vector3d mass_moment{0, 0, 0};      ///< sum of m x

    ConservedQuantities& operator+=(const ConservedQuantities& other);
};

/// Of one cluster, internal part included, from its moments: no member is visited.
ConservedQuantities conserved_quantities(const ClusterStore& store, std::size_t slot, std::uint64_t frame);

/// Of all clusters: sums of fixed blocks, added in order.
ConservedQuantities conserved_quantities(const ClusterStore& store, std::uint64_t frame);

} // namespace slod
