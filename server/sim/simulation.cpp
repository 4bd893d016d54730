#include "sim/simulation.hpp"

#include <algorithm>

#include "core/assert.hpp"
#include "core/parallel.hpp"
#include "sim/state.hpp"
#include "sim/state_hash.hpp"

namespace slod {

Simulation::Simulation(const SimulationSettings& settings, const ParticleSet& initial, const Options& options)
    : state_(std::make_unique<State>(settings, initial, options))
{}

Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;

const Snapshot& Simulation::step(const Request& request)
{
    const FlushDenormals flush;
    State& s = *state_;
    s.snapshot.profile = {};
    s.snapshot.counts = {};
    s.snapshot.effects = {};
    s.snapshot.quarantined = {};
    //                                                      reads                   writes
    s.run(Phase::Commands, [&] { s.open(request); }); // slabs, regions       -> pool, tree, tides, frame
    while (s.begin_substep()) {
        s.run(Phase::OpenKick, [&] { s.kick(); }); // as below, for each sub-step but the last
        s.run(Phase::Propagate, [&] { s.propagate(); });
        s.run(Phase::Moments, [&] { s.measure_moments(); });
        s.run(Phase::Forces, [&] { s.evaluate_forces(); });
        s.run(Phase::CloseKick, [&] { s.kick(); });
    }
    s.run(Phase::OpenKick, [&] { s.kick(); });           // accelerations, tides -> velocities, maps
    s.run(Phase::Propagate, [&] { s.propagate(); });     // velocities, maps     -> positions, maps
    s.run(Phase::Expire, [&] { s.expire(); });           // ages, sinks          -> clusters, members
    s.run(Phase::Emit, [&] { s.emit(); });               // emitters, sinks      -> clusters, members
    s.run(Phase::Update, [&] { s.update(); });           // positions, shapes    -> tree, clusters, members
    s.run(Phase::Moments, [&] { s.measure_moments(); }); // clusters, tree       -> variances, force view
    s.run(Phase::Forces, [&] { s.evaluate_forces(); });  // force view           -> accelerations, tides
    s.run(Phase::CloseKick, [&] { s.close_kick(); });    // accelerations, tides -> velocities, maps
    s.run(Phase::Snapshot, [&] { s.observe(request); }); // clusters             -> snapshot
    s.run(Phase::Meter, [&] { s.sample(request); });     // clusters, members    -> errors
    if constexpr (validating)
        require_none(s.problems());
    return s.snapshot;
}

const Snapshot& Simulation::snapshot(const Request& request)
{
    state_->observe(request);
    return state_->snapshot;
}

const Plan& Simulation::plan() const
{
    return state_->plan;
}

const SimulationSettings& Simulation::settings() const
{
    return state_->asked;
}

const Detail& Simulation::detail() const
{
    return state_->tree.detail;
}

std::string_view Simulation::isa() const
{
    return state_->kernels->name;
}

std::uint64_t Simulation::state_hash() const
{
    const State& s = *state_;
    const auto counters = s.emission.counts_before(double(s.frame) * s.settings.time.step);
    return hash_state(s.store, s.tree, {s.frame, counters, s.emission.cohorts()});
}

ParticleSet Simulation::particles() const
{
    const State& s = *state_;
    ParticleSet all(s.particle_count);
    std::size_t first = 0;
    for (std::uint32_t slot = 0; slot < s.store.clusters.slot_count(); ++slot) {
        const std::uint32_t count = s.store.clusters.count[slot];
        if (count > 0)
            map_out(s.store, {slot}, s.frame, std::span(all).subspan(first, count));
        first += count;
    }
    std::sort(all.begin(), all.end(), [](const Particle& a, const Particle& b) { return a.id < b.id; });
    return all;
}

Problems Simulation::problems() const
{
    return state_->problems();
}

} // namespace slod
