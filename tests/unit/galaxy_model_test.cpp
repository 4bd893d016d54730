#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "core/parallel.hpp"
#include "scene/galaxy_model.hpp"

namespace slod {
namespace {

constexpr double gravitational_constant = 43007.1; // kpc (km/s)^2 / 10^10 solar masses
constexpr GalaxyKinds kinds{{2, 0.5}, {0, 0.3}, {1, 5.0}};
constexpr std::array<double, 3> softening_of_kind{0.3, 5.0, 0.5};

GalaxySettings settings_with(std::uint32_t particles)
{
    GalaxySettings settings;
    settings.particles = particles;
    return settings;
}

ParticleSet galaxy_of(std::uint32_t particles, std::uint64_t seed = 1)
{
    return make_galaxy(settings_with(particles), kinds, gravitational_constant, seed);
}

std::vector<Particle> only(const ParticleSet& particles, const GalaxyKind& kind)
{
    std::vector<Particle> some;
    std::copy_if(particles.begin(), particles.end(), std::back_inserter(some),
                 [&](const Particle& particle) { return particle.kind == kind.index; });
    return some;
}

/// A galaxy with the accelerations and potentials that its particles give each other, by direct sum.
struct Solved {
    ParticleSet particles;
    std::vector<Vector3d> acceleration;
    std::vector<double> potential;
};

Solved solved(ParticleSet particles)
{
    const std::size_t n = particles.size();
    Solved galaxy{std::move(particles), std::vector<Vector3d>(n), std::vector<double>(n)};
    for_each_block(n, 64, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const Particle& target = galaxy.particles[i];
            Vector3d acceleration{0, 0, 0};
            double potential = 0;
            for (const Particle& source : galaxy.particles) {
                if (source.id == target.id)
                    continue;
                const double a = softening_of_kind[target.kind], b = softening_of_kind[source.kind];
                const Vector3d apart = source.position - target.position;
                const double inverse = 1 / std::sqrt(apart.squaredNorm() + 0.5 * (a * a + b * b));
                const double pull = gravitational_constant * double(source.mass) * inverse;
                potential -= pull;
                acceleration += pull * inverse * inverse * apart;
            }
            galaxy.acceleration[i] = acceleration;
            galaxy.potential[i] = potential;
        }
    });
    return galaxy;
}

const Solved& the_galaxy()
{
    static const Solved galaxy = solved(galaxy_of(8000));
    return galaxy;
}

/// Largest difference between the distribution of the values and the one wanted (Kolmogorov and Smirnov).
double largest_difference(std::vector<double> values, const std::function<double(double)>& share_below)
{
    std::sort(values.begin(), values.end());
    double largest = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double wanted = share_below(values[i]), step = 1.0 / double(values.size());
        largest =
            std::max({largest, std::abs(wanted - double(i) * step), std::abs(wanted - double(i + 1) * step)});
    }
    return largest;
}

/// What that difference stays below for 999 of 1000 sets of independent values; ours are more even.
double sampling_error(std::size_t count)
{
    return 1.95 / std::sqrt(double(count));
}

/// Shares of the mass of a Hernquist sphere that fades to nothing at its cut-off, by the midpoint rule.
std::function<double(double)> hernquist_shares(double scale_length, double cutoff)
{
    constexpr int steps = 100'000;
    std::vector<double> inside{0};
    for (int k = 0; k < steps; ++k) {
        const double r = (k + 0.5) / steps * cutoff;
        const double fade = 1 - r * r / (cutoff * cutoff);
        inside.push_back(inside.back() + r / std::pow(r + scale_length, 3) * fade * fade);
    }
    return [=](double radius) {
        return inside[std::size_t(std::min(radius / cutoff, 1.0) * steps)] / inside.back();
    };
}

TEST(GalaxyModel, CountsKindsAndIdsAreAsAsked)
{
    const ParticleSet particles = galaxy_of(1000);
    ASSERT_EQ(particles.size(), 1000U);
    for (std::size_t i = 0; i < particles.size(); ++i) {
        EXPECT_EQ(particles[i].id, i);
        EXPECT_EQ(particles[i].expiry_frame, Particle::never);
        const GalaxyKind& expected = i < 600 ? kinds.disc : i < 660 ? kinds.bulge : kinds.halo;
        EXPECT_EQ(particles[i].kind, expected.index) << i;
    }
}

