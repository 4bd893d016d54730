#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <set>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "scene/galaxy_disc.hpp"
#include "scene/galaxy_mass.hpp"
#include "scene/galaxy_quantiles.hpp"
#include "scene/galaxy_spheroid.hpp"
#include "scene/quiet_numbers.hpp"

namespace slod {
namespace {

/// Share of a normal distribution below a deviate.
double normal_share(double deviate)
{
    return 0.5 * std::erfc(-deviate / std::numbers::sqrt2);
}

/// Mean of a function of a normal deviate, by the trapezoidal rule.
template <class Function>
double mean_over_deviates(const Function& function)
{
    constexpr double step = 0.01, widest = 6;
    double sum = 0, weights = 0;
    for (double deviate = -widest; deviate <= widest; deviate += step) {
        const double weight = std::exp(-0.5 * deviate * deviate);
        sum += weight * function(deviate);
        weights += weight;
    }
    return sum / weights;
}

// A net of base 2: every dimension has one of 2^10 points in each of 2^10 equal intervals, and the first two
// have one in each box of any partition into 2^a times 2^(10-a). Scrambling keeps that.
TEST(QuietNumbers, FillEveryDimensionAndTheFirstTwoTogetherEvenly)
{
    constexpr std::uint32_t count = 1024;
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
        const QuietNumbers numbers(seed, 5);
        for (std::size_t d = 0; d < QuietNumbers::dimensions; ++d) {
            std::set<int> intervals;
            for (std::uint32_t i = 0; i < count; ++i)
                intervals.insert(int(numbers.point(i)[d] * count));
            EXPECT_EQ(intervals.size(), count) << "seed " << seed << ", dimension " << d;
        }
        for (int columns = 2; columns < int(count); columns *= 2) {
            const int rows = int(count) / columns;
            std::set<int> boxes;
            for (std::uint32_t i = 0; i < count; ++i) {
                const QuietNumbers::Point point = numbers.point(i);
                boxes.insert(int(point[0] * columns) * rows + int(point[1] * rows));
            }
            EXPECT_EQ(boxes.size(), count) << "seed " << seed << ", " << columns << " columns";
        }
    }
}

// Independent numbers have a correlation of 1/sqrt(n) = 0.016, these even less; a dimension that repeats
// another one has 1.
TEST(QuietNumbers, DimensionsAreUncorrelated)
{
    constexpr std::uint32_t count = 4096;
    const QuietNumbers numbers(1, 0);
    for (std::size_t a = 0; a < QuietNumbers::dimensions; ++a)
        for (std::size_t b = 0; b < a; ++b) {
            double sum = 0;
            for (std::uint32_t i = 0; i < count; ++i)
                sum += (numbers.point(i)[a] - 0.5) * (numbers.point(i)[b] - 0.5);
            EXPECT_LT(std::abs(12 * sum / count), 4 * 0.016) << a << " and " << b;
        }
}

TEST(QuietNumbers, EverySeedAndEveryStreamHasItsOwn)
{
    const QuietNumbers numbers(1, 0);
    for (const QuietNumbers& other : {QuietNumbers(2, 0), QuietNumbers(1, 1)})
        for (std::uint32_t i = 0; i < 1000; ++i)
            for (std::size_t d = 0; d < QuietNumbers::dimensions; ++d)
                EXPECT_NE(numbers.point(i)[d], other.point(i)[d]) << "point " << i << ", dimension " << d;
}

// Linear interpolation over a step of 0.2 is off by at most 0.2^2 / 8 times the second derivative of the
// normal distribution, 0.242, which is 1.2e-3.
TEST(NormalQuantiles, OfAUniformDistributionAreTheNormalDistribution)
{
    const std::array<double, 2> values{0, 1}, below{0, 7};
    const NormalQuantiles quantiles = normal_quantiles(values, below);
    for (double deviate = -4.95; deviate < 5; deviate += 0.1)
        EXPECT_NEAR(value_at(quantiles, deviate), normal_share(deviate), 1.2e-3) << deviate;
    for (double deviate = -5; deviate < 5.1; deviate += 1)
        EXPECT_NEAR(value_at(quantiles, deviate), normal_share(deviate), 1e-6) << deviate;
    EXPECT_EQ(value_at(quantiles, 9), value_at(quantiles, 5));
}

// Newton: outside a shell its mass pulls as from the centre, inside there is no force; softened, each is that
// of Plummer's law averaged over the sphere, here by a plain sum over its latitudes.
TEST(GalaxyMass, AShellsPotentialIsTheMeanOverItsSurface)
{
    const std::vector<MassAtRadius> shell{{2.0, 3.0}};
    EXPECT_NEAR(shell_potential(shell, 5, 0), -3.0 / 5, 1e-15);
    EXPECT_NEAR(shell_potential(shell, 1, 0), -3.0 / 2, 1e-15);
    EXPECT_NEAR(shell_potential(shell, 0, 0), -3.0 / 2, 1e-15);
    // The midpoint rule is off by the slope at the end times the squared step over 24: 96 / 2 * 1e-8 / 24.
    constexpr int latitudes = 20'000;
    for (const double radius : {0.3, 1.9, 2.0, 7.0}) {
        double mean = 0;
        for (int k = 0; k < latitudes; ++k) {
            const double cosine = 2 * (k + 0.5) / latitudes - 1;
            mean -= 3.0 / std::sqrt(radius * radius + 4 - 4 * radius * cosine + 0.25) / latitudes;
        }
        EXPECT_NEAR(shell_potential(shell, radius, 0.25), mean, 3e-8) << radius;
    }
}

// The trapezoidal rule over the circle converges faster than any power of the number of points.
TEST(GalaxyMass, ARingsPotentialIsTheMeanOverItsCircle)
{
    const std::vector<MassAtRadius> ring{{2.0, 3.0}};
    for (const double radius : {0.0, 0.3, 2.0, 7.0}) {
        constexpr int points = 1000;
        double mean = 0;
        for (int k = 0; k < points; ++k)
            mean -= 3.0 / points /
                    std::sqrt(radius * radius + 4 - 4 * radius * std::cos(2 * std::numbers::pi * k / points) +
                              0.04);
        EXPECT_NEAR(ring_potential(ring, radius, 0.04), mean, 1e-12) << radius;
    }
}

/// Freeman's (1970, ApJ 160, 811) circular speed in a thin exponential disc of mass 1 and scale length 1.
double freeman_speed(double radius)
{
    const double y = radius / 2;
    return std::sqrt(2 * y * y *
                     (std::cyl_bessel_i(0., y) * std::cyl_bessel_k(0., y) -
                      std::cyl_bessel_i(1., y) * std::cyl_bessel_k(1., y)));
}

/// Mean softened distance of two layers of a sech^2 disc.
double mean_distance(double scale_height, double softening)
{
    constexpr int layers = 400;
    const auto height = [&](int k) { return scale_height * std::atanh(2 * (k + 0.5) / layers - 1); };
    double sum = 0;
    for (int a = 0; a < layers; ++a)
        for (int b = 0; b < layers; ++b)
            sum += std::hypot(height(a) - height(b), softening);
    return sum / (layers * layers);
}

// At a small distance d from a thin disc the potential is higher by 2 pi G Sigma d, so that the squared
// speed is lower by R exp(-R) times the layers' mean distance, here 0.045. What comes next is of the order
// of its square, 0.002.
TEST(DiscModel, ADiscAloneTurnsAsFreemanSaysButForItsThicknessAndSoftening)
{
    const DiscModel disc({1, 1, 0.02}, 0.04, 1, [](double) { return 0; });
    const double distance = mean_distance(0.02, 0.04);
    for (const double radius : {0.5, 1.0, 2.0, 3.0, 5.0}) {
        const double thin = std::pow(freeman_speed(radius), 2);
        EXPECT_NEAR(std::pow(disc.circular_speed(radius), 2), thin - radius * std::exp(-radius) * distance,
                    0.002)
            << radius;
    }
}

// Velocities are those of orbits in the field alone: with a heavy mass in the centre and next to none in the
// disc, Kepler's, whatever the stars are drawn to.
TEST(DiscModel, ALightDiscAboutAHeavyMassTurnsAsKeplerSays)
{
    const DiscModel disc({1e-6, 1, 0.01}, 0, 1.5, [](double radius) { return -1 / std::max(radius, 1e-3); });
    for (const double radius : {0.5, 1.0, 3.0})
        EXPECT_NEAR(disc.circular_speed(radius) * std::sqrt(radius), 1, 1e-3) << radius;
    const PhasePoint star = disc.star({0.5, 0.3, 0.6, 0.2, 0.7, 0.4, 0.9});
    const double radius = star.position.norm();
    EXPECT_NEAR(star.velocity.norm() * std::sqrt(radius), 1, 0.01);
    EXPECT_GT(star.position.cross(star.velocity).z(), 0);
}

/// A disc of test particles in a field where all circular orbits have speed 1 but near the centre.
DiscField field_of_flat_rotation(double scale_height)
{
    return DiscField({1e-6, 1, scale_height}, 0,
                     [](double radius) { return 0.5 * std::log(radius * radius + 0.01); });
}

struct OrbitingStar {
    double x, y, vx, vy;

