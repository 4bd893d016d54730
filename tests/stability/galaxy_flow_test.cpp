#include <algorithm>
#include <array>
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
constexpr std::array<int, 2> looks{100, 300}; ///< steps after which a run is looked at

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
    double reformed = 0;      ///< members formed into new clusters, as a share of all, in a frame
};

/// One at each look.
using Outcomes = std::array<Outcome, looks.size()>;

Outcomes run(const std::vector<std::string>& overrides)
{
    const Scene scene = scene_with(overrides);
    const double gravitational_constant = scene.simulation.units.gravitational_constant();
    const ParticleSet& start = first_galaxy();
    static const double before = total_energy(start, gravitational_constant, softening);
    Outcomes outcomes;
    ThreadTeam(int(std::thread::hardware_concurrency())).run([&] {
        Simulation simulation(scene.simulation, start, {});
        double clusters = 0, reformed = 0;
        int step = 0;
        for (std::size_t look = 0; look < looks.size(); ++look) {
            Outcome& outcome = outcomes[look];
            for (; step < looks[look]; ++step) {
                const FrameCounts& counts = simulation.step({}).counts;
                clusters += double(counts.clusters);
                reformed += double(counts.reformed_members) / double(start.size());
            }
            outcome.clusters = clusters / step;
            outcome.reformed = reformed / step;
            outcome.particles = simulation.particles();
            const double after = total_energy(outcome.particles, gravitational_constant, softening);
            outcome.energy_change = (after - before) / std::abs(before);
            outcome.measures = measure_disc(outcome.particles, disc, disc_axis(start, disc));
        }
    });
    return outcomes;
}

/// Every particle by itself, in double: what the clusters are compared with.
const Outcomes& reference()
{
    static const Outcomes outcomes = run({"background.max_cluster_size=1", "gravity.precision=double"});
    return outcomes;
}

double position_error(const Outcomes& outcomes, std::size_t look = looks.size() - 1)
{
    return median_distance(outcomes[look].particles, reference()[look].particles, disc);
}

void report(const std::string& name, const Outcomes& outcomes)
{
    for (std::size_t look = 0; look < looks.size(); ++look) {
        const Outcome& outcome = outcomes[look];
        std::printf(
            "%-10s %d steps  clusters %6.0f  re-formed a frame %4.1f %%  R10 %.3f  R50 %.3f  thickness "
            "%.3f  sigma_R %.1f  L_z %.1f  energy %+.2f %%  median error %.2f kpc\n",
            name.c_str(), looks[look], outcome.clusters, 100 * outcome.reformed, outcome.measures.r10,
            outcome.measures.r50, outcome.measures.thickness, outcome.measures.radial_dispersion,
            outcome.measures.spin, 100 * outcome.energy_change, position_error(outcomes, look));
    }
}

void expect_close(double value, double expected, double share, const char* what)
{
    EXPECT_NEAR(value, expected, share * expected) << what;
}

TEST(GalaxyFlow, SixteenPerClusterKeepTheDiscWhereRigidClustersLoseIt)
{
    const Outcomes flow = run({"background.max_cluster_size=16"});
    const Outcomes rigid = run({"background.max_cluster_size=16", "motion.kind=rigid"});
    report("reference", reference());
    report("flow 16", flow);
    report("rigid 16", rigid);
    const DiscMeasures &found = flow.back().measures, &expected = reference().back().measures;
    expect_close(found.r50, expected.r50, 0.015, "R50");
    expect_close(found.thickness, expected.thickness, 0.05, "thickness");
    EXPECT_LT(std::abs(flow.back().energy_change), 0.01);
    EXPECT_LT(position_error(flow), 0.9);
    EXPECT_LT(position_error(flow), position_error(rigid) / 5);
}

// Sizes from 8 to 64, after 100 and 300 steps.
TEST(GalaxyFlow, StarsAreTheFartherOffTheLargerTheirClusters)
{
    std::array<double, looks.size()> smaller{};
    for (const int size : {8, 16, 32, 64}) {
        const std::string number = std::to_string(size);
        const Outcomes flow = run({"background.max_cluster_size=" + number});
        report("flow " + number, flow);
        for (std::size_t look = 0; look < looks.size(); ++look) {
            const double error = position_error(flow, look);
            EXPECT_GT(error, smaller[look]) << size << " per cluster after " << looks[look] << " steps";
            smaller[look] = error;
        }
        expect_close(flow.back().measures.r50, reference().back().measures.r50, 0.03, "R50");
    }
    EXPECT_LT(smaller.back(), 1.6);
}

} // namespace
} // namespace slod::test