TEST(GalaxyModel, AComponentWithoutMassHasNoParticles)
{
    GalaxySettings settings = settings_with(1000);
    settings.bulge_mass = 0;
    const ParticleSet without_bulge = make_galaxy(settings, kinds, 1, 1);
    EXPECT_EQ(only(without_bulge, kinds.bulge).size(), 0U);
    EXPECT_EQ(only(without_bulge, kinds.disc).size(), 600U);
    settings.halo_mass = 0;
    const ParticleSet disc_alone = make_galaxy(settings, kinds, 1, 1);
    EXPECT_EQ(only(disc_alone, kinds.disc).size(), 1000U);
    for (const Particle& particle : disc_alone)
        ASSERT_TRUE(particle.position.allFinite() && particle.velocity.allFinite()) << particle.id;
}

// Masses are equal floats: their sum is off by half a unit in the last place at most.
TEST(GalaxyModel, AnyNumberOfParticlesHasTheMassesAsked)
{
    const GalaxySettings settings;
    const std::array<std::pair<GalaxyKind, double>, 3> components{{{kinds.disc, settings.disc_mass},
                                                                   {kinds.bulge, settings.bulge_mass},
                                                                   {kinds.halo, settings.halo_mass}}};
    for (const std::uint32_t count : {1000U, 2000U}) {
        const ParticleSet particles = galaxy_of(count);
        for (const auto& [kind, wanted] : components) {
            double mass = 0;
            for (const Particle& particle : only(particles, kind))
                mass += double(particle.mass);
            EXPECT_NEAR(mass, wanted, wanted * std::numeric_limits<float>::epsilon() / 2) << count;
        }
    }
}

TEST(GalaxyModel, TheDiscIsExponentialInThePlane)
{
    const auto disc = only(the_galaxy().particles, kinds.disc);
    std::vector<double> radii;
    for (const Particle& particle : disc)
        radii.push_back(std::hypot(particle.position.x(), particle.position.y()));
    const double h = GalaxySettings{}.disc_scale_length;
    const double difference = largest_difference(radii, [&](double radius) {
        const auto inside = [](double x) { return 1 - (1 + x) * std::exp(-x); };
        return inside(std::min(radius / h, 10.0)) / inside(10);
    });
    EXPECT_LT(difference, sampling_error(disc.size()));
}

// Stars of one place swing by different heights, 0.2 of the mean about it, so that the profile is a mixture
// of thicknesses. With the same rms it differs by half the variance times a factor below 0.3, 0.006.
TEST(GalaxyModel, TheDiscsLayersHaveASechSquaredProfile)
{
    const auto disc = only(the_galaxy().particles, kinds.disc);
    std::vector<double> heights;
    for (const Particle& particle : disc)
        heights.push_back(particle.position.z());
    const double z0 = GalaxySettings{}.disc_scale_height;
    const double difference =
        largest_difference(heights, [&](double height) { return 0.5 * (1 + std::tanh(height / z0)); });
    EXPECT_LT(difference, sampling_error(disc.size()) + 0.006);
}

TEST(GalaxyModel, TheSpheroidsAreHernquistSpheresThatFade)
{
    const GalaxySettings settings;
    const double cutoff = settings.halo_cutoff * settings.halo_scale_length;
    const std::array<std::pair<GalaxyKind, double>, 2> spheroids{
        {{kinds.bulge, settings.bulge_scale_length}, {kinds.halo, settings.halo_scale_length}}};
    for (const auto& [kind, scale_length] : spheroids) {
        const auto spheroid = only(the_galaxy().particles, kind);
        std::vector<double> radii, cosines, angles;
        for (const Particle& particle : spheroid) {
            radii.push_back(particle.position.norm());
            cosines.push_back(particle.position.z() / radii.back());
            angles.push_back(std::atan2(particle.position.y(), particle.position.x()));
        }
        const double allowed = sampling_error(spheroid.size());
        EXPECT_LT(largest_difference(radii, hernquist_shares(scale_length, cutoff)), allowed);
        EXPECT_LT(largest_difference(cosines, [](double cosine) { return 0.5 * (1 + cosine); }), allowed);
        EXPECT_LT(largest_difference(angles, [](double a) { return 0.5 + a / (2 * std::numbers::pi); }),
                  allowed);
    }
}

