#pragma once

#include "cluster/cluster_table.hpp"

namespace slod {

/// What was last measured of a cluster. It holds for one that is formed anew where that was, of members of
/// it, until forces are evaluated again; lives of maps are set, regions chosen and strays looked for before.
struct Measured {
    Vector3d acceleration{0, 0, 0};
    Symmetric3 tide{};
    Vector3d turning{0, 0, 0};
    double variance = 0;
    double strain = 0;
};

/// Of the cluster in `slot`.
Measured measured(const ClusterTable& clusters, std::size_t slot);

/// Takes it for that of the cluster in `slot`, which has no variance if it is a single particle.
void set_measured(ClusterTable& clusters, std::size_t slot, const Measured& measured);

} // namespace slod
