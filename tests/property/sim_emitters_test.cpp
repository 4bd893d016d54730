#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include "sim/simulation.hpp"
#include "support/case_rows.hpp"
#include "support/small_scenes.hpp"

// Emitters of every sort in the simulation: the same particles whatever the frames and clusters.
namespace slod::test {
namespace {

// Those of a burst at a frame's very end are of the next frame.
TEST(Emitters, F33_HaveTheNumbersOfTheirBurstsAtAnyFrameLength)
{
    for (const double length : {1.0 / 30, 1.0 / 60, 1.0 / 120}) {
        SimulationSettings settings = quiet_settings();
        settings.time.step = length;
        settings.background.max_breadth = 1;
        settings.emitters = {jet("hail")};
        settings.emitters[0].lifetime = INFINITY;
        settings.emitters[0].rate = 0;
        settings.emitters[0].burst = 100;
        settings.emitters[0].burst_period = 0.25;
        Simulation simulation(settings, {}, {});
        std::uint64_t born = 0;
        for (int frame = 1; double(frame) * length < 2.01; ++frame) {
            born += simulation.step({}).counts.born;
            const double begun = std::ceil(double(frame) * length / 0.25 - 1e-9);
            expect_at_most("particles too many or too few", std::abs(double(born) - 100 * begun), 0);
        }
    }
}

/// Rings, discs, spheres and boxes, with bursts, a schedule and one that moves, in uniform fields.
ParticleSet thrown_out(double max_cluster_size, double length, double duration)
{
    SmallScene scene = small_scene("sinks");
    scene.settings.sinks.clear();
    scene.settings.time.step = length;
    scene.settings.background.max_cluster_size = max_cluster_size;
    for (EmitterSettings& emitter : scene.settings.emitters)
        emitter.lifetime = INFINITY;
    Simulation simulation(scene.settings, scene.initial, {});
    for (double time = 0; time < duration - 0.5 * length; time += length)
        simulation.step({});
    return simulation.particles();
}

// Offsets of at most 4, at speeds of at most 8, are rounded to float at each forming; drag and gravity are
// exact whatever the step. A particle is in no more than 8 clusters one after the other.
TEST(Emitters, ThrowOutTheSameParticlesWhateverTheFramesAndClusters)
{
    const ParticleSet alone = thrown_out(1, 1.0 / 64, 0.75);
    EXPECT_GT(alone.size(), 2000U);
    for (const double size : {1.0, 64.0}) {
        for (const double length : {1.0 / 32, 1.0 / 128}) {
            const ParticleSet all = thrown_out(size, length, 0.75);
            ASSERT_EQ(all.size(), alone.size());
            for (std::size_t i = 0; i < all.size(); ++i) {
                ASSERT_EQ(all[i].id, alone[i].id);
                ASSERT_LE((all[i].position - alone[i].position).norm(), 8 * 2 * 4 * 0x1p-24);
                ASSERT_LE((all[i].velocity - alone[i].velocity).norm(), 8 * 2 * 8 * 0x1p-24);
            }
        }
    }
}

} // namespace
} // namespace slod::test