/// The disc's stars in a ring: their means, and the circular speed that the real accelerations call for.
struct RingOfStars {
    std::size_t stars = 0;
    double radius = 0, streaming = 0, radial_squared = 0, azimuthal_squared = 0, circular_squared = 0;
};

RingOfStars ring_of_stars(const Solved& galaxy, double inner, double outer)
{
    RingOfStars ring;
    double azimuthal_squares = 0;
    for (std::size_t i = 0; i < galaxy.particles.size(); ++i) {
        const Particle& star = galaxy.particles[i];
        const Vector3d in_plane{star.position.x(), star.position.y(), 0};
        const double radius = in_plane.norm();
        if (star.kind != kinds.disc.index || radius < inner || radius > outer)
            continue;
        const Vector3d outwards = in_plane / radius, along{-outwards.y(), outwards.x(), 0};
        ++ring.stars;
        ring.radius += radius;
        ring.streaming += star.velocity.dot(along);
        ring.radial_squared += std::pow(star.velocity.dot(outwards), 2);
        azimuthal_squares += std::pow(star.velocity.dot(along), 2);
        ring.circular_squared -= galaxy.acceleration[i].dot(in_plane);
    }
    for (double* mean : {&ring.radius, &ring.streaming, &ring.radial_squared, &ring.circular_squared})
        *mean /= double(ring.stars);
    ring.azimuthal_squared = azimuthal_squares / double(ring.stars) - ring.streaming * ring.streaming;
    return ring;
}

// The radial Jeans equation, averaged over the layers (Binney and Tremaine 2008, equation 4.227 with the
// tilt's term integrated away): what the stars stream slower than a circular orbit balances the pressure. The
// mean has a standard error of the azimuthal dispersion over sqrt(n), and the circular speed one of about the
// same size from the particles' noise; three of both are allowed.
TEST(GalaxyModel, TheDiscStreamsAsTheJeansEquationSays)
{
    const double h = GalaxySettings{}.disc_scale_length;
    for (const double scale_lengths : {0.75, 1.25, 2.0, 3.0, 4.0}) {
        const RingOfStars ring =
            ring_of_stars(the_galaxy(), 0.9 * scale_lengths * h, 1.1 * scale_lengths * h);
        ASSERT_GT(ring.stars, 100U);
        const double r = ring.radius;
        const double fall = r * r / (h * std::sqrt(r * r + h * h / 8)); // of the squared radial dispersion
        const double squared =
            ring.circular_squared + ring.radial_squared * (1 - r / h - fall) - ring.azimuthal_squared;
        const double error = std::sqrt(ring.azimuthal_squared / double(ring.stars));
        EXPECT_NEAR(ring.streaming, std::sqrt(squared), 3 * 1.5 * error) << scale_lengths << " scale lengths";
    }
}

// Q = sigma kappa / (3.36 G Sigma) at 2.5 scale lengths, the frequency kappa from the real accelerations on
// either side. A dispersion of n stars is good to 1 / sqrt(2 n), 3.5 % for 400; kappa^2 is off by about as
// much.
TEST(GalaxyModel, ToomresQIsAsAsked)
{
    const GalaxySettings settings;
    const double h = settings.disc_scale_length, r = 2.5 * h;
    const RingOfStars ring = ring_of_stars(the_galaxy(), 0.9 * r, 1.1 * r);
    const RingOfStars inner = ring_of_stars(the_galaxy(), 0.6 * r, 0.8 * r);
    const RingOfStars outer = ring_of_stars(the_galaxy(), 1.2 * r, 1.4 * r);
    const double slope = std::log(outer.circular_squared / inner.circular_squared) /
                         std::log(outer.radius / inner.radius); // of the squared circular speed
    const double kappa = std::sqrt((2 + slope) * ring.circular_squared) / ring.radius;
    const double density = settings.disc_mass / (2 * std::numbers::pi * h * h) * std::exp(-ring.radius / h);
    const double q = std::sqrt(ring.radial_squared) * kappa / (3.36 * gravitational_constant * density);
    EXPECT_NEAR(q, settings.toomre_q, 3 * 0.05 * settings.toomre_q);
}

