#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "effects/emitter.hpp"
#include "scene/scene.hpp"
#include "sim/simulation.hpp"

// O'Brien, Fisher, Lin 2001, Figure 7: the scene of two cones.
namespace slod::test {
namespace {

constexpr int sectors = 12, slopes = 4;
constexpr int first_frame = 60, last_frame = 420; ///< the streams are steady, for 12 s

/// Shares of the directions in which a cone's droplets fall, in the layer below it.
using Directions = std::array<double, sectors * slopes>;

struct Outcome {
    std::array<Directions, 2> directions; ///< left and right
    std::array<double, 2> droplets{};     ///< counted
    double right_size = 0; ///< mean, of the clusters that fall from the right cone, over the floor
};

std::size_t bin_of(const Vector3d& velocity)
{
    const double turn = std::atan2(velocity.y(), velocity.x()) / (2 * M_PI) + 0.5;
    const double slope = std::hypot(velocity.x(), velocity.y()) / -velocity.z();
    const auto sector = std::min(std::size_t(turn * sectors), std::size_t(sectors - 1));
    return sector * slopes + std::min(std::size_t(slope * 8), std::size_t(slopes - 1));
}

/// Each droplet once, in the first frame that ends with it in the layer from 5 to 5.9 m.
void count(const ParticleSet& particles, std::vector<std::uint64_t>& seen, Outcome& outcome)
{
    for (const Particle& particle : particles) {
        const double z = particle.position.z();
        if (z < 5 || z > 5.9 || particle.velocity.z() >= 0)
            continue;
        const auto side = std::size_t(particle.id >> Emitter::id_shift) - 1;
        const auto number = std::size_t(particle.id & ((std::uint64_t{1} << Emitter::id_shift) - 1));
        seen.resize(std::max(seen.size(), number + 1));
        if ((seen[number] >> side & 1U) != 0)
            continue;
        seen[number] |= std::uint64_t{1} << side;
        outcome.directions[side][bin_of(particle.velocity)] += 1;
        outcome.droplets[side] += 1;
    }
}

Outcome run_cones(const std::vector<std::string>& overrides)
{
    const auto read = load_scene(std::filesystem::path(SLOD_SCENES "/cones.toml"), overrides);
    const Scene& scene = std::get<Scene>(read);
    Simulation simulation(scene.simulation, {}, {});
    Outcome outcome{};
    std::vector<std::uint64_t> seen;
    double clusters = 0, droplets = 0;
    const double floor_height = scene.simulation.colliders.back().position.z();
    for (int frame = 0; frame < last_frame; ++frame) {
        const ClusterStates& states = simulation.step({.clusters = true, .conserved = false}).clusters;
        if (frame < first_frame)
            continue;
        count(simulation.particles(), seen, outcome);
        for (std::size_t i = 0; i < states.size(); ++i) {
            const Vector3d& x = states.position[i];
            if (x.x() > 1 && x.z() > floor_height + 1 && x.z() < floor_height + 2) {
                clusters += 1;
                droplets += states.count[i];
            }
        }
    }
    outcome.right_size = droplets / clusters;
    for (std::size_t side = 0; side < 2; ++side)
        for (double& share : outcome.directions[side])
            share /= outcome.droplets[side];
    return outcome;
}

/// Of all droplets, the share that would have to fall another way.
double distance(const Directions& a, const Directions& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += 0.5 * std::abs(a[i] - b[i]);
    return sum;
}

TEST(Paper, A46_DropletsBounceOffTheConeInTheFineRegionAsWithoutClusters)
{
    const Outcome exact = run_cones({"background.max_cluster_size=1"});
    const Outcome again = run_cones({"background.max_cluster_size=1", "seed=2"});
    const Outcome clustered = run_cones({"seed=3"});
    const double noise = std::max(distance(exact.directions[0], again.directions[0]),
                                  distance(exact.directions[1], again.directions[1]));
    const double left = distance(clustered.directions[0], exact.directions[0]);
    const double right = distance(clustered.directions[1], exact.directions[1]);
    EXPECT_LE(right, 1.5 * noise);
    EXPECT_GE(left, 1.5 * noise) << "grouped as they leave the tap, they do not spread before the cone";
    EXPECT_GE(clustered.right_size, 1.5) << "they merge below";
}

} // namespace
} // namespace slod::test
