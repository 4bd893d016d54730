#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/settings.hpp"
#include "tree/slod_tree.hpp"

namespace slod {

/// Components of velocities in scene units, at most; of places, too, where nothing else bounds them. It is
/// as much as a scene may set, and leaves offsets of members and their squares within float and double.
inline constexpr double largest_number = 1e30;

/// How far from the origin particles may be, by component: what is beyond, or no number, is taken out of the
/// scene. Under self-gravity in float 1e22 softening lengths, or kernels could not hold both what is near and
/// what is far.
double scene_range(const SimulationSettings& settings);

/// Particles that were taken out, as fields or too long a step have thrown them out of the range of numbers.
struct Quarantined {
    static constexpr std::size_t most_named = 8;

    std::uint64_t particles = 0;
    double mass = 0;                                   ///< scene mass
    std::array<std::uint64_t, most_named> first_ids{}; ///< those that there are: ids()

    std::span<const std::uint64_t> ids() const ///< of the first of them
    {
        return std::span(first_ids).first(std::size_t(std::min<std::uint64_t>(particles, most_named)));
    }

    Quarantined& operator+=(const Quarantined& other);
};

/// Whether all components are numbers, and none is larger.
inline bool in_range(const Vector3d& vector, double largest)
{
    return (vector.array().abs() <= largest).all();
}

inline bool is_finite(const FlowMap& map)
{
    return std::isfinite(map.a_minus_1.sum() + map.b.sum() + map.c.sum() + map.d_minus_1.sum());
}

/// Whether the cluster's place, velocity and map are numbers in range.
bool is_sound(const ClusterTable& clusters, std::size_t slot, double range);

/// Ends the clusters that are not, with their members: those of any one cluster have the centre in common, so
/// none of them is known any more. `context.frame` is that at whose end the members were last counted;
/// `unsound` is memory for a list of clusters.
Quarantined quarantine(SlodTree& tree, const UpdateContext& context, double range,
                       std::vector<ClusterSlot>& unsound);

} // namespace slod
