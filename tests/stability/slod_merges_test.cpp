#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "support/case_rows.hpp"
#include "support/clouds.hpp"
#include "support/merging_pairs.hpp"
#include "support/rigid_scenes.hpp"
#include "support/rigid_world.hpp"
#include "support/totals.hpp"
#include "tree/merge_rules.hpp"

// Merges and splits: what they keep, and what they may change.
namespace slod::test {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double float_rounding = 0x1p-24; // of an offset, relative

/// Merges and splits particles that do not move meanwhile, by maximum sizes from 1 to 64 and back.
struct RoundTrip {
    explicit RoundTrip(const ParticleSet& all) : world({MapKind::Identity, 0, 1}, {}, region(), 8)
    {
        for (const Particle& particle : all)
            world.add({particle});
    }

    static RegionSettings region()
    {
        RegionSettings settings;
        settings.speed_floor = 1000; // all may merge
        return settings;
    }

    void run()
    {
        world.tree.merging = true;
        Regrouping regrouping({}, world.context(0));
        for (const double size : {64.0, 5.0, 32.0, 1.0}) {
            world.region().settings.max_cluster_size = size;
            for (int i = 0; i < 100; ++i) {
                world.store.members.recycle(++frame);
                regrouping.update(world.tree, frame, counts);
            }
        }
    }

    test::World world;
    UpdateCounts counts;
    std::uint64_t frame = 0;
};

// A particle is formed into a cluster as often as its cluster is split or merged: five times on the way from
// 1 to 64, and no more than as often again on each of the ways that follow. Each time its offset, no longer
// than the cloud is wide, is rounded to float.
TEST(SlodStability, S01_MergingAndSplittingRestoresEveryParticle)
{
    constexpr double formings = 4 * 6, width = 4, fastest = 6;
    ParticleSet particles = ball(500, width / 2, fastest / 2, 1, {4, 4, 4});
    give_masses(particles, 0.1, 10, 1);
    RoundTrip trip(particles);
    const ConservedQuantities before = conserved_quantities(trip.world.store, 0);
    trip.run();
    ASSERT_GT(trip.counts.merges, 400U);
    ASSERT_EQ(trip.world.store.clusters.alive_count(), particles.size());
    const ConservedQuantities after = conserved_quantities(trip.world.store, trip.frame);
    const ParticleSet restored = members(trip.world.store, trip.frame);
    double momenta = 0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        EXPECT_EQ(restored[i].mass, particles[i].mass);
        expect_at_most("error of a position", (restored[i].position - particles[i].position).norm(),
                       formings * width * float_rounding);
        expect_at_most("error of a velocity", (restored[i].velocity - particles[i].velocity).norm(),
                       formings * fastest * float_rounding);
        momenta += double(particles[i].mass) * particles[i].velocity.norm();
    }
    expect_at_most("error of the mass, relative", std::abs(after.mass / before.mass - 1), 1e-14);
    // Each of 500 terms of a sum is rounded to 2^-53 of no more than the sum of all.
    expect_at_most("error of the momentum, of the sum of all |p|",
                   (after.momentum - before.momentum).norm() / momenta, 500 * 0x1p-53);
    // Each product of an offset and a velocity has two factors that are rounded.
    expect_at_most("error of the angular momentum", (after.angular_momentum - before.angular_momentum).norm(),
                   2 * formings * width * fastest * before.mass * float_rounding);
}

// What the centres lose in a merge their members have about them.
TEST(SlodStability, S02_EveryMergeTurnsTheCentresEnergyIntoInternalEnergy)
{
    constexpr double formings = 5, fastest = 6;
    ParticleSet particles = ball(500, 2, fastest / 2, 1, {4, 4, 4});
    give_masses(particles, 0.1, 10, 1);
    RoundTrip trip(particles);
    trip.world.region().settings.max_cluster_size = 64;
    trip.world.tree.merging = true;
    Regrouping regrouping({}, trip.world.context(0));
    const auto of_centres = [&] {
        double energy = 0;
        const ClusterTable& clusters = trip.world.store.clusters;
        for (std::size_t slot = 0; slot < clusters.slot_count(); ++slot)
            if (clusters.alive(slot))
                energy += 0.5 * clusters.mass(slot) * clusters.velocity[slot].squaredNorm();
        return energy;
    };
    const double before = conserved_quantities(trip.world.store, 0).kinetic_energy;
    EXPECT_NEAR(of_centres(), before, 1e-13 * before);
    for (std::uint64_t frame = 1; frame <= 100; ++frame) {
        regrouping.update(trip.world.tree, frame, trip.counts);
        const double now = conserved_quantities(trip.world.store, frame).kinetic_energy;
        // A square has two factors, no relative velocity exceeds the cloud's, and 1/2 is in the energy.
        expect_at_most("change of the energy of centres and members", std::abs(now - before),
                       formings * fastest * fastest * totals(particles).mass * float_rounding);
    }
    expect_at_most("share of the energy that the centres have at the end", of_centres() / before, 0.5);
}

