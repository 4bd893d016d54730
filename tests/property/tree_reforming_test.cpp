#include <algorithm>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "gravity/force_view.hpp"
#include "support/clouds.hpp"
#include "support/little_worlds.hpp"
#include "tree/reforming.hpp"

namespace slod {
namespace {

constexpr double step = 0.02;
constexpr double float_rounding = 0x1p-24;
constexpr RegionSettings region{.max_cluster_size = 16, .pool_factor = 4};

/// A field that acts on all: its acceleration and tide by position.
struct Field {
    Vector3d (*acceleration)(const Vector3d&);
    Symmetric3 (*tide)(const Vector3d&);
};

const Field nothing{[](const Vector3d&) { return Vector3d(0, 0, 0); },
                    [](const Vector3d&) { return Symmetric3{}; }};

/// Linear, so clusters follow it exactly: |T| = sqrt 3, every particle turns in 2 pi.
const Field spring{[](const Vector3d& x) { return Vector3d(-x); },
                   [](const Vector3d&) { return Symmetric3{-1, 0, 0, -1, 0, -1}; }};

/// A Plummer sphere of mass 10: tides from 10 sqrt 3 in the centre to nothing outside.
const Field sphere{[](const Vector3d& x) { return Vector3d(-10 * x / std::pow(1 + x.squaredNorm(), 1.5)); },
                   [](const Vector3d& x) {
                       const double square = 1 + x.squaredNorm();
                       const Matrix3d stretch = 30 * std::pow(square, -2.5) * x * x.transpose();
                       return Symmetric3::of(stretch - 10 * std::pow(square, -1.5) * Matrix3d::Identity());
                   }};

/// A world that is stepped as the simulation steps its own: kick, drift, update, forces, kick.
class Moving {
public:
    Moving(const ParticleSet& particles, const Field& field, const MotionSettings& motion = {})
        : world({MapKind::Full, 0, step}, {}, region, 4), reforming(motion, world.context(0)), field_(field)
    {
        reforming.found(world.tree, particles, 0);
        evaluate();
        reforming.reform_all(world.tree, 0, counts);
        evaluate();
    }

    void advance()
    {
        ++frame;
        kick_all();
        for (std::size_t slot = 0; slot < clusters().slot_count(); ++slot) {
            if (!clusters().alive(slot))
                continue;
            clusters().position[slot] += step * clusters().velocity[slot];
            propagate(clusters().map[slot], {0, step, {0, 0, 0}, {0, 0, 0}});
        }
        world.store.members.recycle(frame);
        reforming.update(world.tree, frame, counts);
        evaluate();
        kick_all();
    }

    ClusterTable& clusters() { return world.store.clusters; }

    test::World world;
    Reforming reforming;
    UpdateCounts counts;
    std::uint64_t frame = 0;

private:
    void evaluate()
    {
        measure_shapes(world.store, {.closure = false}, 1, frame);
        for (std::size_t slot = 0; slot < clusters().slot_count(); ++slot) {
            if (!clusters().alive(slot))
                continue;
            clusters().acceleration[slot] = field_.acceleration(clusters().position[slot]);
            clusters().tide[slot] = field_.tide(clusters().position[slot]);
        }
    }

    void kick_all()
    {
        for (std::size_t slot = 0; slot < clusters().slot_count(); ++slot) {
            if (!clusters().alive(slot))
                continue;
            clusters().velocity[slot] += 0.5 * step * clusters().acceleration[slot];
            kick(clusters().map[slot], 0.5 * step, clusters().tide[slot]);
        }
    }

