#include <limits>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "effects/emission.hpp"
#include "support/case_rows.hpp"
#include "support/little_worlds.hpp"
#include "support/newborns.hpp"

namespace slod {
namespace {

constexpr double step = 0.02;
constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

/// Emitters in uniform fields, whose clusters the scalar map follows exactly.
class Fountain {
public:
    Fountain(const std::vector<EmitterSettings>& settings, const UniformFields& uniform_fields = {})
        : world({MapKind::Scalar, uniform_fields.drag, step},
                {.masses = false, .kinds = false, .expiry = true}, {.max_cluster_size = 64}, 4),
          fields(uniform_fields), emission(emitters_of(settings), fields, 1.0)
    {
        world.store.kind_softening_squared = {0};
    }

    void advance()
    {
        ++frame;
        ClusterTable& clusters = world.store.clusters;
        const Propagator propagator = fields.over(step);
        for (std::size_t slot = 0; slot < clusters.slot_count(); ++slot)
            if (clusters.alive(slot))
                propagator.apply(clusters.position[slot], clusters.velocity[slot]);
        const std::uint64_t room = most > born ? most - born : 0;
        const Emission::Births births = emission.update(world.tree, world.context(frame), 0, room);
        born += births.born;
        refused += births.refused;
    }

    static std::vector<Emitter> emitters_of(const std::vector<EmitterSettings>& settings)
    {
        std::vector<Emitter> emitters;
        for (const EmitterSettings& emitter : settings)
            emitters.emplace_back(emitter, std::uint32_t(emitters.size()), std::uint8_t{0}, 7);
        return emitters;
    }

