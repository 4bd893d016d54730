#include "app/alarms.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <spdlog/fmt/fmt.h>

#include "app/publish_fields.hpp"
#include "app/run_summary.hpp"

namespace slod {
namespace {

constexpr int looks_to_forget = 5;

std::string percent(double share)
{
    return fmt::format("{:.3g} %", 100 * share);
}

std::string drift_text(std::string_view what, double drift, double limit)
{
    if (!(std::abs(drift) > limit))
        return {};
    return fmt::format(
        "The {} has changed by {} since the start, more than {}; use a smaller time.step, more "
        "time.max_substeps, or finer forces.",
        what, percent(drift), percent(limit));
}

} // namespace

void Alarms::begin_anew(const Start& start)
{
    start_ = start;
    now_ = start.conserved;
    energy_ = start.conserved.kinetic_energy + start.potential_energy;
    largest_momentum_ = std::sqrt(2 * now_.mass * now_.kinetic_energy);
    dropped_momentum_ = 0;
}

void Alarms::add(const Snapshot& frame, double step)
{
    ++frames_;
    last_frame_ = frame.frame;
    particle_frames_ += double(frame.counts.particles);
    add_events(events_, frame.counts);
    quarantined_ += frame.quarantined;
    dropped_momentum_ += step * frame.unanswered_force.norm();
    if (!is_measured(frame.conserved))
        return;
    now_ = frame.conserved;
    largest_momentum_ = std::max(largest_momentum_, std::sqrt(2 * now_.mass * now_.kinetic_energy));
    if (std::isfinite(frame.potential_energy))
        energy_ = frame.conserved.kinetic_energy + frame.potential_energy;
}

bool Alarms::look(const AlarmSettings& limits, const ControlReport& regulation)
{
    weigh_all(limits, regulation);
    frames_ = 0;
    particle_frames_ = 0;
    events_ = {};
    return changed_;
}

void Alarms::look_at_end(const Start& end, const AlarmSettings& limits, const ControlReport& regulation)
{
    now_ = end.conserved;
    if (std::isfinite(end.potential_energy))
        energy_ = end.conserved.kinetic_energy + end.potential_energy;
    ending_ = true;
    weigh_all(limits, regulation);
}

void Alarms::weigh_all(const AlarmSettings& limits, const ControlReport& regulation)
{
    using enum AlarmSeverity;
    changed_ = false;
    weigh("quarantined", Error, weigh_quarantine(limits.quarantined));
    weigh("under_resolved", Warning, weigh_steps(limits.under_resolved));
    weigh("energy_drift", Warning, {1, drift_text("energy", energy_drift(), limits.energy_drift)});
    weigh("momentum_drift", Warning, {1, drift_text("momentum", momentum_drift(), limits.momentum_drift)});
    weigh("angular_momentum_drift", Warning,
          {1, drift_text("angular momentum", angular_momentum_drift(), limits.angular_momentum_drift)});
    weigh("dropped_momentum", Warning, weigh_dropped(limits.dropped_momentum));
    weigh("reformed", Warning, weigh_reforming(limits.reformed));
    weigh("worn_maps", Warning, weigh_maps(limits.worn_maps));
    weigh("births_refused", Warning,
          counted(events_.births_refused,
                  "particles were not emitted, as there are limits.max_particles; raise "
                  "that, or emit less."));
    weigh("impacts_cut_off", Warning,
          counted(events_.impacts_cut_off,
                  "flights had more impacts in a frame than are followed, and ended on "
                  "a surface. That is right where they rest in a corner; where they fly "
                  "between surfaces, use a smaller time.step."));
    const bool unreachable = regulation.state == ControlState::Unreachable;
    weigh("unreachable", Warning,
          {1, unreachable ? "The frame rate or error asked for is out of reach; ask for less, or widen what "
                            "[control] may turn."
                          : ""});
}

/// What is so as soon as it happens once: "7 particles were not emitted".
Alarms::Finding Alarms::counted(std::uint64_t events, std::string_view what)
{
    return {events, events > 0 ? fmt::format("{} {}", events, what) : ""};
}

/// Raises the alarm, keeps it up to date, or takes it back.
void Alarms::weigh(std::string_view name, AlarmSeverity severity, const Finding& finding)
{
    const auto known = std::find_if(present_.begin(), present_.end(),
                                    [&](const Alarm& alarm) { return alarm.name == name; });
    const auto row = known - present_.begin();
    if (finding.text.empty()) {
        if (known == present_.end() || ending_ || ++quiet_looks_[std::size_t(row)] < looks_to_forget)
            return;
        std::erase_if(past_, [&](const Alarm& alarm) { return alarm.name == name; });
        past_.push_back(*known);
        present_.erase(known);
        quiet_looks_.erase(quiet_looks_.begin() + row);
        changed_ = true;
        return;
    }
    if (known == present_.end()) {
        present_.push_back({name, severity, last_frame_, last_frame_, finding.occurrences, finding.text});
        quiet_looks_.push_back(0);
        changed_ = true;
        return;
    }
    quiet_looks_[std::size_t(row)] = 0;
    if (finding.occurrences == 0)
        return; // it is still so, and nothing new
    known->last_frame = last_frame_;
    known->occurrences += finding.occurrences;
    known->text = finding.text;
    changed_ = true;
}

std::vector<std::string_view> Alarms::unwatched(const AlarmSettings& limits) const
{
    std::vector<std::string_view> found;
    const auto check = [&](std::string_view name, double limit, double drift) {
        if (std::isfinite(limit) && std::isnan(drift))
            found.push_back(name);
    };
    check("energy_drift", limits.energy_drift, energy_drift());
    check("angular_momentum_drift", limits.angular_momentum_drift, angular_momentum_drift());
    return found;
}

double Alarms::energy_drift() const
{
    const double before = start_.conserved.kinetic_energy + start_.potential_energy;
    return before != 0 ? (energy_ - before) / std::abs(before) : std::numeric_limits<double>::quiet_NaN();
}

/// What starts at rest has its scale from what it comes to.
double Alarms::momentum_drift() const
{
    const double change = (now_.momentum - start_.conserved.momentum).norm();
    return largest_momentum_ > 0 ? change / largest_momentum_ : 0;
}

double Alarms::angular_momentum_drift() const
{
    return drift(start_.conserved, now_).angular_momentum;
}

Alarms::Finding Alarms::weigh_dropped(double limit) const
{
    const double share = largest_momentum_ > 0 ? dropped_momentum_ / largest_momentum_ : 0;
    if (!(share > limit))
        return {};
    return {
        1, fmt::format("Regions that do not attract others brought in {} of the largest momentum there could "
                       "be, more than {}; use attracts = \"everything\", or make what is in them lighter.",
                       percent(share), percent(limit))};
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
    return {1, fmt::format("{} of all particles are formed anew in a frame, more than {}; raise "
                           "motion.clock, or use a smaller time.step.",
                           percent(share), percent(limit))};
}

Alarms::Finding Alarms::weigh_maps(double limit) const
{
    const std::uint64_t worn = events_.worn_pools;
    if (!(double(worn) > limit * double(events_.due_pools)))
        return {};
    return {worn,
            fmt::format("{} of {} lives of pools ended early, as flow maps had stretched eightfold; use "
                        "a smaller time.step or motion.clock, or a larger softening.",
                        worn, events_.due_pools)};
}

Alarms::Finding Alarms::weigh_quarantine(double limit) const
{
    if (!(double(quarantined_.particles) > limit))
        return {};
    const bool some = quarantined_.particles > quarantined_.ids().size();
    return {events_.quarantined,
            fmt::format("{} particles left the range of numbers and were taken out; use a smaller time.step, "
                        "weaker forces or a larger softening. {} {}.",
                        quarantined_.particles,
                        some ? "The first ids:" : "Ids:", fmt::join(quarantined_.ids(), ", "))};
}

} // namespace slod
