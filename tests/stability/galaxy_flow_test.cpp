#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "core/parallel.hpp"
#include "scene/scene.hpp"
#include "sim/simulation.hpp"
#include "support/disc_measures.hpp"
#include "support/sound.hpp"

// One of the two galaxies of GADGET-2's collision, for about three turns of its inner disc, through clusters
// and by itself. What the clusters carry with them decides whether a disc remains.
namespace slod::test {
namespace {

constexpr std::uint8_t disc = 1; // halo is 0
constexpr double softening = 0.4;
constexpr int step_count = 300;

/// The collision's scene with one softening for all.
Scene scene_with(const std::vector<std::string>& overrides)
{
    Scene scene = sound(load_scene(SLOD_SCENES "/galaxy-collision.toml", overrides));
    scene.initial.fallback = InitialModel::None;
    for (ParticleKind& kind : scene.simulation.kinds)
        kind.softening = softening;
    return scene;
}

/// The first of the file's two galaxies.
const ParticleSet& first_galaxy()
{
    static const ParticleSet galaxy = [] {
        const ParticleSet all = sound(load_initial(scene_with({}), {})).particles;
        ParticleSet first(all.begin(), all.begin() + 20'000);
        first.insert(first.end(), all.begin() + 40'000, all.begin() + 50'000);
        std::sort(first.begin(), first.end(),
                  [](const Particle& a, const Particle& b) { return a.id < b.id; });
        return first;
    }();
    return galaxy;
}

struct Outcome {
    ParticleSet particles;
    DiscMeasures measures;
    double energy_change = 0; ///< relative
    double clusters = 0;      ///< mean over frames
};

Outcome run(const std::vector<std::string>& overrides)
{
    const Scene scene = scene_with(overrides);
    const double gravitational_constant = scene.simulation.units.gravitational_constant();
    const ParticleSet& start = first_galaxy();
    Outcome outcome;
    ThreadTeam(int(std::thread::hardware_concurrency())).run([&] {
        Simulation simulation(scene.simulation, start, {});
        for (int step = 0; step < step_count; ++step)
            outcome.clusters += double(simulation.step({}).counts.clusters) / step_count;
        outcome.particles = simulation.particles();
        const double before = total_energy(start, gravitational_constant, softening);
        const double after = total_energy(outcome.particles, gravitational_constant, softening);
        outcome.energy_change = (after - before) / std::abs(before);
    });
    outcome.measures = measure_disc(outcome.particles, disc, disc_axis(start, disc));
    return outcome;
}

/// Every particle by itself, in double: what the clusters are compared with.
const Outcome& reference()
{
    static const Outcome outcome = run({"background.max_cluster_size=1", "gravity.precision=double"});
    return outcome;
}

double position_error(const Outcome& outcome)
{
    return median_distance(outcome.particles, reference().particles, disc);
}

void report(const char* name, const Outcome& outcome)
{
    std::printf(
        "%-10s clusters %6.0f  R10 %.3f  R50 %.3f  thickness %.3f  sigma_R %.1f  L_z %.1f  energy %+.2f %%  "
        "median error %.2f kpc\n",
        name, outcome.clusters, outcome.measures.r10, outcome.measures.r50, outcome.measures.thickness,
        outcome.measures.radial_dispersion, outcome.measures.spin, 100 * outcome.energy_change,
        position_error(outcome));
}

void expect_close(double value, double expected, double share, const char* what)
{
    EXPECT_NEAR(value, expected, share * expected) << what;
}

TEST(GalaxyFlow, SixteenPerClusterKeepTheDiscWhereRigidClustersLoseIt)
{
    const Outcome flow = run({"background.max_cluster_size=16"});
    const Outcome rigid = run({"background.max_cluster_size=16", "motion.kind=rigid"});
    report("reference", reference());
    report("flow 16", flow);
    report("rigid 16", rigid);
    expect_close(flow.measures.r50, reference().measures.r50, 0.015, "R50");
    expect_close(flow.measures.thickness, reference().measures.thickness, 0.05, "thickness");
    EXPECT_LT(std::abs(flow.energy_change), 0.01);
    EXPECT_LT(position_error(flow), 0.9);
    EXPECT_LT(position_error(flow), position_error(rigid) / 5);
}

TEST(GalaxyFlow, SixtyFourPerClusterKeepTheDisc)
{
    const Outcome flow = run({"background.max_cluster_size=64"});
    report("flow 64", flow);
    expect_close(flow.measures.r50, reference().measures.r50, 0.03, "R50");
    EXPECT_LT(position_error(flow), 1.6);
}

} // namespace
} // namespace slod::test
