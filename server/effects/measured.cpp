#include "effects/measured.hpp"

namespace slod {

Measured measured(const ClusterTable& clusters, std::size_t slot)
{
    Measured measured;
    if (clusters.columns.acceleration)
        measured.acceleration = clusters.acceleration[slot];
    if (clusters.columns.tide)
        measured.tide = clusters.tide[slot];
    if (clusters.columns.turning)
        measured.turning = clusters.turning[slot];
    if (clusters.columns.variance())
        measured.variance = clusters.variance[slot];
    if (clusters.columns.strain)
        measured.strain = clusters.strain[slot];
    return measured;
}

void set_measured(ClusterTable& clusters, std::size_t slot, const Measured& measured)
{
    if (clusters.columns.acceleration)
        clusters.acceleration[slot] = measured.acceleration;
    if (clusters.columns.tide)
        clusters.tide[slot] = measured.tide;
    if (clusters.columns.turning)
        clusters.turning[slot] = measured.turning;
    if (clusters.columns.variance())
        clusters.variance[slot] = clusters.count[slot] > 1 ? measured.variance : 0;
    if (clusters.columns.strain)
        clusters.strain[slot] = measured.strain;
}

} // namespace slod
