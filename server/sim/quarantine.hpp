#pragma once

#include <cmath>
#include <cstdint>
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
    double mass = 0;                ///< scene mass
    std::vector<std::uint64_t> ids; ///< of the first of them, most_named at most

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
/// none of them is known any more. Nobody else has seen them, so nobody else is changed by a bit.
/// `context.frame` is that at whose end the members were last counted.
Quarantined quarantine(SlodTree& tree, const UpdateContext& context, double range);

} // namespace slod
