#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/alarm.hpp"
#include "control/controller.hpp"
#include "scene/server_settings.hpp"
#include "sim/snapshot.hpp"

namespace slod {

/// Raises alarms from what frames say, and takes those back that have not been so for five looks. Knows no
/// clock: the caller looks once a second.
class Alarms {
public:
    /// `start`: what the run began with, for the drifts from it. The settings' limits of drifts count for
    /// scenes that conserve them.
    struct Start {
        ConservedQuantities conserved;
        double potential_energy = 0;
    };
    explicit Alarms(const Start& start) : start_(start) {}

    /// Takes in a frame.
    void add(const Snapshot& frame, double step);

    /// Weighs what frames since the last look said. True: some alarm came, went or says something else.
    bool look(const AlarmSettings& limits, const ControlReport& regulation);

    const std::vector<Alarm>& present() const { return present_; } ///< in order of their raising

private:
    /// What makes an alarm at one look; no text: it is not so.
    struct Finding {
        std::uint64_t occurrences = 1;
        std::string text;
    };
    void weigh(std::string_view name, AlarmSeverity severity, const Finding& finding);
    Finding weigh_energy(double limit) const;
    Finding weigh_drift(std::string_view what, double drift, double limit) const;
    Finding weigh_steps(double limit) const;
    Finding weigh_reforming(double limit) const;
    Finding weigh_quarantine(double limit) const;

    struct Raised {
        int quiet_looks = 0;
    };

    Start start_;
    std::optional<ConservedQuantities> now_; ///< when last measured
    std::optional<double> energy_;           ///< likewise
    double dropped_momentum_ = 0; ///< length of what came in without an answer, summed up over frames
    Quarantined quarantined_;     ///< since the start
    // Since the last look.
    std::uint64_t frames_ = 0, last_frame_ = 0;
    double particle_frames_ = 0;
    FrameCounts events_;
    std::vector<Alarm> present_;
    std::vector<Raised> raised_; ///< beside present_
    bool changed_ = false;
};

} // namespace slod