    Field field_;
};

/// The same steps for a particle by itself.
void advance(ParticleSet& particles, const Field& field)
{
    for (Particle& particle : particles) {
        particle.velocity += 0.5 * step * field.acceleration(particle.position);
        particle.position += step * particle.velocity;
        particle.velocity += 0.5 * step * field.acceleration(particle.position);
    }
}

/// Everything that holds after every update, whatever the field.
void expect_sound(Moving& moving, std::size_t particle_count)
{
    const ClusterTable& clusters = moving.clusters();
    ASSERT_EQ(problems(moving.world.tree, clusters), Problems{});
    const ParticleSet all = test::members(moving.world.store, moving.frame);
    ASSERT_EQ(all.size(), particle_count);
    for (std::size_t i = 0; i < all.size(); ++i)
        ASSERT_EQ(all[i].id, i + 1) << "every particle is in exactly one cluster";
    for (std::size_t slot = 0; slot < clusters.slot_count(); ++slot)
        ASSERT_LE(clusters.count[slot], region.max_cluster_size);
}

/// Pools live from `shortest` to one length and a bit, and hold only clusters formed in their own life.
void expect_lives_kept(Moving& moving, const MotionSettings& motion)
{
    const ClusterTable& clusters = moving.clusters();
    for (const Pool& pool : moving.world.region().pools) {
        if (!pool.node.valid() || pool.turn_frame == Pool::no_turn)
            continue;
        ASSERT_GT(pool.due_frame, moving.frame);
        ASSERT_LE(pool.turn_frame, moving.frame);
        ASSERT_GE(pool.life(), motion.shortest_life);
        ASSERT_LT(pool.life(), motion.longest_life + motion.shortest_life);
        for (ClusterSlot slot = pool.first; slot.valid(); slot = clusters.next[slot.index])
            ASSERT_GE(clusters.formed_frame[slot.index], pool.turn_frame);
    }
}

TEST(Reforming, KeepsTreeParticlesSizesAndLivesInOrderInAnyField)
{
    const MotionSettings motion;
    for (const Field& field : {nothing, spring, sphere}) {
        for (std::uint64_t seed = 0; seed < 4; ++seed) {
            SCOPED_TRACE(seed);
            const ParticleSet particles = test::ball(1000, 3, 2, seed);
            Moving moving(particles, field, motion);
            for (int frame = 0; frame < 150; ++frame) {
                ASSERT_NO_FATAL_FAILURE(expect_sound(moving, particles.size())) << "frame " << frame;
                ASSERT_NO_FATAL_FAILURE(expect_lives_kept(moving, motion)) << "frame " << frame;
                moving.advance();
            }
            EXPECT_GT(moving.counts.reformed_members, particles.size());
        }
    }
}

// As a close passage wears it, of which the pool's clock knew nothing when the life began.
TEST(Reforming, EndsALifeEarlyWhereAMapIsWorn)
{
    Moving moving(test::ball(1000, 3, 2, 1), nothing);
    const auto pool_of = [&](std::size_t slot) -> const Pool& {
        return moving.world.tree.pool({moving.clusters().region[slot], moving.clusters().pool[slot]});
    };
    const auto lives_on = [&](std::size_t slot) {
        return moving.clusters().alive(slot) && pool_of(slot).due_frame > moving.frame + 1;
    };
    for (int frame = 0; frame < 8; ++frame)
        moving.advance();
    ASSERT_EQ(moving.counts.worn_pools, 0U);
    std::size_t slot = 0;
    while (!lives_on(slot))
        ++slot;
    const Pool& pool = pool_of(slot);
    moving.clusters().map[slot].a_minus_1(0, 0) = 9;
    moving.advance();
    EXPECT_EQ(moving.counts.worn_pools, 1U);
    EXPECT_EQ(pool.turn_frame, moving.frame);
    expect_sound(moving, 1000);
}

// In linear fields a cluster's map is exact, so members only ever move by the rounding of their offsets:
// once when formed and four times a frame in the map, of offsets and paths of up to 10. After 200 frames
// that is a random walk of 800 steps, with a factor of 5 for the largest of 3000 components.
TEST(Reforming, MembersMoveInLinearFieldsAsEachWouldByItself)
{
    for (const Field& field : {nothing, spring}) {
        ParticleSet particles = test::ball(1000, 3, 2, 1);
        Moving moving(particles, field);
        for (int frame = 0; frame < 200; ++frame) {
            moving.advance();
            advance(particles, field);
        }
        const ParticleSet found = test::members(moving.world.store, moving.frame);
        for (std::size_t i = 0; i < particles.size(); ++i) {
            const double tolerance = 5 * std::sqrt(800.0) * 10 * float_rounding;
            ASSERT_LE((found[i].position - particles[i].position).norm(), tolerance) << "particle " << i + 1;
            ASSERT_LE((found[i].velocity - particles[i].velocity).norm(), tolerance) << "particle " << i + 1;
        }
    }
}

// |T| = sqrt 3 everywhere: the life is 2^round(log2(clock / (step 3^(1/4)))).
TEST(Reforming, PoolsLiveAsLongAsTheDynamicalClockSays)
{
    struct Case {
        double clock;
        std::uint64_t life;
    };
    // clock / (step 1.316): 7.6; 10.6 and 12.2 on either side of 8 sqrt 2; 0.4 and 380 beyond the limits
    for (const Case& expected : {Case{0.2, 8}, Case{0.28, 8}, Case{0.32, 16}, Case{0.01, 2}, Case{10, 64}}) {
        const MotionSettings motion{.clock = expected.clock};
        Moving moving(test::ball(1000, 3, 2, 1), spring, motion);
        for (int frame = 0; frame < 130; ++frame)
            moving.advance();
        std::uint64_t longest = 0; // a first life is shorter, or longer by less than the shortest
        for (const Pool& pool : moving.world.region().pools)
            if (pool.node.valid() && pool.members > 0)
                longest = std::max(longest, pool.life());
        EXPECT_GE(longest, expected.life) << "clock " << expected.clock;
        EXPECT_LT(longest, expected.life + 2) << "clock " << expected.clock;
    }
}

TEST(Reforming, LivesAreShortWhereTidesAreStrong)
{
    Moving moving(test::ball(3000, 6, 1, 1), sphere, {.clock = 0.4});
    for (int frame = 0; frame < 100; ++frame)
        moving.advance();
    double inner = 0, outer = 0, inner_count = 0, outer_count = 0;
    for (const Pool& pool : moving.world.region().pools) {
        if (!pool.node.valid() || pool.members == 0)
            continue;
        const double distance = moving.clusters().position[pool.first.index].norm();
        (distance < 1 ? inner : outer) += double(pool.life());
        (distance < 1 ? inner_count : outer_count) += 1;
    }
    EXPECT_LT(2 * inner / inner_count, outer / outer_count);
}

/// Whether the particle passes the region within half of a longest life, or a rounding beside it.
bool passes(const SlodTree& tree, const Particle& particle, RegionRow row)
{
    constexpr double near = 1e-5; // offsets of some 4 lengths and a life of 64 steps, in float
    for (int life = 0; life <= 128; ++life) {
        const Vector3d place = particle.position + 0.5 * step * life * particle.velocity;
        for (int corner = 0; corner < 8; ++corner) {
            const Vector3d shift(corner & 1 ? near : -near, corner & 2 ? near : -near,
                                 corner & 4 ? near : -near);
            if (tree.region_at(Vector3d(place + shift)) == row)
                return true;
        }
    }
    return false;
}

/// Each member of a pool that began its life in this frame is in a region where it will be in the middle of
/// some life: of that of the pool it came from. Returns how many will stay in one region.
std::size_t expect_where_they_will_be(Moving& moving)
{
    std::size_t staying = 0;
    const SlodTree& tree = moving.world.tree;
    const ClusterTable& clusters = moving.clusters();
    for (std::uint32_t slot = 0; slot < clusters.slot_count(); ++slot) {
        const PoolRef ref{clusters.region[slot], clusters.pool[slot]};
        if (!clusters.alive(slot) || tree.pool(ref).turn_frame != moving.frame)
            continue;
        for (const Particle& member : test::members(moving.world.store, {slot}, moving.frame)) {
            EXPECT_TRUE(passes(tree, member, ref.region)) << member.position.transpose();
            const Vector3d latest = member.position + 64 * step * member.velocity;
            staying += tree.region_at(member.position) == ref.region && tree.region_at(latest) == ref.region;
        }
    }
    return staying;
}

TEST(Reforming, SendsEveryMemberToARegionWhereItWillBeMidwayThroughALife)
{
    Moving moving(test::ball(2000, 3, 0.5, 5), nothing);
    SlodTree& tree = moving.world.tree;
    RegionOfInterest core;
    core.shape = Shape::Sphere;
    core.radius = 1.5;
    core.partition = {.max_cluster_size = 4, .pool_factor = 4};
    RegionOfInterest half = core;
    half.shape = Shape::Box;
    half.centre = {2, 0, 0};
    half.half_extent = {2, 4, 4};
    half.precedence = -1; // the core bites into it
    const RegionRow first = open_region(tree, core);
    const RegionRow second = open_region(tree, half);
    settle(tree);
    moving.advance();
    EXPECT_GT(expect_where_they_will_be(moving), 1000U);
    EXPECT_GT(tree.subtrees[first].pool_count(), 0U);
    EXPECT_GT(tree.subtrees[second].pool_count(), 0U);
    for (int frame = 0; frame < 80; ++frame) {
        moving.advance();
        expect_where_they_will_be(moving);
        expect_sound(moving, 2000);
    }
    close_region(tree, first);
    settle(tree);
    moving.advance();
    expect_sound(moving, 2000);
    EXPECT_GT(expect_where_they_will_be(moving), 100U);
    EXPECT_EQ(tree.subtrees[first].pool_count(), 0U);
}

TEST(Reforming, CountsWhatItDoes)
{
    Moving moving(test::ball(1000, 3, 2, 1), sphere);
    for (int frame = 0; frame < 60; ++frame) {
        moving.counts = {};
        std::uint64_t due = 0, members = 0;
        for (const Pool& pool : moving.world.region().pools)
            if (pool.node.valid() && pool.due_frame == moving.frame + 1) {
                ++due;
                members += pool.members;
            }
        moving.advance();
        EXPECT_LE(moving.counts.due_pools, due);            // sparse ones are merged first,
        EXPECT_GE(moving.counts.reformed_members, members); // with siblings that were not yet due
        EXPECT_LE(moving.counts.strays_inserted + moving.counts.strays_founding,
                  moving.counts.reformed_members);
    }
}

// No plane divides them: they are divided by their number alone, and trees stop at a limit of depth.
TEST(Reforming, CoincidentParticlesAreGroupedAnyhow)
{
    for (const double place : {0.0, 1.0, -3.7, 1e12}) {
        ParticleSet particles = test::ball(500, 0, 0, 1, {place, place, place});
        Moving moving(particles, nothing);
        for (int frame = 0; frame < 140; ++frame)
            moving.advance();
        ASSERT_NO_FATAL_FAILURE(expect_sound(moving, particles.size())) << "at " << place;
        for (const Particle& particle : test::members(moving.world.store, moving.frame))
            ASSERT_EQ(particle.position, particles.front().position) << "at " << place;
    }
}

TEST(Reforming, ParticlesFarOutsideAreNothingSpecial)
{
    ParticleSet particles = test::ball(500, 3, 2, 1);
    for (std::size_t i = 0; i < 20; ++i)
        particles[i].position *= std::pow(10.0, double(i));
    Moving moving(particles, sphere);
    for (int frame = 0; frame < 100; ++frame) {
        moving.advance();
        ASSERT_NO_FATAL_FAILURE(expect_sound(moving, particles.size())) << "frame " << frame;
    }
}

TEST(Reforming, AFewParticlesOrNoneAreFine)
{
    for (const std::size_t count : {0U, 1U, 2U, 17U}) {
        Moving moving(test::ball(count, 3, 2, 1), sphere);
        for (int frame = 0; frame < 100; ++frame)
            moving.advance();
        ASSERT_NO_FATAL_FAILURE(expect_sound(moving, count));
    }
}

} // namespace
} // namespace slod
