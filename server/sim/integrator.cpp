#include "sim/integrator.hpp"

#include <atomic>

#include "core/parallel.hpp"

namespace slod {
namespace {

constexpr std::size_t block = 1024;

} // namespace

void kick_cluster(ClusterTable& clusters, std::size_t slot, double step)
{
    clusters.velocity[slot] += step * clusters.acceleration[slot];
    if (!clusters.columns.map)
        return;
    Matrix3d tide = clusters.gradient(slot);
    tide.diagonal().array() -= clusters.closure[slot];
    kick(clusters.map[slot], step, tide);
}

void kick_clusters(ClusterTable& clusters, double step)
{
    for_each_block(clusters.slot_count(), block, [&](std::size_t first, std::size_t last) {
        for (std::size_t slot = first; slot < last; ++slot)
            if (clusters.alive(slot))
                kick_cluster(clusters, slot, step);
    });
}

void propagate_clusters(ClusterTable& clusters, const Propagator& step)
{
    const bool centres_only =
        clusters.free_slots.empty() && !clusters.columns.withheld && !clusters.columns.map;
    for_each_block(clusters.slot_count(), block, [&](std::size_t first, std::size_t last) {
        if (centres_only) { // without a branch in the loop, as fast as a loop over particles
            for (std::size_t slot = first; slot < last; ++slot)
                step.apply(clusters.position[slot], clusters.velocity[slot]);
            return;
        }
        for (std::size_t slot = first; slot < last; ++slot) {
            if (!clusters.alive(slot))
                continue;
            step.apply(clusters.position[slot], clusters.velocity[slot]);
            if (clusters.columns.withheld)
                clusters.withheld[slot] += step.decay_minus_1 * clusters.withheld[slot];
            if (clusters.columns.map)
                propagate(clusters.map[slot], step);
        }
    });
}

bool all_finite(const ClusterTable& clusters)
{
    std::atomic<bool> finite{true};
    for_each_block(clusters.slot_count(), block, [&](std::size_t first, std::size_t last) {
        bool of_block = true;
        for (std::size_t slot = first; slot < last; ++slot)
            of_block = of_block && (!clusters.alive(slot) || clusters.position[slot].allFinite());
        if (!of_block)
            finite = false;
    });
    return finite;
}

} // namespace slod
