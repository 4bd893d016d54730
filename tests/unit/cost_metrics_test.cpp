#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/random.hpp"
#include "cost/distances.hpp"
#include "cost/metrics.hpp"
#include "support/clouds.hpp"

namespace slod::cost {
namespace {

Points ball(std::size_t count, std::uint64_t seed, const Vector3d& centre = {0, 0, 0})
{
    return positions(test::ball(count, 1, 1, seed, centre));
}

TEST(CostMetrics, TheSameCloudInAnyOrderIsAtNoDistance)
{
    const Points a = ball(1000, 1);
    Points b = a;
    std::reverse(b.begin(), b.end());
    EXPECT_EQ(sliced_wasserstein(a, b), 0);
    EXPECT_EQ(density_distance(a, b, 0.3), 0);
}

// The mean of |cos| over the sphere is 1/2; a spiral of 64 directions has it to a thousandth.
TEST(CostMetrics, AShiftIsAtHalfItsLength)
{
    const Points a = ball(1000, 1);
    for (const Vector3d& shift : {Vector3d(0.7, 0, 0), Vector3d(0, 0, 0.7), Vector3d(0.4, -0.4, 0.4)}) {
        Points b = a;
        for (Vector3d& point : b)
            point += shift;
        EXPECT_NEAR(sliced_wasserstein(a, b), shift.norm() / 2, 0.02 * shift.norm());
        EXPECT_NEAR(sliced_wasserstein(b, a), sliced_wasserstein(a, b), 1e-12);
    }
}

// Along each axis the two halves are one and two away: the area is what one unit of length times the shares
// is.
TEST(CostMetrics, CloudsOfDifferentNumberAreCompared)
{
    const Points twice{{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {1, 0, 0}}, once{{0, 0, 0}, {1, 0, 0}};
    EXPECT_NEAR(sliced_wasserstein(twice, once), 0, 1e-15);
    const Points three{{0, 0, 0}, {0, 0, 0}, {1, 0, 0}};
    EXPECT_NEAR(sliced_wasserstein(once, three), (1.0 / 6) / 2, 0.01); // a sixth has moved by one
}

TEST(CostMetrics, DensitiesWithoutACubeInCommonAreAtDistanceOne)
{
    EXPECT_NEAR(density_distance(ball(500, 1), ball(500, 2, {10, 0, 0}), 0.5), 1, 1e-12);
    const Points a{{0.1, 0, 0}, {1.1, 0, 0}}, b{{0.1, 0, 0}, {2.1, 0, 0}};
    EXPECT_NEAR(density_distance(a, b, 1), 0.5, 1e-15);
}

TEST(CostMetrics, EmptyCloudsHaveAnAnswer)
{
    EXPECT_EQ(sliced_wasserstein({}, {}), 0);
    EXPECT_TRUE(std::isinf(sliced_wasserstein({}, ball(3, 1))));
    EXPECT_EQ(density_distance({}, ball(3, 1), 1), 1);
    EXPECT_EQ(lagrangian_radius({}, 0.5), 0);
}

// A homogeneous ball of radius 1: half its points within 2^(-1/3), rms radius sqrt(3/5).
TEST(CostMetrics, RadiiOfAHomogeneousBall)
{
    const Points points = ball(20'000, 3);
    EXPECT_NEAR(lagrangian_radius(points, 0.5), std::cbrt(0.5), 0.01);
    EXPECT_NEAR(rms_radius(points), std::sqrt(0.6), 0.01);
}

TEST(CostMetrics, ParticlesAreComparedByTheirIds)
{
    ParticleSet a = test::ball(101, 1, 1, 1), b = a;
    for (Particle& particle : b)
        particle.position.x() += 0.25;
    b.erase(b.begin() + 3);
    EXPECT_NEAR(median_displacement(a, b), 0.25, 1e-12);
    EXPECT_TRUE(std::isnan(median_displacement(a, {})));
}

TEST(CostMetrics, EnergyDistanceOfTwoPointsIsTheRootOfTwiceTheirs)
{
    EXPECT_NEAR(energy_distance({{0, 0, 0}}, {{0, 4.5, 0}}), 3, 1e-15);
    const Points a = ball(3000, 1);
    EXPECT_EQ(energy_distance(a, a), 0);
    EXPECT_EQ(energy_distance({}, {}), 0);
    EXPECT_TRUE(std::isinf(energy_distance({}, a)));
}

// Its square is quadratic in a small shift.
TEST(CostMetrics, EnergyDistanceGrowsWithAShift)
{
    const Points a = ball(1000, 1);
    double last = 0;
    for (const double shift : {0.1, 0.2, 0.4}) {
        Points b = a;
        for (Vector3d& point : b)
            point.y() += shift;
        EXPECT_GT(energy_distance(a, b), 1.8 * last);
        last = energy_distance(a, b);
    }
}

// A ball that is wider by f has f^-3 of the density at all radii within it: of 1,800 points in a shell, 2.4 %
// by Poisson's law, and less in the mean of nine. Velocities twice as fast have twice the dispersion.
TEST(CostMetrics, ProfilesDifferByTheFactorsOfDensityAndDispersion)
{
    const Points x = ball(20'000, 3), v = ball(20'000, 4);
    Points wider = x, faster = v;
    for (Vector3d& point : wider)
        point *= 1.2;
    for (Vector3d& velocity : faster)
        velocity *= 2;
    const ProfileDistances same = profile_distances(x, v, x, v),
                           other = profile_distances(x, v, wider, faster);
    EXPECT_EQ(same.density, 0);
    EXPECT_EQ(same.dispersion, 0);
    EXPECT_NEAR(other.density, 3 * std::log(1.2), 0.024);
    EXPECT_NEAR(other.dispersion, std::log(2.0), 0.024);
    EXPECT_EQ(profile_distances({}, {}, x, v).density, 0);
}

// The inner half of a thin homogeneous slab is a disc of the same thickness: h / sqrt(12), to 1 / sqrt(2 n).
TEST(CostMetrics, ThicknessIsThatOfADiscHoweverItIsTurned)
{
    Points slab = ball(20'000, 5);
    const Vector3d axis = Vector3d(1, 2, 3).normalized();
    Random random(7, 1, 1);
    for (Vector3d& point : slab)
        point += (0.1 * random.uniform() - point.dot(axis)) * axis;
    EXPECT_NEAR(thickness(slab), 0.1 / std::sqrt(12.0), 0.03 * 0.1 / std::sqrt(12.0));
    EXPECT_EQ(thickness({{1, 2, 3}}), 0);
}

// Clouds of different seeds are drawn alike, so each is about as far from the first as the others are. One
// distance of n = 2,000 points scatters by some 20 % about the mean, the largest of four by up to twice that.
TEST(CostMetrics, TwoSeedsAreAboutOneFloorApart)
{
    const auto cloud = [](std::uint64_t seed) { return Cloud(test::ball(2000, 1, 1, seed)); };
    const Cloud first = cloud(1);
    Distances floor;
    for (std::uint64_t seed = 2; seed < 8; ++seed)
        floor += distances(first, cloud(seed), 1) / 6;
    for (std::uint64_t seed = 8; seed < 12; ++seed) {
        const Distances errors = in_floors(distances(first, cloud(seed), 1), floor);
        EXPECT_GT(errors.position, 0.5) << "seed " << seed;
        EXPECT_LT(errors.largest(), 1.8) << "seed " << seed;
    }
}

} // namespace
} // namespace slod::cost
