#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "cluster/particles.hpp"
#include "core/tick.hpp"
#include "sim/error_meter.hpp"
#include "sim/plan.hpp"
#include "sim/settings.hpp"
#include "sim/snapshot.hpp"

namespace slod {

/// The simulation of one scene. Owns the clusters and the SLOD-tree; knows no file, thread, socket or
/// clock. Call it from one thread, inside ThreadTeam::run; the result does not depend on the team's size.
class Simulation {
public:
    struct Options {
        std::string_view isa; ///< instruction set of the kernels; empty: the fastest this processor runs
        Tick tick;            ///< empty: the profile stays 0
    };

    /// Forms clusters of `initial` and evaluates the first forces. `settings` must have no problems().
    Simulation(const SimulationSettings& settings, const ParticleSet& initial, const Options& options);
    ~Simulation();
    Simulation(Simulation&&) noexcept;

    /// What the caller wants in this frame's snapshot besides the counts; copying clusters costs O(clusters).
    struct Request {
        bool clusters = false;
        bool conserved = false;
        /// With the conserved quantities; over all pairs where there is gravity.
        bool potential_energy = false;
        /// Pairs of a particle and a member drawn that the error meter may sum up, and a block of some
        /// thousand particles more; 0: it rests. The outcome is the same.
        std::uint64_t error_pairs = 0;
    };

    /// A region of interest as it is. The last one of regions() is the background.
    struct Region {
        RegionRow row; ///< as in ClusterStates::region
        RegionOfInterest settings;
    };

    std::vector<Region> regions() const; ///< in order of precedence

    // Changes between frames; the next step has them. What is asked for wrongly is refused with a sentence
    // per problem, the key first, and changes nothing.
    Problems add_region(const RegionOfInterest& region);
    Problems change_region(const RegionOfInterest& region); ///< the one of its name, or the background
    Problems remove_region(std::string_view name);          ///< its clusters go to the others

    /// Takes new settings of effects, and which of them run. Values of gravity, uniform gravity, uniform
    /// wind and effects of place are taken as they are; for anything else a new plan is compiled, and all
    /// clusters are formed anew from their members: that takes as long as to start the scene with so many
    /// particles, and as much memory besides what is there. Emitters stay, though they can be switched off
    /// and on. What was handed out by reference before is not valid after it. Regions have functions of their
    /// own.
    Problems change_settings(const SimulationSettings& wanted);

    /// Makes all of the scene coarser or finer than it asks for, gradually, from the next step on. Refused
    /// where the scene was planned without clusters.
    Problems set_detail(const Detail& detail);
    const Detail& detail() const;

    /// One frame: one fixed time step. The snapshot is valid until the next call. Clusters that leave the
    /// range of numbers are taken out (Snapshot::quarantined). Throws std::overflow_error with a remedy when
    /// a member does within one frame's forming; the simulation is of no use then.
    const Snapshot& step(const Request& request);

    // What clusters and walks miss of the members' accelerations, measured as frames ask for it.
    ErrorEstimate error() const;                       ///< of a member that is as likely to be any
    std::vector<RegionError> region_errors() const;    ///< of the members of each region
    std::span<const ErrorSample> take_error_samples(); ///< of any members; valid until the next call of this
    void forget_errors();                              ///< as if nothing had been measured yet

    /// The present state, filled as requested, without a step.
    const Snapshot& snapshot(const Request& request);

    const Plan& plan() const;
    const SimulationSettings& settings() const;
    std::string_view isa() const; ///< of the kernels in use

    /// Covers what determines the particles at the frame's end: centres, velocities, maps, members, masses,
    /// ids, the region table, the level of detail and the random counters. Not what is derived of them for
    /// the next frame, such as accelerations and tides.
    std::uint64_t state_hash() const;

    /// Every particle, mapped out of its cluster, ordered by id. O(particles).
    ParticleSet particles() const;

    /// What is wrong with who is where: clusters in pools, pools in trees, members in clusters and in their
    /// sums, bodies in the force view; empty when nothing is. O(particles).
    Problems problems() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace slod
