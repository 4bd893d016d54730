#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "app/publisher.hpp"
#include "core/random.hpp"
#include "sim/snapshot.hpp"
#include "support/random_draws.hpp"

namespace slod {

/// Clusters that no simulation made: random places in a box of 200 about (1000, 0, -500), masses, speeds.
inline ClusterStates made_up_clusters(std::size_t count, std::uint64_t seed)
{
    ClusterStates states;
    for (std::uint32_t row = 0; row < count; ++row) {
        Random random(seed, 0, row);
        const auto symmetric = [&] { return 200 * random.uniform() - 100; };
        states.position.emplace_back(1000 + symmetric(), symmetric(), -500 + symmetric());
        states.velocity.emplace_back(random_normal(random), random_normal(random), random_normal(random));
        states.mass.push_back(0.5 + random.uniform());
        states.count.push_back(1 + row % 64);
        states.covariance.push_back({2.0F, 0.1F, -0.2F, 3.0F, 0.3F, 4.0F});
        states.id.push_back({.slot = {row}, .generation = row % 7});
        states.formation.push_back(1'000'000'000'000 + row);
        states.region.push_back(0);
    }
    return states;
}

/// The rows of all of them.
inline std::vector<std::uint32_t> all_rows(const ClusterStates& states)
{
    std::vector<std::uint32_t> rows(states.size());
    std::iota(rows.begin(), rows.end(), 0U);
    return rows;
}

/// A frame of such clusters. 60 frames per unit of scene time.
inline Snapshot made_up_snapshot(std::uint64_t frame, std::size_t clusters, std::uint64_t seed = 1)
{
    Snapshot snapshot;
    snapshot.frame = frame;
    snapshot.time = double(frame) / 60;
    snapshot.clusters = made_up_clusters(clusters, seed);
    snapshot.counts.clusters = clusters;
    for (const std::uint32_t count : snapshot.clusters.count)
        snapshot.counts.particles += count;
    snapshot.counts.born = 11;
    snapshot.counts.interactions = 12'345'678'901;
    snapshot.profile[Phase::Forces] = 4.5;
    snapshot.conserved.mass = 100;
    snapshot.conserved.kinetic_energy = 50 + double(frame);
    return snapshot;
}

inline Publisher::Session made_up_session()
{
    return {.scene_title = "made up",
            .units = {.length_m = 3.0857e19, .mass_kg = 1.989e40, .time_s = 3.0857e16},
            .time_step = 1.0 / 60,
            .particles = 123,
            .threads = 2,
            .isa = "baseline",
            .version = "0.0.1"};
}

} // namespace slod
