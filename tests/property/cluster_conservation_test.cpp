#include <algorithm>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "cluster/conserved.hpp"
#include "support/clouds.hpp"
#include "support/little_worlds.hpp"
#include "support/totals.hpp"

namespace slod {
namespace {

constexpr int cycles = 10'000;
constexpr std::size_t particle_count = 96;
constexpr double float_rounding = 0x1p-24;
constexpr double double_rounding = 0x1p-53;

/// Particles in a spring's field, a = -x, with tides to match; random kicks and drifts of it.
struct Stir {
    double kick, drift;
};

void apply(const Stir& stir, Vector3d& x, Vector3d& v)
{
    v -= stir.kick * x;
    x += stir.drift * v;
    v -= stir.kick * x;
}

/// Divides the particles at random into clusters of 1 to 24 and ends all those there were.
void regroup(ClusterStore& store, ParticleSet& particles, Random& random, std::uint64_t frame)
{
    for (std::uint32_t slot = 0; slot < store.clusters.slot_count(); ++slot) {
        if (!store.clusters.alive(slot))
            continue;
        store.members.retire(store.clusters.slab[slot], frame);
        store.clusters.free_slot({slot});
    }
    store.members.recycle(frame + 1);
    for (std::size_t i = particles.size(); i > 1; --i)
        std::swap(particles[i - 1], particles[random.bits() % i]);
    for (std::size_t first = 0; first < particles.size();) {
        const std::size_t count = std::min<std::size_t>(1 + random.bits() % 24, particles.size() - first);
        const auto begin = particles.begin() + std::ptrdiff_t(first);
        test::form(store, ParticleSet(begin, begin + std::ptrdiff_t(count)), frame);
        first += count;
    }
}

void evolve(ClusterStore& store, const Stir& stir)
{
    const Symmetric3 tide{-1, 0, 0, -1, 0, -1};
    ClusterTable& clusters = store.clusters;
    for (std::size_t slot = 0; slot < clusters.slot_count(); ++slot) {
        if (!clusters.alive(slot))
            continue;
        apply(stir, clusters.position[slot], clusters.velocity[slot]);
        kick(clusters.map[slot], stir.kick, tide);
        propagate(clusters.map[slot], {0, stir.drift, {0, 0, 0}, {0, 0, 0}});
        kick(clusters.map[slot], stir.kick, tide);
    }
}

/// Sum of m (|x|^2 + |v|^2) / 2: what the spring turns over between its two parts.
double oscillation(const ParticleSet& particles)
{
    double sum = 0;
    for (const Particle& particle : particles)
        sum +=
            0.5 * double(particle.mass) * (particle.position.squaredNorm() + particle.velocity.squaredNorm());
    return sum;
}

/// What an error of `rounding` per member and cycle, of either sign, amounts to after all cycles: a random
/// walk in each of the six components of each particle. In sum m dv v, and likewise in sum m x dv, that is
/// sqrt(cycles) rounding sqrt(sum m^2 v^2), below sqrt(cycles / count) of the sum; a factor of 4 for luck.
/// A drift of one sign would be sqrt(cycles) = 100 times as much.
double random_walk(double rounding)
{
    return 4 * rounding * std::sqrt(double(cycles) / particle_count);
}

// The spring is linear, so every particle's path is known by itself, and clusters follow it but for
// rounding: the member's, when formed, by up to half a bit of its offset, and the map's, four times in
// float, of offsets that are as wide as the whole ball. Together some 3 roundings of the particle's motion.
TEST(ClusterConservation, TenThousandRegroupingsDoNotDrift)
{
    const MapRule rule{MapKind::Full, 0, 0.1};
    ClusterStore store = test::empty_store(rule);
    Random random(1, 6, 0);
    ParticleSet particles = test::ball(particle_count, 1, 1, 1);
    test::give_masses(particles, 0.5, 2, 1);
    ParticleSet alone = particles;
    for (std::uint64_t cycle = 0; cycle < cycles; ++cycle) {
        regroup(store, particles, random, cycle);
        const Stir stir{0.05 * random.uniform(), 0.1 * random.uniform()};
        evolve(store, stir);
        particles = test::members(store, cycle);
        for (Particle& particle : alone)
            apply(stir, particle.position, particle.velocity);
    }
    const ConservedQuantities found = test::totals(particles), expected = test::totals(alone);
    const double turnover = oscillation(alone);
    EXPECT_EQ(found.mass, expected.mass);
    // Momentum is rounded in double alone: the stored offsets' own mean is taken off. Each cycle sums 96.
    EXPECT_LE((found.momentum - expected.momentum).norm(), random_walk(10 * double_rounding) *
                                                               std::sqrt(2 * turnover * expected.mass) *
                                                               std::sqrt(particle_count));
    EXPECT_NEAR(found.kinetic_energy, expected.kinetic_energy,
                random_walk(3 * float_rounding) * 2 * turnover);
    EXPECT_NEAR(oscillation(particles), turnover, random_walk(3 * float_rounding) * 2 * turnover);
    EXPECT_LE((found.angular_momentum - expected.angular_momentum).norm(),
              random_walk(3 * float_rounding) * 2 * turnover);
    for (std::size_t i = 0; i < particle_count; ++i) {
        const double tolerance = 4 * 3 * float_rounding * std::sqrt(double(cycles)) * 2;
        EXPECT_LE((particles[i].position - alone[i].position).norm(), tolerance);
        EXPECT_LE((particles[i].velocity - alone[i].velocity).norm(), tolerance);
    }
}

// What clusters know of themselves, in every state on the way.
TEST(ClusterConservation, ClustersKnowTheTotalsOfTheirMembersAfterEveryRegrouping)
{
    const MapRule rule{MapKind::Full, 0, 0.1};
    ClusterStore store = test::empty_store(rule);
    Random random(2, 6, 0);
    ParticleSet particles = test::ball(particle_count, 1, 1, 2, {3, -4, 5});
    test::give_masses(particles, 0, 2, 2);
    for (std::uint64_t cycle = 0; cycle < 300; ++cycle) {
        const ConservedQuantities before = test::totals(particles);
        regroup(store, particles, random, cycle);
        const ConservedQuantities after = conserved_quantities(store, cycle);
        const test::InternalMotion internal = test::internal_motion(particles);
        ASSERT_NEAR(after.mass, before.mass, 1e-12 * before.mass);
        ASSERT_LE((after.momentum - before.momentum).norm(), 1e-12 * before.mass);
        ASSERT_NEAR(after.kinetic_energy, before.kinetic_energy, 1e-7 * internal.kinetic_energy);
        ASSERT_LE((after.angular_momentum - before.angular_momentum).norm(),
                  1e-7 * internal.angular_momentum);
        evolve(store, {0.05 * random.uniform(), 0.1 * random.uniform()});
        particles = test::members(store, cycle);
        const ConservedQuantities now = test::totals(particles), known = conserved_quantities(store, cycle);
        ASSERT_NEAR(known.kinetic_energy, now.kinetic_energy, 1e-12 * now.kinetic_energy);
        ASSERT_LE((known.momentum - now.momentum).norm(), 1e-12 * now.mass * 10);
    }
}

} // namespace
} // namespace slod