// Of two that become one and take their mean velocity, the energy of their relative motion is gone.
TEST(SlodStability, S02_WhereVelocitiesCollapseAMergeLosesTheEnergyOfTheRelativeMotion)
{
    const std::vector<MergingPair> pairs = random_pairs(200, 5);
    test::World world({MapKind::Identity, 0, 1}, {}, RoundTrip::region(), 8);
    double expected_loss = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const MergingPair& pair = pairs[i];
        Particle particle;
        particle.position = Vector3d(8.0 * double(i) + 4, 4, 4); // a cell for each pair
        for (const auto& [mass, velocity] :
             {std::pair(pair.mass, pair.velocity), std::pair(pair.other_mass, pair.other_velocity)}) {
            ++particle.id;
            particle.mass = float(mass);
            particle.velocity = velocity;
            world.add({particle});
        }
        const double mass = double(float(pair.mass)), other_mass = double(float(pair.other_mass));
        expected_loss += 0.5 * mass * other_mass / (mass + other_mass) *
                         (pair.velocity - pair.other_velocity).squaredNorm();
    }
    const double before = conserved_quantities(world.store, 0).kinetic_energy;
    world.tree.merging = true;
    Regrouping regrouping({.merged_velocities = MergedVelocities::Collapse}, world.context(0));
    UpdateCounts counts;
    for (std::uint64_t frame = 1; frame <= 32; ++frame)
        regrouping.update(world.tree, frame, counts);
    ASSERT_EQ(counts.merges, pairs.size());
    const double lost = before - conserved_quantities(world.store, 32).kinetic_energy;
    const double rounding = 400 * 0x1p-53 * before; // of the sum over all particles, which is larger than any
    expect_at_most("error of the energy that 200 collapses lose", std::abs(lost - expected_loss),
                   2 * rounding);
    EXPECT_GT(lost, 1000 * rounding);
}

// Two clusters whose members swarm. Offsets are rounded to float when each is formed and when both are.
TEST(SlodStability, S02_WhereVelocitiesCollapseMembersKeepWhatTheyHaveAboutTheirOwnMean)
{
    constexpr double fastest = 3;
    test::World world({MapKind::Identity, 0, 1}, {}, RoundTrip::region(), 8);
    ParticleSet first = ball(20, 1, fastest / 2, 1, {4, 4, 4}),
                second = ball(30, 1, fastest / 2, 2, {4, 4, 4});
    for (Particle& particle : second) {
        particle.id += 20;
        particle.velocity.x() += 1;
    }
    const ClusterSlot a = world.add(first), b = world.add(second);
    const Vector3d of_first = world.store.clusters.velocity[a.index],
                   of_second = world.store.clusters.velocity[b.index];
    const double before = conserved_quantities(world.store, 0).kinetic_energy;
    world.tree.merging = true;
    Regrouping regrouping({.merged_velocities = MergedVelocities::Collapse}, world.context(0));
    UpdateCounts counts;
    for (std::uint64_t frame = 1; frame <= 16; ++frame)
        regrouping.update(world.tree, frame, counts);
    ASSERT_EQ(counts.merges, 1U);
    const double lost = before - conserved_quantities(world.store, 16).kinetic_energy;
    expect_at_most("error of the energy lost where clusters swarm",
                   std::abs(lost - 0.5 * 20 * 30 / 50 * (of_second - of_first).squaredNorm()),
                   50 * fastest * fastest * float_rounding);
    const Vector3d common = (20 * of_first + 30 * of_second) / 50;
    const ParticleSet all = members(world.store, 16);
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Vector3d own = i < 20 ? first[i].velocity - of_first : second[i - 20].velocity - of_second;
        expect_at_most("error of a member's velocity", (all[i].velocity - common - own).norm(),
                       2 * fastest * float_rounding);
    }
}

