#include "support/drifting_cloud.hpp"

#include "support/rigid_scenes.hpp"
#include "support/small_scenes.hpp"

namespace slod::test {

Simulation drifting_cloud(double max_cluster_size, double max_breadth)
{
    SimulationSettings settings = rigid_settings(max_cluster_size);
    settings.background.max_breadth = max_breadth;
    ParticleSet particles;
    add_cloud(particles, {.count = 6000}, 5);
    for (Particle& particle : particles)
        particle.velocity = {0.1, 0, 0};
    return Simulation(settings, particles, {});
}

} // namespace slod::test
