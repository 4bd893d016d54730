#include "support/merging_pairs.hpp"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "support/little_worlds.hpp"
#include "support/random_draws.hpp"
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

} // namespace slod::test
