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

/// Moves what are centres alone, without a branch in the loop: as fast as a loop over particles. Whether all
/// are in range then; their squares together say so of almost all blocks.
bool propagate_centres(std::span<Vector3d> positions, std::span<Vector3d> velocities, const Propagator& step,
                       double range)
{
    Vector3d squares = Vector3d::Zero();
    for (std::size_t i = 0; i < positions.size(); ++i) {
        step.apply(positions[i], velocities[i]);
        squares += positions[i].cwiseAbs2();
    }
    return squares.sum() <= range * range ||
           std::all_of(positions.begin(), positions.end(),
                       [&](const Vector3d& x) { return in_range(x, range); });
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
        if (centres_only)
            return propagate_centres(std::span(clusters.position).subspan(first, last - first),
                                     std::span(clusters.velocity).subspan(first, last - first), step, range);
        bool sound = true;
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