TEST(SlodStability, S03_EveryMergeKeepsTheBoundThatThePapersFormulasBreak)
{
    const RegionSettings limits{.speed_ratio = 4, .angle_deg = 90};
    std::vector<MergingPair> pairs = random_pairs(20'000, 3);
    merge_pairs(pairs, limits);
    std::size_t merged = 0, speed_broken = 0, direction_broken = 0;
    for (const MergingPair& pair : pairs) {
        if (!pair.merged)
            continue;
        ++merged;
        const double speed = pair.velocity.norm(), share = pair.other_mass / (pair.mass + pair.other_mass);
        const Vector3d& after = pair.merged_velocity;
        expect_at_most("change of a velocity less its bound",
                       (after - pair.velocity).norm() -
                           velocity_change_bound(limits, speed, pair.mass, pair.other_mass),
                       1e-12);
        expect_at_most(
            "change of the other velocity less its bound",
            (after - pair.other_velocity).norm() -
                velocity_change_bound(limits, pair.other_velocity.norm(), pair.other_mass, pair.mass),
            1e-12);
        const double turn = std::acos(std::min(1.0, after.dot(pair.velocity) / (after.norm() * speed)));
        speed_broken += std::abs(after.norm() - speed) > share * speed * (limits.speed_ratio - 1) ? 1 : 0;
        direction_broken += turn > share * 90 * degree ? 1 : 0;
    }
    ASSERT_GT(merged, 15'000U);
    // In 1e6 other random merges of such masses 7.5 % turned one by more than the paper's formula says; 0.2 %
    // is what 15,000 are off by. The ratio of 4 lets no speed break the other formula, as they are of 0.5
    // to 2.
    expect_within("share of merges that break the paper's formula of directions",
                  double(direction_broken) / double(merged), 0.065, 0.085);
    report_value("share that break that of speeds", double(speed_broken) / double(merged));
}

Particle flying(const Vector3d& direction, std::uint64_t id)
{
    Particle particle;
    particle.position = {4, 4, 4};
    particle.velocity = direction;
    particle.id = id;
    particle.mass = 1;
    return particle;
}

/// In the plane, `angle` off the direction of `v`.
Vector3d turned(const Vector3d& v, double angle)
{
    const double sine = std::sin(angle), cosine = std::cos(angle);
    return Vector3d(cosine * v.x() - sine * v.y(), sine * v.x() + cosine * v.y(), 0).normalized();
}

// Each next one flies 10 degrees off the present cluster. By the means alone all 63 may merge, and the first
// ends 37 degrees off.
TEST(SlodStability, S04_AChainOfMergesDoesNotExceedTheLimit)
{
    const RegionSettings limits{.max_cluster_size = 64, .speed_ratio = 2, .angle_deg = 30};
    ParticleSet chain{flying({1, 0, 0}, 0)};
    Vector3d mean(1, 0, 0);
    bool accepted = true;
    std::size_t joined = 1;
    CaseCurve of_means{.name = "by the means alone", .x = {}, .y = {}};
    CaseCurve of_unions{.name = "by the union of all members", .x = {}, .y = {}};
    for (std::uint64_t id = 1; id <= 63; ++id) {
        const Particle next = flying(turned(mean, 10 * degree), id);
        test::World world({MapKind::Identity, 0, 1}, {}, limits, 8);
        accepted = accepted && may_merge(world.store, limits, world.add(chain), world.add({next}));
        chain.push_back(next);
        if (accepted) {
            joined = chain.size();
            for (const Particle& a : chain)
                for (const Particle& b : chain)
                    expect_at_most("angle between two members",
                                   std::acos(std::min(1.0, a.velocity.dot(b.velocity))) / degree, 30 + 1e-9);
        }
        mean += (next.velocity - mean) / double(chain.size());
        for (CaseCurve* const curve : {&of_means, &of_unions}) {
            if (curve == &of_unions && !accepted)
                continue;
            curve->x.push_back(double(chain.size()));
            curve->y.push_back(std::acos(std::min(1.0, mean.normalized().x())) / degree);
        }
    }
    expect_within("members that join", double(joined), 3, 63);
    expect_at_least("degrees that the first would be off by the means alone",
                    std::acos(mean.normalized().x()) / degree, 36);
    report_picture({.title = "A chain of merges, each 10 degrees off",
                    .x_axis = "members",
                    .y_axis = "first one off the cluster, degrees",
                    .curves = {of_means, of_unions}});
}

/// How many become one cluster when each next one flies 10 degrees off the present cluster, until one does
/// not join, and the angle between that cluster and the first one.
std::pair<std::size_t, double> chain(MergedVelocities merged_velocities)
{
    RegionSettings limits{.max_cluster_size = 64, .speed_ratio = 2, .angle_deg = 30};
    limits.velocity_reference = VelocityReference::Rest;
    test::World world({MapKind::Identity, 0, 1}, {}, limits, 8);
    world.tree.merging = true;
    Regrouping regrouping({.merged_velocities = merged_velocities}, world.context(0));
    Vector3d mean(1, 0, 0);
    world.add({flying(mean, 0)});
    UpdateCounts counts;
    std::uint64_t frame = 0;
    for (std::uint64_t id = 1; id <= 63 && counts.merges == id - 1; ++id) {
        world.add({flying(turned(mean, 10 * degree), id)}, frame);
        for (int i = 0; i < 16; ++i) {
            world.store.members.recycle(++frame);
            regrouping.update(world.tree, frame, counts);
        }
        if (counts.merges == id)
            mean = conserved_quantities(world.store, frame).momentum / double(id + 1);
    }
    return {counts.merges + 1, std::acos(mean.normalized().x())};
}

TEST(SlodStability, S04_WhereVelocitiesCollapseTheLimitHoldsForEachMergeAndNotForAChain)
{
    expect_at_most("members that join where velocities are kept", double(chain(MergedVelocities::Keep).first),
                   63);
    const auto [joined, turn] = chain(MergedVelocities::Collapse);
    expect_within("members that join where they collapse", double(joined), 64, 64);
    expect_at_least("degrees that the first is off where they collapse", turn / degree, 36);
}

// In a crowded leaf a cluster gathers as many as it may at once, which are measured by the ball around all
// their velocities. Those are rounded to float within a cluster, which is a millionth of a degree.
TEST(SlodStability, S04_InACrowdNoTwoMembersExceedTheLimit)
{
    ParticleSet particles = ball(4000, 1, 0.4, 4);
    for (Particle& particle : particles)
        particle.velocity.x() += 1;
    RegionSettings region{.max_cluster_size = 64, .speed_ratio = 1.5, .angle_deg = 30};
    region.velocity_reference = VelocityReference::Rest;
    RigidWorld world({.background = region, .regions = {}}, particles, true);
    world.advance(60);
    double widest = 0, fastest = 0;
    for (const ClusterSlot slot : world.alive()) {
        const ParticleSet members = world.members(slot);
        for (const Particle& a : members)
            for (const Particle& b : members) {
                const double cosine = a.velocity.normalized().dot(b.velocity.normalized());
                widest = std::max(widest, std::acos(std::min(1.0, cosine)) / degree);
                fastest = std::max(fastest, a.velocity.norm() / b.velocity.norm());
            }
    }
    expect_at_most("clusters of a crowd of 4000", double(world.alive().size()), 2000);
    expect_at_most("angle between two members in a crowd", widest, 30 + 1e-4);
    expect_at_most("ratio of the speeds of two members in a crowd", fastest, 1.5 + 1e-5);
}

TEST(SlodStability, S21_CounterStreamingJetsNeverMerge)
{
    ParticleSet particles = cube(2000, 1, 1);
    Random random(21, 0, 0);
    for (Particle& particle : particles)
        particle.velocity =
            (particle.id % 2 == 0 ? 1 : -1) * (Vector3d(1, 0, 0) + 0.05 * Vector3d(point_in_ball(random, 1)));
    RegionSettings region{.max_cluster_size = 32, .speed_ratio = 3, .angle_deg = 170};
    region.velocity_reference = VelocityReference::Rest;
    RigidWorld world({.background = region, .regions = {}}, particles, true);
    const auto flux = [&](double side) {
        double sum = 0;
        for (const ClusterSlot slot : world.alive())
            if (side * world.clusters().velocity[slot.index].x() > 0)
                sum += world.clusters().mass(slot.index) * world.clusters().velocity[slot.index].x();
        return sum;
    };
    const double forth = flux(1), back = flux(-1);
    world.advance(100);
    expect_at_most("clusters of 2000 particles", double(world.clusters().alive_count()), 499);
    int mixed = 0;
    for (const ClusterSlot slot : world.alive()) {
        const ParticleSet members = world.members(slot);
        for (const Particle& particle : members)
            mixed += particle.velocity.x() * members.front().velocity.x() > 0 ? 0 : 1;
    }
    expect_at_most("members of the other jet", mixed, 0);
    expect_at_most("error of the flux of momentum forth, relative", std::abs(flux(1) / forth - 1), 1e-12);
    expect_at_most("error of the flux of momentum back, relative", std::abs(flux(-1) / back - 1), 1e-12);
}

TEST(SlodStability, S22_ARestingPileMergesBelowTheSpeedFloor)
{
    for (const double speed : {0.0, 1e-300, 1e-9}) {
        ParticleSet particles = ball(1000, 1, speed, 1);
        RigidRules rules{.background = {.max_cluster_size = 16, .speed_floor = 1e-6}, .regions = {}};
        rules.background.velocity_reference = VelocityReference::Rest;
        RigidWorld world(rules, particles, true);
        world.advance(100);
        expect_at_most("clusters of 1000 particles", double(world.clusters().alive_count()), 1000 / 8 - 1);
        for (const ClusterSlot slot : world.alive())
            EXPECT_TRUE(world.clusters().velocity[slot.index].allFinite());
        EXPECT_EQ(world.problems(), Problems{});
    }
}

} // namespace
} // namespace slod::test
