#include "support/one_cluster.hpp"

#include <ostream>
#include <stdexcept>

#include "support/clouds.hpp"
#include "support/small_scenes.hpp"

namespace slod::test {

void PrintTo(const Crowd& crowd, std::ostream* out)
{
    *out << crowd.name;
}

std::string name_of(const testing::TestParamInfo<Crowd>& info)
{
    return info.param.name;
}

std::vector<Crowd> crowds()
{
    return {{"One", 1, Motion::Flow},
            {"SixtyFourInFlow", 64, Motion::Flow},
            {"SixtyFourRigid", 64, Motion::Rigid}};
}

SimulationSettings settings_for(const Crowd& crowd)
{
    SimulationSettings settings = quiet_settings();
    settings.motion.motion = crowd.motion;
    settings.background.max_cluster_size = 96; // clusters are formed at seven tenths of it
    settings.background.pool_factor = 4;
    settings.background.max_breadth = 4096;
    return settings;
}

ParticleSet about(std::size_t count, const Vector3d& position, const Vector3d& velocity, double radius,
                  float mass)
{
    ParticleSet all = ball(count, radius, radius, 3, position);
    Vector3d mean(0, 0, 0), mean_velocity(0, 0, 0);
    for (const Particle& particle : all) {
        mean += particle.position / double(count);
        mean_velocity += particle.velocity / double(count);
    }
    for (Particle& particle : all) {
        particle.position += position - mean;
        particle.velocity += velocity - mean_velocity;
        particle.mass = mass;
    }
    return all;
}

Centre only_centre(Simulation& simulation)
{
    const ClusterStates& clusters = simulation.snapshot({.clusters = true}).clusters;
    if (clusters.size() != 1)
        throw std::logic_error(std::to_string(clusters.size()) + " clusters");
    return {clusters.position.front(), clusters.velocity.front()};
}

} // namespace slod::test
