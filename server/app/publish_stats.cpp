#include "app/publish_stats.hpp"

#include <string_view>

#include "app/publish_fields.hpp"

namespace slod {

namespace {

slod_v1_ConservedQuantities conserved_message(const ConservedQuantities& quantities, double potential_energy)
{
    return {.mass = quantities.mass,
            .momentum = message_of(quantities.momentum),
            .angular_momentum = message_of(quantities.angular_momentum),
            .kinetic_energy = quantities.kinetic_energy,
            .potential_energy = potential_energy};
}

ConservedQuantities difference(const ConservedQuantities& now, const ConservedQuantities& before)
{
    return {.mass = now.mass - before.mass,
            .momentum = now.momentum - before.momentum,
            .angular_momentum = now.angular_momentum - before.angular_momentum,
            .kinetic_energy = now.kinetic_energy - before.kinetic_energy};
}

} // namespace

StatsEncoder::StatsEncoder(const wire::Uuid& session)
{
    wire::set(message_.session, session);
}

const wire::Stats& StatsEncoder::encode(const Snapshot& snapshot, const LoopStats& loop,
                                        const wire::PublisherCounts& published)
{
    stamp_next(message_, {.frame = snapshot.frame, .time = snapshot.time});
    message_.frame_rate_hz = loop.frame_rate_hz;
    message_.work_ms = loop.work_ms;
    message_.real_time_factor = loop.real_time_factor;
    message_.particles = snapshot.counts.particles;
    message_.clusters = snapshot.counts.clusters;
    encode_phases(snapshot.profile);
    encode_counts(snapshot.counts);
    encode_control(loop.regulation, snapshot.detail);
    message_.wire = published;
    return message_;
}

void StatsEncoder::encode_phases(const StepProfile& profile)
{
    phases_.resize(phase_count);
    for (std::size_t i = 0; i < phase_count; ++i) {
        wire::set(phases_[i].name, names(Phase{})[i]);
        phases_[i].ms = profile[Phase(i)];
    }
    wire::lend(message_.phases, phases_);
}

void StatsEncoder::encode_control(const ControlReport& regulation, const Detail& detail)
{
    slod_v1_ControlStats& control = message_.control;
    wire::set(control.mode, names(regulation.mode)[std::size_t(regulation.mode)]);
    wire::set(control.state, names(regulation.state)[std::size_t(regulation.state)]);
    control.target_ms = regulation.target_ms;
    control.decisions = regulation.decisions;
    control.cluster_size = detail.cluster_size;
    control.breadth = detail.breadth;
    control.opening = detail.opening;
    control.life = detail.life;
}

void StatsEncoder::encode_counts(const FrameCounts& counts)
{
    counts_.clear();
    const auto add = [this](std::string_view name, std::uint64_t count) {
        slod_v1_NamedCount& entry = counts_.emplace_back();
        wire::set(entry.name, name);
        entry.count = count;
    };
    add("pools", counts.pools);
    for_each_event(counts, add);
    wire::lend(message_.counts, counts_);
}

void StatsEncoder::set_conserved(const ConservedQuantities& now, double potential_energy)
{
    if (!is_measured(now))
        return;
    message_.conserved_measured = true;
    if (!first_conserved_) {
        first_conserved_ = now;
        first_potential_energy_ = potential_energy;
    }
    message_.conserved = conserved_message(now, potential_energy);
    message_.drift =
        conserved_message(difference(now, *first_conserved_), potential_energy - first_potential_energy_);
}

} // namespace slod
