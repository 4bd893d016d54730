#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"
#include "gravity/force_view.hpp"

namespace slod {
namespace {

constexpr std::size_t block = 512;

} // namespace

void measure_shapes(ClusterStore& store, const GravitySettings& gravity, double gravitational_constant,
                    std::uint64_t frame)
{
    ClusterTable& clusters = store.clusters;
    for_each_block(clusters.slot_count(), block, [&](std::size_t first, std::size_t last) {
        for (std::size_t slot = first; slot < last; ++slot) {
            if (clusters.count[slot] < 2) {
                clusters.variance[slot] = 0;
                if (clusters.columns.map)
                    clusters.closure[slot] = 0;
                continue;
            }
            const double mass = clusters.mass(slot);
            const Moments& moments = mass > 0 ? clusters.moments[slot] : clusters.counting_moments(slot);
            const Symmetric3 extent = map_position_moments(moments, clusters.blocks(slot, store.rule, frame));
            const double variance = std::max(extent.trace() / moments.weight, 0.0);
            clusters.variance[slot] = variance;
            if (!clusters.columns.map)
                continue;
            if (!gravity.closure) {
                clusters.closure[slot] = 0;
                continue;
            }
            // A homogeneous ball with this variance; n / (n - 1) as the sample's variance is biased.
            const double n = clusters.count[slot];
            const double radius_squared =
                5.0 / 3.0 * variance * n / (n - 1) + double(clusters.softening_squared[slot]);
            clusters.closure[slot] = radius_squared > 0 ? gravitational_constant * mass /
                                                              (radius_squared * std::sqrt(radius_squared))
                                                        : 0;
        }
    });
}

} // namespace slod