    test::World world;
    UniformFields fields;
    Emission emission;
    std::uint64_t frame = 0;
    std::uint64_t born = 0, refused = 0;
    std::uint64_t most = unlimited; ///< particles
};

EmitterSettings jet(double per_frame)
{
    return {.name = "jet",
            .kind = "water",
            .position = {0.5, 0.5, 0.5},
            .direction = {0, 0, 1},
            .speed = 5,
            .speed_spread = 0.2,
            .cone_angle_deg = 20,
            .rate = per_frame / step};
}

TEST(Emission, CohortsFillUpToTheMaximumSizeOneAfterAnother)
{
    for (const double per_frame : {0.3, 5.0, 13.7, 63.0}) {
        Fountain fountain({jet(per_frame)});
        for (int frame = 0; frame < 300; ++frame)
            fountain.advance();
        const ClusterTable& clusters = fountain.world.store.clusters;
        EXPECT_NEAR(double(fountain.born), 300 * per_frame, 1);
        EXPECT_EQ(clusters.alive_count(), (fountain.born + 63) / 64);
        std::size_t open = 0;
        for (const std::uint32_t count : clusters.count)
            open += count < 64 ? 1 : 0;
        EXPECT_LE(open, 1U);
        EXPECT_EQ(problems(fountain.world.tree, clusters), Problems{});
    }
}

TEST(Emission, EveryParticleIsInExactlyOneCluster)
{
    Fountain fountain({jet(7), jet(0.9), jet(200)});
    for (int frame = 0; frame < 50; ++frame)
        fountain.advance();
    std::set<std::uint64_t> ids;
    for (const Particle& particle : test::members(fountain.world.store, fountain.frame))
        EXPECT_TRUE(ids.insert(particle.id).second);
    EXPECT_EQ(ids.size(), fountain.born);
    EXPECT_EQ(fountain.born, 350U + 45U + 10'000U);
    EXPECT_EQ(problems(fountain.world.tree, fountain.world.store.clusters), Problems{});
}

/// Those born in the first half of a frame, up to its middle, end within it.
EmitterSettings short_lived(double per_frame)
{
    EmitterSettings emitter = jet(per_frame);
    emitter.lifetime = 0.5 * step;
    return emitter;
}

// Emitters share blocks of 256 newborns, and those that end at once are left out of the middle.
TEST(Emission, EachEmittersNewbornsAreThoseThatItBearsByItself)
{
    const std::vector<EmitterSettings> jets{jet(300), jet(1), short_lived(301), jet(0), jet(500)};
    Fountain fountain(jets);
    fountain.advance();
    std::vector<Newborn> expected;
    for (const Emitter& emitter : Fountain::emitters_of(jets))
        test::add_newborns(emitter, fountain.frame, step, {}, expected);
    EXPECT_EQ(expected.size(), 300U + 1U + 150U + 500U);
    EXPECT_EQ(fountain.born, expected.size());
    std::map<std::uint64_t, Particle> found;
    for (const Particle& particle : test::members(fountain.world.store, fountain.frame))
        EXPECT_TRUE(found.emplace(particle.id, particle).second);
    ASSERT_EQ(found.size(), expected.size());
    for (const Newborn& newborn : expected) {
        const Particle& particle = found[newborn.particle.id];
        EXPECT_LE((particle.position - newborn.particle.position).norm(), 1e-6);
        EXPECT_LE((particle.velocity - newborn.particle.velocity).norm(), 1e-6);
    }
}

TEST(Emission, WhatEndsAtOnceTakesRoomFromLaterEmitters)
{
    Fountain fountain({short_lived(80), jet(80)});
    fountain.most = 100;
    fountain.advance();
    EXPECT_EQ(fountain.refused, 60U);
    EXPECT_EQ(fountain.born, 39U + 20U);
}

TEST(Emission, EmittersDoNotMixTheirParticles)
{
    Fountain fountain({jet(3), jet(5)});
    for (int frame = 0; frame < 50; ++frame)
        fountain.advance();
    for (std::uint32_t slot = 0; slot < fountain.world.store.clusters.slot_count(); ++slot) {
        std::set<std::uint64_t> emitters;
        for (const Particle& particle :
             test::members(fountain.world.store, ClusterSlot{slot}, fountain.frame))
            emitters.insert(particle.id >> Emitter::id_shift);
        EXPECT_EQ(emitters.size(), 1U);
    }
}

TEST(Emission, F31_AHundredThousandInAFrameAreDividedIntoFullClusters)
{
    Fountain fountain({jet(100'000)});
    fountain.advance();
    EXPECT_EQ(fountain.born, 100'000U);
    // No more than the ceiling of 1e5 / 64.
    test::expect_at_most("clusters of 64", double(fountain.world.store.clusters.alive_count()), 1563);
    for (const std::uint32_t count : fountain.world.store.clusters.count) {
        EXPECT_LE(count, 64U);
        EXPECT_GE(count, 63U);
    }
    EXPECT_EQ(problems(fountain.world.tree, fountain.world.store.clusters), Problems{});
}

// Offsets are rounded to float at forming or joining, and under drag their inverse map magnifies that by
// 16 at most: of velocities relative to the cohort's of some 5.
TEST(Emission, ParticlesFollowTheirOwnPathsHoweverLongTheirCohortStaysOpen)
{
    UniformFields fields;
    fields.gravity = {0, 0, -9.81};
    fields.drag = 3;
    fields.wind = {1, 0, 0};
    Fountain fountain({jet(0.3)}, fields); // a cohort would be open for 213 frames: exp(k t) = 3e5
    const Emitter emitter = Fountain::emitters_of({jet(0.3)}).front();
    std::map<std::uint64_t, Particle> expected;
    for (int frame = 0; frame < 300; ++frame) {
        fountain.advance();
        for (auto& [id, particle] : expected)
            fields.over(step).apply(particle.position, particle.velocity);
        std::vector<Newborn> born;
        test::add_newborns(emitter, fountain.frame, step, fields, born);
        for (const Newborn& newborn : born)
            expected[newborn.particle.id] = newborn.particle;
    }
    const ParticleSet found = test::members(fountain.world.store, fountain.frame);
    ASSERT_EQ(found.size(), expected.size());
    constexpr double tolerance = 16 * 10 * 0x1p-24;
    for (const Particle& particle : found) {
        EXPECT_LE((particle.position - expected[particle.id].position).norm(), tolerance);
        EXPECT_LE((particle.velocity - expected[particle.id].velocity).norm(), tolerance);
    }
}

TEST(Emission, NewClustersTellTheMeanAgeOfTheirMembers)
{
    Fountain fountain({jet(500), jet(0.7)});
    const std::vector<Emitter> emitters = Fountain::emitters_of({jet(500), jet(0.7)});
    std::size_t seen = 0;
    for (int frame = 0; frame < 5; ++frame) {
        fountain.advance();
        std::map<std::uint64_t, double> age;
        for (const Emitter& emitter : emitters) {
            std::vector<Newborn> born;
            test::add_newborns(emitter, fountain.frame, step, {}, born);
            for (const Newborn& newborn : born)
                age[newborn.particle.id] = newborn.age;
        }
        for (const Emission::NewCluster& cluster : fountain.emission.new_clusters()) {
            const std::size_t slot = cluster.id.slot.index;
            ASSERT_EQ(cluster.id, fountain.world.store.clusters.id(slot));
            const ParticleSet members = test::members(fountain.world.store, cluster.id.slot, fountain.frame);
            double mean = 0;
            for (const Particle& particle : members)
                mean += age.at(particle.id) / double(members.size());
            EXPECT_NEAR(cluster.age, mean, 1e-14);
            ++seen;
        }
    }
    EXPECT_EQ(seen, 5U * 8U + 1U);
}

// Between the two half kicks a newborn is there for its age alone.
TEST(Emission, AKickedNewbornThatJoinsGetsTheRestOfItsOwnTime)
{
    Fountain kicked({jet(5)}), free({jet(5)});
    for (Fountain* fountain : {&kicked, &free})
        fountain->advance();
    const Vector3d pull{3, -2, 5};
    kicked.world.store.clusters.acceleration[0] = pull;
    std::vector<Newborn> born;
    test::add_newborns(Fountain::emitters_of({jet(5)}).front(), 2, step, {}, born);
    kicked.emission.update(kicked.world.tree, kicked.world.context(2), 0.5 * kicked.world.context(2).step,
                           unlimited);
    free.emission.update(free.world.tree, free.world.context(2), 0, unlimited);
    const ParticleSet with = test::members(kicked.world.store, 2),
                      without = test::members(free.world.store, 2);
    ASSERT_EQ(with.size(), 10U);
    for (std::size_t i = 5; i < 10; ++i) {
        const Vector3d gained = with[i].velocity - without[i].velocity;
        EXPECT_LE((gained - (born[i - 5].age - step / 2) * pull).norm(), 10 * 0x1p-24);
    }
}

// The first particles of a frame find room, in the order of the emitters; numbers go on as if all had come.
TEST(Emission, N19_WhatThereIsNoRoomForIsRefusedAndCounted)
{
    Fountain bounded({jet(5), jet(3)}), free({jet(5), jet(3)});
    bounded.most = 20;
    for (int frame = 0; frame < 5; ++frame) {
        bounded.advance();
        free.advance();
    }
    test::expect_within("particles where there is room for 20", double(bounded.born), 20, 20);
    test::expect_within("refused", double(bounded.refused), double(free.born) - 20, double(free.born) - 20);
    const ParticleSet some = test::members(bounded.world.store, bounded.frame),
                      all = test::members(free.world.store, free.frame);
    ASSERT_EQ(some.size(), 20U);
    for (const Particle& particle : some) {
        const auto same = [&](const Particle& other) { return other.id == particle.id; };
        EXPECT_EQ(std::count_if(all.begin(), all.end(), same), 1) << particle.id;
    }
}

// Far more particles than memory holds are asked for in one frame.
TEST(Emission, N19_AnAbsurdRateTakesNoMoreMemoryThanThereIsRoomFor)
{
    Fountain flood({jet(1e12)});
    flood.most = 1000;
    flood.advance();
    test::expect_within("born of 1e12 asked for, where there is room for 1000", double(flood.born), 1000,
                        1000);
    // As a double the number of starts in a frame is right to 1e-4 of 1e12 at the least.
    test::expect_within("refused", double(flood.refused), 1e12 - 1e4, 1e12 + 1e4);
}

TEST(Emission, ACohortThatHasEndedIsNotJoined)
{
    Fountain fountain({jet(5)});
    fountain.advance();
    ClusterTable& clusters = fountain.world.store.clusters;
    unlink(fountain.world.region(), clusters, {0});
    fountain.world.store.members.retire(clusters.slab[0], 1);
    clusters.free_slot({0});
    fountain.world.add({{.position = {0, 0, 0}, .velocity = {0, 0, 0}, .id = 1, .mass = 1}}, 1,
                       60); // in its slot
    ASSERT_TRUE(clusters.alive(0));
    fountain.advance();
    EXPECT_EQ(clusters.count[0], 1U);
    EXPECT_EQ(clusters.alive_count(), 2U);
    EXPECT_EQ(problems(fountain.world.tree, clusters), Problems{});
}

TEST(Emission, CountsTheStateOfTheRandomNumbersByEmitter)
{
    const Fountain fountain({jet(5), jet(0.5)});
    EXPECT_EQ(fountain.emission.counts_before(10 * step), (std::vector<std::uint64_t>{50, 5}));
}

} // namespace
} // namespace slod
