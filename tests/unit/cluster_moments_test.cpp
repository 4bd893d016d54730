#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "cluster/conserved.hpp"
#include "support/clouds.hpp"
#include "support/little_worlds.hpp"
#include "support/totals.hpp"

namespace slod {
namespace {

constexpr double double_rounding = 0x1p-53;
constexpr std::size_t member_count = 200;
constexpr std::uint64_t age = 32;

/// Each kind of map, aged, with drag where it has any.
class MomentsByMap : public testing::TestWithParam<MapKind> {
protected:
    MapRule rule{GetParam(), GetParam() == MapKind::Identity ? 0 : 0.3, 0.05};
    ClusterStore store = test::empty_store(rule);

    ClusterSlot aged_cluster(double heaviest = 3)
    {
        ParticleSet particles = test::ball(member_count, 2, 1, 1, {5, -3, 8});
        test::give_masses(particles, heaviest / 10, heaviest, 1);
        const ClusterSlot slot = test::form(store, particles);
        if (rule.kind == MapKind::Full)
            store.clusters.map[slot.index] = test::aged_map(rule, age, 1, 2);
        return slot;
    }
};

INSTANTIATE_TEST_SUITE_P(Maps, MomentsByMap,
                         testing::Values(MapKind::Identity, MapKind::Scalar, MapKind::Full),
                         [](const auto& kind) {
                             return std::string(names(kind.param)[std::size_t(kind.param)]);
                         });

struct SecondMoments {
    Matrix3d position = Matrix3d::Zero(), velocity = Matrix3d::Zero(), cross = Matrix3d::Zero();
};

/// About the cluster's centre, with mass or number as weight.
SecondMoments second_moments(const ParticleSet& particles, const Vector3d& x, const Vector3d& v, bool by_mass)
{
    SecondMoments sums;
    for (const Particle& particle : particles) {
        const double weight = by_mass ? double(particle.mass) : 1.0;
        const Vector3d dx = particle.position - x;
        const Vector3d dv = particle.velocity - v;
        sums.position += weight * dx * dx.transpose();
        sums.velocity += weight * dv * dv.transpose();
        sums.cross += weight * dx * dv.transpose();
    }
    return sums;
}

double largest(const Matrix3d& matrix)
{
    return matrix.cwiseAbs().maxCoeff();
}

// Both sides map the same stored offsets, in double; each sums member_count terms. Members are at about 10
// from the origin and 2 from the centre, so a rounding of their places is 5 of their offsets'.
constexpr double summing = 2 * double(member_count) * 5 * double_rounding;

TEST_P(MomentsByMap, GiveTheSecondMomentsOfTheMembersAsTheyAreNow)
{
    const ClusterSlot slot = aged_cluster();
    const SecondMoments direct =
        second_moments(test::members(store, slot, age), store.clusters.position[slot.index],
                       store.clusters.velocity[slot.index], true);
    const Moments& moments = store.clusters.moments[slot.index];
    const MapBlocks map = store.clusters.blocks(slot.index, rule, age);
    const MappedMoments mapped = map_moments(moments, map);
    const double extent = largest(direct.position), speed = largest(direct.velocity);
    EXPECT_LE(largest(mapped.position - direct.position), summing * extent);
    EXPECT_LE(largest(mapped.velocity - direct.velocity), summing * speed);
    EXPECT_LE(largest(mapped.cross - direct.cross), summing * std::sqrt(extent * speed));
    EXPECT_EQ(map_position_moments(moments, map).matrix(), Symmetric3::of(mapped.position).matrix());
}

TEST_P(MomentsByMap, CountingMomentsWeighMembersAlike)
{
    const ClusterSlot slot = aged_cluster();
    const ParticleSet now = test::members(store, slot, age);
    Vector3d x{0, 0, 0}, v{0, 0, 0};
    for (const Particle& particle : now) {
        x += particle.position / double(member_count);
        v += particle.velocity / double(member_count);
    }
    const Matrix3d direct = second_moments(now, x, v, false).position;
    const Matrix3d mapped = map_position_moments(store.clusters.counting_moments(slot.index),
                                                 store.clusters.blocks(slot.index, rule, age))
                                .matrix();
    EXPECT_LE(largest(mapped - direct), summing * largest(direct));
}

TEST_P(MomentsByMap, GiveMassMomentumEnergyAndAngularMomentumOfTheMembersAsTheyAreNow)
{
    const ClusterSlot slot = aged_cluster();
    const ParticleSet now = test::members(store, slot, age);
    const ConservedQuantities direct = test::totals(now);
    const ConservedQuantities known = conserved_quantities(store, slot.index, age);
    const double mass = direct.mass;
    EXPECT_NEAR(known.mass, mass, summing * mass);
    EXPECT_LE((known.momentum - direct.momentum).norm(), summing * mass); // speeds of about 1
    EXPECT_LE((known.angular_momentum - direct.angular_momentum).norm(), summing * 10 * mass); // at about 10
    EXPECT_NEAR(known.kinetic_energy, direct.kinetic_energy, summing * mass);
    EXPECT_GT(direct.kinetic_energy, 0.1 * mass); // not a comparison of nothing
}

TEST_P(MomentsByMap, TheTotalIsTheSumOverClusters)
{
    for (int i = 0; i < 5; ++i)
        aged_cluster(double(i + 1));
    const ConservedQuantities direct = test::totals(test::members(store, age));
    const ConservedQuantities known = conserved_quantities(store, age);
    EXPECT_NEAR(known.mass, direct.mass, summing * direct.mass);
    EXPECT_NEAR(known.kinetic_energy, direct.kinetic_energy, summing * direct.mass);
    EXPECT_LE((known.angular_momentum - direct.angular_momentum).norm(), summing * 10 * direct.mass);
}

TEST(Moments, AreTheWeightedSumsOverTheMembers)
{
    Moments moments;
    moments.add(2, {1, 2, 3}, {4, 5, 6});
    moments.add(3, {-1, 4, 2}, {2, 2, 1});
    EXPECT_EQ(moments.weight, 5); // small integers: all of it is exact
    EXPECT_EQ(moments.o, Vector3d(-1, 16, 12));
    EXPECT_EQ(moments.w, Vector3d(14, 16, 15));
    EXPECT_EQ(moments.oo.xy, 2 * 2 - 3 * 4);
    EXPECT_EQ(moments.ww.zz, 2 * 36 + 3 * 1);
    EXPECT_EQ(moments.ow(2, 0), 2 * 12 + 3 * 4);
    EXPECT_EQ(moments.mean_offset().y(), 16.0 / 5);
    EXPECT_EQ(Moments().mean_velocity(), Vector3d(0, 0, 0));
}

TEST(Breadth, IsTheDiameterOfAHomogeneousBall)
{
    constexpr std::size_t count = 20'000;
    ClusterStore store = test::empty_store({MapKind::Identity, 0, 1});
    const ClusterSlot slot = test::form(store, test::ball(count, 3, 0, 1));
    const Symmetric3 extent = map_position_moments(store.clusters.moments[slot.index], {});
    // A principal variance R^2 / 5 has the sampling error sqrt(8/7 / count) of itself, and the largest of
    // three is up to three of those too large; the breadth is its square root.
    EXPECT_NEAR(breadth(extent, double(count)), 6, 6 * 0.5 * 3 * std::sqrt(8.0 / 7 / double(count)));
}

TEST(Breadth, FollowsTheLongestAxisHoweverItIsTurned)
{
    const Matrix3d axes = Vector3d(1, 4, 9).asDiagonal();
    for (double angle = 0; angle < 3; angle += 0.1) {
        const Matrix3d turn = Eigen::AngleAxisd(angle, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
        const Matrix3d turned = turn * axes * turn.transpose();
        // The direct eigenvalue formula is good to some ten roundings of the largest eigenvalue.
        EXPECT_NEAR(breadth(Symmetric3::of(7 * turned), 7), 6 * std::sqrt(5), 6 * 20 * double_rounding)
            << angle;
    }
    EXPECT_EQ(breadth({}, 5), 0);
    EXPECT_EQ(breadth({1, 0, 0, 1, 0, 1}, 0), 0);
}

// The motion about the own centre by its definition: what a rigidly turning ball has.
TEST(Conserved, ASpinningClusterHasTheEnergyAndAngularMomentumOfItsSpin)
{
    ClusterStore store = test::empty_store({MapKind::Identity, 0, 1});
    ParticleSet particles = test::ball(1000, 1, 0, 3);
    const Vector3d spin{0.3, -0.4, 1.2};
    for (Particle& particle : particles)
        particle.velocity = spin.cross(particle.position);
    const ClusterSlot slot = test::form(store, particles);
    const ConservedQuantities known = conserved_quantities(store, slot.index, 0);
    const ConservedQuantities direct = test::totals(particles);
    constexpr double rounding = 0x1p-22; // two factors, each an offset rounded to float
    EXPECT_NEAR(known.kinetic_energy, direct.kinetic_energy, rounding * direct.kinetic_energy);
    EXPECT_LE((known.angular_momentum - direct.angular_momentum).norm(),
              rounding * direct.angular_momentum.norm());
    EXPECT_GT(direct.angular_momentum.dot(spin), 0.35 * 1000 * spin.squaredNorm()); // 2/5 m R^2 omega
}

} // namespace
} // namespace slod
