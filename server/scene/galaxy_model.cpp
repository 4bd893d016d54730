#include "scene/galaxy_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "core/parallel.hpp"
#include "core/portable_math.hpp"
#include "scene/galaxy_disc.hpp"
#include "scene/galaxy_mass.hpp"
#include "scene/galaxy_quantiles.hpp"
#include "scene/galaxy_spheroid.hpp"
#include "scene/quiet_numbers.hpp"

namespace slod {

namespace {

constexpr std::size_t particles_per_task = 1024;

/// A component of the galaxy as the others feel it.
struct Component {
    GalaxyKind kind;
    double mass;
    std::size_t particles;
    std::vector<MassAtRadius> shells; ///< spherically averaged
};

using Components = std::array<Component, 3>; ///< disc, bulge, halo; their places are the random streams

struct Blueprint {
    DiscShape disc;
    SpheroidShape bulge, halo;
    Components components;
};

std::size_t particles_of(double share, std::size_t particles)
{
    return std::size_t(std::min(share, 1.0) * double(particles) + 0.5);
}

Blueprint blueprint(const GalaxySettings& settings, const GalaxyKinds& kinds)
{
    const double cutoff = settings.halo_cutoff * settings.halo_scale_length;
    Blueprint galaxy{{settings.disc_mass, settings.disc_scale_length, settings.disc_scale_height},
                     {settings.bulge_mass, settings.bulge_scale_length, cutoff},
                     {settings.halo_mass, settings.halo_scale_length, cutoff},
                     {}};
    const std::size_t all = settings.particles;
    const std::size_t in_bulge = settings.bulge_mass > 0 ? particles_of(settings.bulge_share, all) : 0;
    const std::size_t outside_bulge = all - in_bulge;
    const std::size_t in_disc = settings.halo_mass > 0
                                    ? std::min(particles_of(settings.disc_share, all), outside_bulge)
                                    : outside_bulge;
    galaxy.components = {{
        {kinds.disc, settings.disc_mass, in_disc, disc_shells(galaxy.disc, disc_profile(galaxy.disc))},
        {kinds.bulge, settings.bulge_mass, in_bulge, spheroid_profile(galaxy.bulge).pieces()},
        {kinds.halo, settings.halo_mass, outside_bulge - in_disc, spheroid_profile(galaxy.halo).pieces()},
    }};
    return galaxy;
}

/// The potential of spherically averaged components that particles of `kind` feel.
double potential(std::span<const Component> components, const GalaxyKind& kind, double radius)
{
    double sum = 0;
    for (const Component& component : components) {
        const double own = kind.softening, other = component.kind.softening;
        sum += shell_potential(component.shells, radius, 0.5 * (own * own + other * other));
    }
    return sum;
}

Vector3d direction(double u, double v)
{
    const double height = 2 * u - 1;
    const double across = std::sqrt(1 - height * height);
    const SineCosine turn = portable_sincos(2 * std::numbers::pi * v);
    return {across * turn.cosine, across * turn.sine, height};
}

/// Fills a component's places with the points that `draw` makes of their random numbers.
void fill(std::span<Particle> places, const QuietNumbers& random, double velocity_unit,
          const std::function<PhasePoint(const QuietNumbers::Point&)>& draw)
{
    for_each_block(places.size(), particles_per_task, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const PhasePoint point = draw(random.point(std::uint32_t(i)));
            places[i].position = point.position;
            places[i].velocity = velocity_unit * point.velocity;
        }
    });
}

/// Puts the centre of particles of one mass to rest at the origin. The second pass takes away what the
/// rounding of the first one leaves.
void centre(std::span<Particle> particles)
{
    for (int pass = 0; pass < 2; ++pass) {
        Vector3d position{0, 0, 0}, velocity{0, 0, 0};
        for (const Particle& particle : particles) {
            position += particle.position;
            velocity += particle.velocity;
        }
        position /= double(particles.size());
        velocity /= double(particles.size());
        for (Particle& particle : particles) {
            particle.position -= position;
            particle.velocity -= velocity;
        }
    }
}

void fill_disc(std::span<Particle> places, const DiscShape& shape, double toomre_q,
               const Components& components, const QuietNumbers& random, double velocity_unit)
{
    const GalaxyKind& kind = components[0].kind;
    const auto spheroids = std::span(components).subspan(1);
    const DiscModel disc(shape, kind.softening, toomre_q,
                         [&](double radius) { return potential(spheroids, kind, radius); });
    fill(places, random, velocity_unit, [&](const QuietNumbers::Point& point) { return disc.star(point); });
}

void fill_spheroid(std::span<Particle> places, const SpheroidShape& shape, const GalaxyKind& kind,
                   const Components& components, const QuietNumbers& random, double velocity_unit)
{
    const MassProfile profile = spheroid_profile(shape);
    const IsotropicSpeeds speeds(shape, [&](double radius) { return potential(components, kind, radius); });
    fill(places, random, velocity_unit, [&](const QuietNumbers::Point& point) {
        const double radius = profile.radius_of(point[0]);
        const double speed = speeds.speed(radius, normal_pair(point[3], point[4])[0]);
        return PhasePoint{radius * direction(point[1], point[2]), speed * direction(point[5], point[6])};
    });
}

} // namespace

ParticleSet make_galaxy(const GalaxySettings& settings, const GalaxyKinds& kinds,
                        double gravitational_constant, std::uint64_t seed)
{
    const FlushDenormals flush; // as the tasks do, whatever the caller's thread does
    const Blueprint galaxy = blueprint(settings, kinds);
    ParticleSet particles(settings.particles);
    const double velocity_unit = std::sqrt(gravitational_constant); // the components know of G = 1 only
    std::size_t next = 0;
    for (std::uint32_t stream = 0; stream < galaxy.components.size(); ++stream) {
        const Component& component = galaxy.components[stream];
        if (component.particles == 0)
            continue;
        const auto places = std::span(particles).subspan(next, component.particles);
        const QuietNumbers random(seed, stream);
        if (stream == 0)
            fill_disc(places, galaxy.disc, settings.toomre_q, galaxy.components, random, velocity_unit);
        else
            fill_spheroid(places, stream == 1 ? galaxy.bulge : galaxy.halo, component.kind, galaxy.components,
                          random, velocity_unit);
        centre(places);
        for (Particle& particle : places) {
            particle.id = next++;
            particle.kind = component.kind.index;
            particle.mass = float(component.mass / double(component.particles));
        }
    }
    return particles;
}

} // namespace slod
