#include "sim/integrator.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <span>

#include "core/parallel.hpp"
#include "sim/quarantine.hpp"

namespace slod {
namespace {

constexpr std::size_t block = 1024;

/// da/dx as members feel it, their own attraction included. Needs columns.tide and columns.map.
Matrix3d felt_gradient(const ClusterTable& clusters, std::size_t slot)
{
    Matrix3d gradient = clusters.gradient(slot);
    gradient.diagonal().array() -= clusters.closure[slot];
    return gradient;
}

/// Whether all components of all of them are numbers, and none is larger. Their squares together say it of
/// almost all blocks, in one pass without a branch.
bool all_in_range(std::span<const Vector3d> vectors, double largest)
{
    const Eigen::Map<const Eigen::VectorXd> components(vectors.data()->data(),
                                                       3 * std::ptrdiff_t(vectors.size()));
    return components.squaredNorm() <= largest * largest ||
           std::all_of(vectors.begin(), vectors.end(),
                       [&](const Vector3d& x) { return in_range(x, largest); });
}

} // namespace

void kick_cluster(ClusterTable& clusters, std::size_t slot, double step)
{
    clusters.velocity[slot] += step * clusters.acceleration[slot];
    if (clusters.columns.map)
        kick(clusters.map[slot], step, felt_gradient(clusters, slot));
}

bool kick_clusters(ClusterTable& clusters, double step)
{
    return holds_in_blocks(clusters.slot_count(), block, [&](std::size_t first, std::size_t last) {
        bool sound = true;
        for (std::size_t slot = first; slot < last; ++slot) {
            if (!clusters.alive(slot))
                continue;
            kick_cluster(clusters, slot, step);
            sound &= in_range(clusters.velocity[slot], largest_number) &&
                     (!clusters.columns.map || is_finite(clusters.map[slot]));
        }
        return sound;
    });
}

bool propagate_clusters(ClusterTable& clusters, const Propagator& step, double range)
{
    const bool centres_only =
        clusters.free_slots.empty() && !clusters.columns.withheld && !clusters.columns.map;
    return holds_in_blocks(clusters.slot_count(), block, [&](std::size_t first, std::size_t last) {
        bool sound = true;
        if (centres_only) { // without a branch in the loop, as fast as a loop over particles
            for (std::size_t slot = first; slot < last; ++slot)
                step.apply(clusters.position[slot], clusters.velocity[slot]);
            return all_in_range(std::span(clusters.position).subspan(first, last - first), range);
        }
        for (std::size_t slot = first; slot < last; ++slot) {
            if (!clusters.alive(slot))
                continue;
            step.apply(clusters.position[slot], clusters.velocity[slot]);
            if (clusters.columns.withheld)
                clusters.withheld[slot] += step.decay_minus_1 * clusters.withheld[slot];
            if (clusters.columns.map)
                propagate(clusters.map[slot], step);
            sound &= is_sound(clusters, slot, range);
        }
        return sound;
    });
}

double largest_rate_squared(const ClusterTable& clusters)
{
    std::atomic<double> largest{0};
    for_each_block(clusters.slot_count(), block, [&](std::size_t first, std::size_t last) {
        double most = 0;
        for (std::size_t slot = first; slot < last; ++slot) {
            if (clusters.alive(slot))
                most = std::max(
                    most,
                    (clusters.columns.map ? felt_gradient(clusters, slot) : clusters.gradient(slot)).norm());
        }
        for (double known = largest; known < most && !largest.compare_exchange_weak(known, most);)
            ;
    });
    return largest;
}

bool all_sound(const ClusterTable& clusters, double range)
{
    return holds_in_blocks(clusters.slot_count(), block, [&](std::size_t first, std::size_t last) {
        bool sound = true;
        for (std::size_t slot = first; slot < last; ++slot)
            sound = sound && (!clusters.alive(slot) || is_sound(clusters, slot, range));
        return sound;
    });
}

} // namespace slod
