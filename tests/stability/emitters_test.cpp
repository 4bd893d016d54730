#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include <gtest/gtest.h>

#include "core/parallel.hpp"
#include "support/case_rows.hpp"
#include "support/one_cluster.hpp"
#include "support/rigid_scenes.hpp"
#include "support/small_scenes.hpp"
#include "support/solids.hpp"

// Births and deaths at the edge of what makes sense, counted.
namespace slod::test {
namespace {

class InCrowds : public testing::TestWithParam<Crowd> {
protected:
    /// A jet without any spread, in clusters of 64, or unclustered.
    static SimulationSettings thin_jet(double per_frame)
    {
        SimulationSettings settings = settings_for(GetParam());
        settings.background.max_cluster_size = double(GetParam().particles);
        settings.emitters = {jet("thin")};
        settings.emitters[0].speed_spread = 0;
        settings.emitters[0].cone_angle_deg = 0;
        settings.emitters[0].lifetime = std::numeric_limits<double>::infinity();
        settings.emitters[0].rate = per_frame / settings.time.step;
        return settings;
    }
};

INSTANTIATE_TEST_SUITE_P(Crowds, InCrowds, testing::ValuesIn(crowds()), name_of);

/// By frame.
struct Deaths {
    std::vector<std::uint64_t> counted;
    std::map<std::uint64_t, std::uint32_t> last; ///< the frame at whose end each id was gone
};

Deaths deaths_of(const SimulationSettings& settings, const ParticleSet& initial)
{
    Deaths deaths;
    Simulation simulation(settings, initial, {});
    for (std::uint32_t frame = 1; frame <= 64; ++frame) {
        const FrameCounts& counts = simulation.step({}).counts;
        EXPECT_LE(counts.drained + counts.killed, counts.died) << "frame " << frame;
        deaths.counted.push_back(counts.died);
        std::map<std::uint64_t, bool> alive;
        for (const Particle& particle : simulation.particles())
            alive[particle.id] = true;
        EXPECT_EQ(counts.particles, alive.size());
        for (const Particle& particle : initial)
            if (!alive.contains(particle.id))
                deaths.last.try_emplace(particle.id, frame);
    }
    EXPECT_EQ(simulation.problems(), Problems{});
    return deaths;
}

// Each particle's life ends in just the frame in which a sink, or a collider that kills, takes it too. First
// the frames are found without lives that end.
TEST_P(InCrowds, F30_WhatDiesOfTwoCausesInAFrameDiesOnce)
{
    for (const bool sink : {true, false}) {
        SimulationSettings settings = settings_for(GetParam());
        settings.uniform_gravity.emplace();
        if (sink) {
            settings.sinks = {{.name = "floor", .position = {0, 0, 0}}};
        } else {
            settings.colliders = {plane({0, 0, 0}, {0, 0, 1})};
            settings.colliders[0].on_hit = OnHit::Kill;
        }
        ParticleSet initial = about(GetParam().particles, {0, 0, 1}, {0, 0, -2}, 0.5);
        const Deaths once = deaths_of(settings, initial);
        ASSERT_EQ(once.last.size(), initial.size());
        for (Particle& particle : initial)
            particle.expiry_frame = once.last.at(particle.id);
        const Deaths twice = deaths_of(settings, initial);
        std::uint64_t died = 0;
        for (const std::uint64_t counted : twice.counted)
            died += counted;
        expect_within("deaths counted, of each particle", double(died) / double(initial.size()), 1, 1);
        EXPECT_EQ(twice.counted, once.counted);
        EXPECT_EQ(twice.last, once.last);
    }
}

// None is taken or given up while a scene runs, of whatever sense: particles are counted by emitter.
TEST(RunningScene, F32_TakesNoOtherEmitters)
{
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    const SmallScene scene = small_scene("fountain");
    Simulation simulation(scene.settings, scene.initial, {}), other(scene.settings, scene.initial, {});
    run(simulation, 20);
    run(other, 20);
    int refused = 0;
    for (const double rate : {1.0, none, std::numeric_limits<double>::infinity()}) {
        SimulationSettings wanted = scene.settings;
        wanted.emitters[0].rate = rate;
        const Problems found = simulation.change_settings(wanted);
        refused += !found.empty() && found.front().starts_with("emitter") ? 1 : 0;
    }
    expect_within("refused, of 3", refused, 3, 3);
    EXPECT_EQ(simulation.state_hash(), other.state_hash());
    run(simulation, 20);
    run(other, 20);
    EXPECT_EQ(simulation.state_hash(), other.state_hash()) << "nor any later one";
}

// Starts are even in time to rounding, wherever frames end, so that the way from one to the next is the speed
// over the rate. Within a cluster of 64 places are rounded to float at 2^-24 of 64 spacings, and of all of
// a jet's 250 spacings where clusters merge: by 1.5e-5 of a spacing. Starts at random would vary by all of
// it.
TEST_P(InCrowds, F33_StartsAreEvenWhateverTheRateAndTheFrames)
{
    for (const double per_frame : {0.3, 1.0, 7.7}) {
        for (const double length : {1.0 / 30, 1.0 / 60, 1.0 / 64}) {
            SimulationSettings settings = thin_jet(per_frame);
            settings.time.step = length;
            const double rate = settings.emitters[0].rate;
            Simulation simulation(settings, {}, {});
            for (int frame = 1; frame <= 60; ++frame) {
                const auto alive = double(simulation.step({}).counts.particles);
                expect_at_most("particles too many or too few",
                               std::abs(alive - std::round(rate * frame * length)), 1);
            }
            std::vector<double> heights;
            for (const Particle& particle : simulation.particles())
                heights.push_back(particle.position.z());
            std::sort(heights.begin(), heights.end());
            const double mean = settings.emitters[0].speed / rate;
            double variance = 0;
            for (std::size_t i = 1; i < heights.size(); ++i)
                variance +=
                    std::pow((heights[i] - heights[i - 1]) / mean - 1, 2) / double(heights.size() - 1);
            expect_at_most("variation of the spacing, of Poisson's", std::sqrt(variance), 1e-4);
            EXPECT_GT(heights.size(), 15U);
        }
    }
}

// A life of no length ends in the frame that it begins in, and an endless one never.
TEST_P(InCrowds, F34_LivesOfNoLengthAndWithoutEndAreBothRight)
{
    SimulationSettings settings = thin_jet(2);
    settings.emitters.push_back(settings.emitters[0]);
    settings.emitters[1].name = "stillborn";
    settings.emitters[1].lifetime = 0;
    settings.emitters.push_back(settings.emitters[0]);
    settings.emitters[2].name = "silent";
    settings.emitters[2].rate = 0;
    Simulation simulation(settings, {}, {});
    std::uint64_t died = 0;
    for (int frame = 1; frame <= 1000; ++frame) {
        const FrameCounts& counts = simulation.step({}).counts;
        died += counts.died;
        expect_at_most("particles too many or too few, of the endless",
                       std::abs(double(counts.particles) - 2 * frame), 1);
    }
    expect_at_most("deaths of the endless", double(died), 0);
}

/// What a flood comes to.
struct Flood {
    std::uint64_t born = 0, refused = 0, particles = 0, hash = 0;
    double clusters = 0, later_clusters = 0;
};

Flood flood(int threads)
{
    SimulationSettings settings = quiet_settings();
    settings.background.max_cluster_size = 64;
    settings.uniform_gravity.emplace();
    settings.limits.max_particles = 1'000'000;
    settings.emitters = {jet("flood")};
    settings.emitters[0].rate = 0;
    settings.emitters[0].burst = 1'200'000;
    settings.emitters[0].lifetime = std::numeric_limits<double>::infinity();
    Flood flood;
    ThreadTeam(threads).run([&] {
        Simulation simulation(settings, {}, {});
        const FrameCounts first = simulation.step({}).counts;
        flood = {first.born, first.births_refused, first.particles, 0, double(first.clusters), 0};
        run(simulation, 4);
        flood.later_clusters = double(simulation.step({}).counts.clusters);
        flood.hash = simulation.state_hash();
    });
    return flood;
}

// As many as the scene may have, in the order of their starts; the others are counted. A million in clusters
// of 64 at most are 15,625 at least.
TEST(Flood, F31_AMillionAreBornInAFrameAndTheOthersRefused)
{
    const Flood alone = flood(1), shared = flood(3);
    expect_within("born, of 1.2 million", double(alone.born), 1e6, 1e6);
    expect_within("refused", double(alone.refused), 2e5, 2e5);
    expect_at_most("particles, of 1 million allowed", double(alone.particles), 1e6);
    expect_at_most("clusters of that frame, of the least", alone.clusters / 15'625, 1);
    expect_at_most("clusters of that frame, of those five frames on", alone.clusters / alone.later_clusters,
                   1);
    EXPECT_EQ(shared.hash, alone.hash) << "the order depends on threads";
}

} // namespace
} // namespace slod::test
