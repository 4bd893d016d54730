#include "support/streams.hpp"

#include "support/rigid_scenes.hpp"

namespace slod::test {
namespace {

double across(const Vector3d& v)
{
    return v.x() * v.x() + v.y() * v.y();
}

} // namespace

SimulationSettings stream_settings()
{
    SimulationSettings settings = rigid_settings(16);
    settings.background.angle_deg = 0; // what is grouped at first stays
    settings.emitters = {jet("jet")};
    settings.emitters[0].lifetime = 10;
    return settings;
}

SimulationSettings stream_settings(double reach, ClusterVelocity velocity)
{
    SimulationSettings settings = stream_settings();
    settings.regions = {ball_region("spring", {0, 0, 0}, reach, 16)};
    settings.regions[0].partition.angle_deg = 0;
    settings.regions[0].partition.cluster_velocity = velocity;
    return settings;
}

double transverse_variance(const ClusterStates& clusters)
{
    double sum = 0;
    for (const Vector3d& velocity : clusters.velocity)
        sum += across(velocity) / double(clusters.size());
    return sum;
}

double transverse_variance(const ParticleSet& particles)
{
    double sum = 0;
    for (const Particle& particle : particles)
        sum += across(particle.velocity) / double(particles.size());
    return sum;
}

Vector3d momentum_of(const ClusterStates& clusters)
{
    Vector3d sum(0, 0, 0);
    for (std::size_t i = 0; i < clusters.size(); ++i)
        sum += clusters.mass[i] * clusters.velocity[i];
    return sum;
}

} // namespace slod::test
