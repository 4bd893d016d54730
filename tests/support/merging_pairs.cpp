#include "support/merging_pairs.hpp"

#include <cmath>
#include <numbers>
#include <tuple>

#include <Eigen/Geometry>

#include "core/portable_math.hpp"
#include "support/little_worlds.hpp"
#include "support/random_draws.hpp"
#include "tree/gathering.hpp"
#include "tree/regrouping.hpp"

namespace slod::test {
namespace {

Particle particle_of(double mass, const Vector3d& x, const Vector3d& v, std::uint64_t id)
{
    Particle particle;
    particle.position = x;
    particle.velocity = v;
    particle.mass = float(mass);
    particle.id = id;
    return particle;
}

} // namespace

std::vector<MergingPair> random_pairs(std::size_t count, std::uint64_t seed)
{
    std::vector<MergingPair> pairs(count);
    for (std::size_t i = 0; i < count; ++i) {
        Random random(seed, 5, i);
        MergingPair& pair = pairs[i];
        pair.other_mass = double(float(std::pow(10.0, 2 * random.uniform() - 1)));
        const Vector3d ahead = random_direction(random);
        const double angle = random.uniform() * 100 * std::numbers::pi / 180;
        const Vector3d turned =
            Eigen::AngleAxisd(angle, ahead.cross(random_direction(random)).normalized()) * ahead;
        pair.velocity = (0.5 + 1.5 * random.uniform()) * ahead;
        pair.other_velocity = (0.5 + 1.5 * random.uniform()) * turned;
    }
    return pairs;
}

void merge_pairs(std::vector<MergingPair>& pairs, const RegionSettings& limits)
{
    RegionSettings region = limits;
    region.velocity_reference = VelocityReference::Rest;
    World world({MapKind::Identity, 0, 1}, {}, region, 1);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const Vector3d middle(double(i) + 0.5, 0.5, 0.5); // of a cell of its own
        world.add({particle_of(pairs[i].mass, middle, pairs[i].velocity, 2 * i)});
        world.add({particle_of(pairs[i].other_mass, middle, pairs[i].other_velocity, 2 * i + 1)});
    }
    world.tree.merging = true;
    Regrouping regrouping({}, world.context(0));
    for (std::uint64_t frame = 1; frame <= 16; ++frame) {
        UpdateCounts counts;
        regrouping.update(world.tree, frame, counts);
    }
    const ClusterTable& clusters = world.store.clusters;
    for (std::size_t slot = 0; slot < clusters.slot_count(); ++slot) {
        if (clusters.count[slot] != 2)
            continue;
        MergingPair& pair = pairs.at(std::size_t(clusters.position[slot].x()));
        pair.merged = true;
        pair.merged_velocity = clusters.velocity[slot];
    }
}

bool may_merge(ClusterStore& store, const RegionSettings& region, ClusterSlot a, ClusterSlot b,
               const Vector3d& reference)
{
    ClusterTable& clusters = store.clusters;
    const auto links = [&](ClusterSlot slot) {
        return std::tie(clusters.pool[slot.index], clusters.region[slot.index], clusters.next[slot.index],
                        clusters.previous[slot.index]);
    };
    using Links = std::tuple<PoolId, std::uint16_t, ClusterSlot, ClusterSlot>;
    const Links kept_a = links(a), kept_b = links(b);
    SlodTree tree(region, 1e9);
    const PoolRef pool = locate_or_grow(tree, subject_of(clusters, a.index));
    for (const ClusterSlot slot : {b, a}) // the last one is first
        link(tree.of(pool), clusters, pool.pool, slot);
    Gathering gathering;
    gathering.find(tree, store, 0, std::span(&reference, 1));
    links(a) = kept_a;
    links(b) = kept_b;
    return gathering.groups.size() == 1;
}

double velocity_change_bound(const RegionSettings& region, double speed, double mass, double other_mass)
{
    const double ratio = region.speed_ratio;
    const double cosine = portable_sincos(region.angle_deg * std::numbers::pi / 180).cosine;
    const double farthest = speed * std::sqrt(1 + ratio * ratio - 2 * ratio * cosine);
    // Below the floor any two velocities may merge.
    return other_mass / (mass + other_mass) * std::max(farthest, 2 * region.speed_floor);
}

} // namespace slod::test
