#include "support/rigid_scenes.hpp"

#include <cmath>
#include <stdexcept>

namespace slod::test {

SimulationSettings rigid_settings(double max_cluster_size)
{
    SimulationSettings settings = quiet_settings();
    settings.motion.motion = Motion::Rigid;
    settings.background.max_cluster_size = max_cluster_size;
    settings.background.velocity_reference = VelocityReference::Rest;
    return settings;
}

RegionOfInterest world_region(const std::string& name, double max_cluster_size)
{
    RegionOfInterest region;
    region.name = name;
    region.partition.max_cluster_size = max_cluster_size;
    region.partition.velocity_reference = VelocityReference::Rest;
    return region;
}

RegionOfInterest ball_region(const std::string& name, const Vector3d& centre, double radius,
                             double max_cluster_size)
{
    RegionOfInterest region = world_region(name, max_cluster_size);
    region.shape = Shape::Sphere;
    region.centre = centre;
    region.radius = radius;
    return region;
}

RegionOfInterest box_region(const std::string& name, const Vector3d& centre, const Vector3d& half_extent,
                            double max_cluster_size)
{
    RegionOfInterest region = world_region(name, max_cluster_size);
    region.shape = Shape::Box;
    region.centre = centre;
    region.half_extent = half_extent;
    return region;
}

const Snapshot& run(Simulation& simulation, int frames)
{
    for (int frame = 1; frame < frames; ++frame)
        simulation.step({});
    return simulation.step({.clusters = true});
}

RegionRow region_by_asking_all(const Simulation& simulation, const Subject& subject)
{
    for (const Simulation::Region& region : simulation.regions())
        if (region.row == background_row || RegionTest(region.settings).contains(subject))
            return region.row;
    throw std::logic_error("no background");
}

std::size_t clusters_in_wrong_regions(const Simulation& simulation, const Snapshot& snapshot)
{
    const ClusterStates& clusters = snapshot.clusters;
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < clusters.size(); ++i) {
        const Subject subject(clusters.position[i], clusters.mass[i] / clusters.count[i],
                              clusters.velocity[i].norm());
        wrong += clusters.region[i] != region_by_asking_all(simulation, subject) ? 1 : 0;
    }
    return wrong;
}

RegionLoad load_of(const Simulation& simulation, const Snapshot& snapshot, const std::string& name)
{
    for (const Simulation::Region& region : simulation.regions())
        for (const RegionLoad& load : snapshot.regions)
            if (region.settings.name == name && load.row == region.row)
                return load;
    throw std::invalid_argument("no region " + name);
}

double rms_distance(const ParticleSet& a, const ParticleSet& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += (a[i].position - b.at(i).position).squaredNorm();
    return std::sqrt(sum / double(a.size()));
}

SimulationSettings windy(double max_cluster_size)
{
    SimulationSettings settings = rigid_settings(max_cluster_size);
    settings.background.max_breadth = 1024;
    settings.uniform_gravity.emplace();
    settings.linear_drag = LinearDragSettings{0.5};
    settings.uniform_wind = UniformWindSettings{{2, -1, 0}};
    return settings;
}

} // namespace slod::test
