#include "sim/integrator.hpp"

#include <algorithm>
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

bool all_finite(const ClusterTable& clusters, std::uint64_t turn, std::uint64_t turns)
{
    std::atomic<bool> finite{true};
    const std::size_t blocks = block_count(clusters.slot_count(), block);
    const std::size_t first_block = turn % turns;
    const std::size_t in_turn = first_block < blocks ? (blocks - first_block - 1) / turns + 1 : 0;
    for_each_task(in_turn, [&](std::size_t i) {
        const std::size_t first = (first_block + i * turns) * block;
        for (std::size_t slot = first; slot < std::min(first + block, clusters.slot_count()); ++slot)
            if (clusters.alive(slot) && !clusters.position[slot].allFinite())
                finite = false;
    });
    return finite;
}

} // namespace slod