    double radius() const { return std::hypot(x, y); }
    double radial_velocity() const { return (x * vx + y * vy) / radius(); }

    /// One leapfrog step in the field of flat rotation.
    void move(double step)
    {
        x += 0.5 * step * vx;
        y += 0.5 * step * vy;
        const double pull = 1 / (x * x + y * y + 0.01);
        vx -= step * pull * x;
        vy -= step * pull * y;
        x += 0.5 * step * vx;
        y += 0.5 * step * vy;
    }
};

/// Shares of the stars within one, two and four scale lengths, and their rms radial velocity.
std::array<double, 4> look_of(const std::vector<OrbitingStar>& stars)
{
    std::array<double, 4> look{};
    for (const OrbitingStar& star : stars) {
        look[0] += star.radius() < 1 ? 1 : 0;
        look[1] += star.radius() < 2 ? 1 : 0;
        look[2] += star.radius() < 4 ? 1 : 0;
        look[3] += star.radial_velocity() * star.radial_velocity();
    }
    for (double& mean : look)
        mean /= double(stars.size());
    look[3] = std::sqrt(look[3]);
    return look;
}

// A warm disc, its dispersion 0.25 of the circular speed at a scale length, mixes for two turns there. Shares
// of n = 8192 stars have errors below 0.5 / sqrt(n) = 0.0055, their dispersion one of 1 / sqrt(2 n) = 0.8 %;
// three of each are allowed.
TEST(DiscOrbits, AWarmDiscKeepsItsProfileAndItsDispersion)
{
    const DiscField field = field_of_flat_rotation(0.01);
    const double cold_dispersion = 3.36 * field.shape().surface_density(2.5) * 2.5 / std::numbers::sqrt2;
    const DiscOrbits orbits(field, 0.12 / cold_dispersion);
    const MassProfile profile = disc_profile(field.shape());
    const QuietNumbers numbers(1, 0);
    std::vector<OrbitingStar> stars;
    for (std::uint32_t i = 0; i < 8192; ++i) {
        const QuietNumbers::Point point = numbers.point(i);
        const double radius = profile.radius_of(point[0]);
        const auto [radial, orbit_deviate] = normal_pair(point[3], point[4]);
        const OrbitInPlane orbit = orbits.at(radius, orbit_deviate);
        stars.push_back({radius, 0, radial * orbit.radial_dispersion, orbit.azimuthal});
    }
    const auto start = look_of(stars);
    for (int step = 0; step < 1200; ++step)
        for (OrbitingStar& star : stars)
            star.move(0.01);
    const auto end = look_of(stars);
    for (std::size_t share = 0; share < 3; ++share)
        EXPECT_NEAR(end[share], start[share], 3 * 0.0055) << share;
    EXPECT_NEAR(end[3] / start[3], 1, 3 * 0.008);
}

// Toomre's Q fixes the dispersion at 2.5 scale lengths, from there it goes with the rounded-off exponential.
// The corrections leave 0.1 %, and quantiles 0.2 deviates apart overstate a variance by 0.2^2 / 6, 0.7 %.
TEST(DiscOrbits, DispersionsAreToomresAndFallAsTheDensityDoes)
{
    const DiscField field = field_of_flat_rotation(0.01);
    const double toomre_q = 1.6e6; // of a disc without weight: the dispersion is 0.12 of the circular speed
    const DiscOrbits orbits(field, toomre_q);
    const double kappa = std::sqrt((2 + 0.02 / 6.26) / 6.26); // of the field of flat rotation at 2.5
    EXPECT_NEAR(orbits.epicyclic_frequency(2.5), kappa, 1e-3 * kappa);
    const double reference = toomre_q * 3.36 * field.shape().surface_density(2.5) / kappa;
    const auto rounded = [](double radius) { return std::sqrt(radius * radius + 1.0 / 8); };
    for (const double radius : {0.5, 1.0, 2.5, 4.0}) {
        const double squared = mean_over_deviates(
            [&](double deviate) { return std::pow(orbits.at(radius, deviate).radial_dispersion, 2); });
        const double wanted = reference * reference * std::exp(rounded(2.5) - rounded(radius));
        EXPECT_NEAR(squared / wanted, 1, 0.01) << radius;
    }
}

// Inside a homogeneous ball stars swing about the plane like springs: on average over the layers the squares
// of velocity and height, pi^2 / 12 of the scale height's, are the same; for those that pass the plane the
// Jeans equation gives ln 2 of it. Tables of 64 heights and of deviates 0.2 apart are good to 0.5 % each.
TEST(DiscLayers, StarsInAHomogeneousBallSwingLikeSprings)
{
    const double z0 = 0.05;
    const DiscField field({1e-6, 1, z0}, 0, [](double radius) { return 0.5 * radius * radius; });
    const DiscLayers layers(field);
    for (const double radius : {0.3, 1.0, 4.0}) {
        const double squared = mean_over_deviates(
            [&](double deviate) { return std::pow(layers.velocity(radius, 0, deviate), 2); });
        EXPECT_NEAR(squared / (std::numbers::ln2 * z0 * z0), 1, 0.01) << radius;
        EXPECT_NEAR(layers.dispersion(radius) / z0, std::numbers::pi / std::sqrt(12.0), 0.01) << radius;
        EXPECT_EQ(layers.velocity(radius, z0, 1), layers.velocity(radius, -z0, 1));
        EXPECT_NEAR(layers.velocity(radius, z0, 1), -layers.velocity(radius, z0, -1), 1e-9);
    }
}

/// Hernquist's (1990, equation 10) squared radial dispersion for mass and scale length 1.
double hernquist_dispersion_squared(double r)
{
    const double far = 12 * r * std::pow(1 + r, 3) * std::log((1 + r) / r);
    return (far - r / (1 + r) * (25 + 52 * r + 42 * r * r + 12 * r * r * r)) / 12;
}

// The cut-off at 100 scale lengths takes 2 / 100 of the mass away, nearly all of it far outside, and lifts
// the zero of the energies by 1 / 100 of the depth at the scale length: 1 %, the inner radii less.
TEST(IsotropicSpeeds, AHernquistSphereHasHernquistsDispersions)
{
    const SpheroidShape sphere{1, 1, 100};
    const auto shells = spheroid_profile(sphere).pieces();
    const double inner_mass = spheroid_profile(sphere).mass_inside(1) * 4; // 1 without a cut-off
    const IsotropicSpeeds speeds(sphere, [&](double radius) { return shell_potential(shells, radius, 0); });
    for (const double radius : {0.05, 0.2, 1.0, 4.0}) {
        const double squared = mean_over_deviates([&](double deviate) {
            const double speed = speeds.speed(radius, deviate);
            return speed * speed;
        });
        EXPECT_NEAR(squared / 3 / inner_mass, hernquist_dispersion_squared(radius),
                    0.01 * hernquist_dispersion_squared(radius))
            << radius;
    }
}

// Speeds ascend with the deviate, and the fastest does not reach the cut-off.
TEST(IsotropicSpeeds, NoneIsFastEnoughForTheCutOff)
{
    const SpheroidShape sphere{1, 1, 3};
    const auto shells = spheroid_profile(sphere).pieces();
    const auto potential = [&](double radius) { return shell_potential(shells, radius, 0.01); };
    const IsotropicSpeeds speeds(sphere, potential);
    for (double radius = 0.01; radius < 3; radius += 0.01) {
        EXPECT_GE(speeds.speed(radius, -1), 0);
        EXPECT_LE(speeds.speed(radius, -1), speeds.speed(radius, 1));
        // Between two radii of the table the speed is interpolated, the limit is not: they are 0.6 % apart.
        EXPECT_LE(speeds.speed(radius, 9), 1.01 * std::sqrt(2 * (potential(3) - potential(radius))))
            << radius;
    }
}

} // namespace
} // namespace slod