// Clausius' virial, as softened pairs have it: twice the kinetic energy against the sum of m x.a.
TEST(GalaxyModel, EachComponentAndTheWholeAreInVirialEquilibrium)
{
    std::array<double, 3> kinetic{}, virial{};
    const Solved& galaxy = the_galaxy();
    for (std::size_t i = 0; i < galaxy.particles.size(); ++i) {
        const Particle& particle = galaxy.particles[i];
        kinetic[particle.kind] += double(particle.mass) * particle.velocity.squaredNorm();
        virial[particle.kind] -= double(particle.mass) * particle.position.dot(galaxy.acceleration[i]);
    }
    EXPECT_NEAR((kinetic[0] + kinetic[1] + kinetic[2]) / (virial[0] + virial[1] + virial[2]), 1, 0.05);
    for (const GalaxyKind& kind : {kinds.disc, kinds.bulge, kinds.halo})
        EXPECT_NEAR(kinetic[kind.index] / virial[kind.index], 1, 0.05) << int(kind.index);
}

// And across the disc by itself: sum of vz^2 against that of -z az. Each is a mean over n stars of something
// that scatters by its own size: 1/sqrt(n) = 1.4 % for 4800 stars; four of it.
TEST(GalaxyModel, TheDiscIsInVerticalEquilibrium)
{
    double kinetic = 0, virial = 0;
    const Solved& galaxy = the_galaxy();
    for (std::size_t i = 0; i < galaxy.particles.size(); ++i) {
        const Particle& star = galaxy.particles[i];
        if (star.kind != kinds.disc.index)
            continue;
        kinetic += star.velocity.z() * star.velocity.z();
        virial -= star.position.z() * galaxy.acceleration[i].z();
    }
    EXPECT_NEAR(kinetic / virial, 1, 4 * 0.014);
}

TEST(GalaxyModel, EveryParticleIsBound)
{
    const Solved& galaxy = the_galaxy();
    for (std::size_t i = 0; i < galaxy.particles.size(); ++i)
        EXPECT_LT(0.5 * galaxy.particles[i].velocity.squaredNorm() + galaxy.potential[i], 0) << i;
}

// Sums of n terms, each rounded: below n units in the last place of the sum of their sizes.
TEST(GalaxyModel, ItRestsAtTheOriginAndSoDoesEachComponent)
{
    for (const GalaxyKind& kind : {kinds.disc, kinds.bulge, kinds.halo}) {
        Vector3d position{0, 0, 0}, velocity{0, 0, 0};
        double distance = 0, speed = 0;
        const auto component = only(the_galaxy().particles, kind);
        for (const Particle& particle : component) {
            position += particle.position;
            velocity += particle.velocity;
            distance += particle.position.norm();
            speed += particle.velocity.norm();
        }
        const double rounding = double(component.size()) * std::numeric_limits<double>::epsilon();
        EXPECT_LE(position.norm(), distance * rounding);
        EXPECT_LE(velocity.norm(), speed * rounding);
    }
}

bool same(const ParticleSet& a, const ParticleSet& b)
{
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Particle& x, const Particle& y) {
        return x.position == y.position && x.velocity == y.velocity && x.id == y.id && x.mass == y.mass;
    });
}

TEST(GalaxyModel, ASeedGivesTheSameBitsOnAnyNumberOfThreads)
{
    ParticleSet one, many;
    ThreadTeam(1).run([&] { one = galaxy_of(3000, 9); });
    ThreadTeam(4).run([&] { many = galaxy_of(3000, 9); });
    EXPECT_TRUE(same(one, many));
}

TEST(GalaxyModel, AnotherSeedIsAnotherGalaxy)
{
    const ParticleSet a = galaxy_of(1000, 1), b = galaxy_of(1000, 2);
    std::size_t alike = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        alike += a[i].position == b[i].position ? 1 : 0;
    EXPECT_EQ(alike, 0U);
}

} // namespace
} // namespace slod
