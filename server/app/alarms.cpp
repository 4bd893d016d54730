#include "app/alarms.hpp"

#include <algorithm>
#include <cmath>

#include <spdlog/fmt/fmt.h>

#include "app/run_summary.hpp"

namespace slod {
namespace {

constexpr int looks_to_forget = 5;

std::string percent(double share)
{
    return fmt::format("{:.3g} %", 100 * share);
}

} // namespace

void Alarms::add(const Snapshot& frame, double step)
{
    ++frames_;
    last_frame_ = frame.frame;
    particle_frames_ += double(frame.counts.particles);
    add_events(events_, frame.counts);
    quarantined_ += frame.quarantined;
    dropped_momentum_ += step * frame.unanswered_force.norm();
    if (frame.conserved.mass == 0 && frame.conserved.kinetic_energy == 0)
        return; // it was not asked for
    now_ = frame.conserved;
    if (std::isfinite(frame.potential_energy))
        energy_ = frame.conserved.kinetic_energy + frame.potential_energy;
}

bool Alarms::look(const AlarmSettings& limits, const ControlReport& regulation)
{
    using enum AlarmSeverity;
    changed_ = false;
    const Drift drifts = now_ ? drift(start_.conserved, *now_) : Drift{};
    const double largest = std::sqrt(2 * start_.conserved.mass * start_.conserved.kinetic_energy);
    weigh("quarantined", Error, weigh_quarantine(limits.quarantined));
    weigh("under_resolved", Warning, weigh_steps(limits.under_resolved));
    weigh("energy_drift", Warning, weigh_energy(limits.energy_drift));
    weigh("momentum_drift", Warning, weigh_drift("momentum", drifts.momentum, limits.momentum_drift));
    weigh("angular_momentum_drift", Warning,
          weigh_drift("angular momentum", drifts.angular_momentum, limits.angular_momentum_drift));
    weigh("dropped_momentum", Warning,
          weigh_drift("momentum, by regions that do not attract others,",
                      largest > 0 ? dropped_momentum_ / largest : 0, limits.dropped_momentum));
    weigh("reformed", Warning, weigh_reforming(limits.reformed));
    weigh("births_refused", Warning,
          {events_.births_refused,
           events_.births_refused > 0
               ? fmt::format(
                     "{} particles were not emitted, as there are limits.max_particles; raise that, or emit "
                     "less.",
                     events_.births_refused)
               : ""});
    weigh("impacts_cut_off", Warning,
          {events_.impacts_cut_off,
           events_.impacts_cut_off > 0
               ? fmt::format(
                     "{} flights had more impacts in a frame than are followed, and end on a surface; use a "
                     "smaller time.step.",
                     events_.impacts_cut_off)
               : ""});
    weigh("unreachable", Warning,
          {1, regulation.state == ControlState::Unreachable
                  ? "The frame rate or error asked for is out of reach; ask for less, or widen what "
                    "[control] may turn."
                  : ""});
    frames_ = 0;
    particle_frames_ = 0;
    events_ = {};
    return changed_;
}

/// Raises the alarm, keeps it up to date, or takes it back.
void Alarms::weigh(std::string_view name, AlarmSeverity severity, const Finding& finding)
{
    const auto known = std::find_if(present_.begin(), present_.end(),
                                    [&](const Alarm& alarm) { return alarm.name == name; });
    if (finding.text.empty()) {
        if (known == present_.end())
            return;
        const auto row = raised_.begin() + (known - present_.begin());
        if (++row->quiet_looks < looks_to_forget)
            return;
        raised_.erase(row);
        present_.erase(known);
        changed_ = true;
        return;
    }
    Alarm fresh;
    fresh.name = name;
    fresh.first_frame = last_frame_;
    const Alarm before = known != present_.end() ? *known : fresh;
    Alarm now = before;
    now.severity = severity;
    now.last_frame = last_frame_;
    now.occurrences += finding.occurrences;
    now.text = finding.text;
    if (known == present_.end()) {
        present_.push_back(now);
        raised_.emplace_back();
    } else {
        *known = now;
        raised_[std::size_t(known - present_.begin())].quiet_looks = 0;
    }
    changed_ = changed_ || !(now == before);
}

Alarms::Finding Alarms::weigh_energy(double limit) const
{
    const double before = start_.conserved.kinetic_energy + start_.potential_energy;
    if (!energy_ || !std::isfinite(before) || before == 0)
        return {};
    return weigh_drift("energy", (*energy_ - before) / std::abs(before), limit);
}

Alarms::Finding Alarms::weigh_drift(std::string_view what, double drift, double limit) const
{
    if (!(std::abs(drift) > limit))
        return {};
    return {1, fmt::format(
                   "The {} has changed by {} since the start, more than {}; use a smaller time.step, more "
                   "time.max_substeps, or finer forces.",
                   what, percent(drift), percent(limit))};
}

Alarms::Finding Alarms::weigh_steps(double limit) const
{
    const std::uint64_t flagged = events_.under_resolved;
    if (frames_ == 0 || !(double(flagged) > limit * double(frames_)))
        return {};
    return {flagged,
            fmt::format("{} of {} frames needed more sub-steps; raise time.max_substeps, or use a smaller "
                        "time.step or a larger softening.",
                        flagged, frames_)};
}

Alarms::Finding Alarms::weigh_reforming(double limit) const
{
    const double share = particle_frames_ > 0 ? double(events_.reformed_members) / particle_frames_ : 0;
    if (!(share > limit))
        return {};
    return {1,
            fmt::format(
                "{} of all particles are formed anew in a frame, more than {}; raise motion.clock, or use a "
                "smaller time.step.",
                percent(share), percent(limit))};
}

Alarms::Finding Alarms::weigh_quarantine(double limit) const
{
    if (!(double(quarantined_.particles) > limit))
        return {};
    std::string ids;
    for (const std::uint64_t id : quarantined_.ids)
        ids += (ids.empty() ? "" : ", ") + std::to_string(id);
    return {events_.quarantined,
            fmt::format(
                "{} particles left the range of numbers and were taken out, {} {}; use a smaller time.step, "
                "weaker forces or a larger softening.",
                quarantined_.particles,
                quarantined_.particles > quarantined_.ids.size() ? "the first" : "their ids", ids)};
}

} // namespace slod
