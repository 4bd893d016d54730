#pragma once

#include <cstdint>
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
    /// What drifts are measured from.
    struct Start {
        ConservedQuantities conserved;
        double potential_energy = 0; ///< NaN: it is not known, and energy is not watched
    };
    explicit Alarms(const Start& start) { begin_anew(start); }

    /// Measures drifts from here on: effects have changed, or particles were taken out.
    void begin_anew(const Start& start);

    /// Takes in a frame.
    void add(const Snapshot& frame, double step);

    /// Weighs what frames since the last look said. True: some alarm came, went or says something else.
    bool look(const AlarmSettings& limits, const ControlReport& regulation);

    /// Weighs the run's end, which takes nothing back.
    void look_at_end(const Start& end, const AlarmSettings& limits, const ControlReport& regulation);

    const std::vector<Alarm>& present() const { return present_; } ///< in order of their raising
    const std::vector<Alarm>& past() const { return past_; }       ///< that are over, as they were last

    /// Finite limits of quantities that nothing can be said of.
    std::vector<std::string_view> unwatched(const AlarmSettings& limits) const;

private:
    /// What makes an alarm at one look; no text: it is not so.
    struct Finding {
        std::uint64_t occurrences = 1;
        std::string text{};
    };
    static Finding counted(std::uint64_t events, std::string_view what);
    void weigh(std::string_view name, AlarmSeverity severity, const Finding& finding);
    void weigh_all(const AlarmSettings& limits, const ControlReport& regulation);
    double energy_drift() const;
    double momentum_drift() const;
    double angular_momentum_drift() const;
    Finding weigh_steps(double limit) const;
    Finding weigh_reforming(double limit) const;
    Finding weigh_maps(double limit) const;
    Finding weigh_quarantine(double limit) const;
    Finding weigh_dropped(double limit) const;

    Start start_;
    ConservedQuantities now_;     ///< when last measured
    double energy_ = 0;           ///< likewise; NaN: it never was
    double largest_momentum_ = 0; ///< that there could have been, of so much mass and kinetic energy
    double dropped_momentum_ = 0; ///< length of what came in without a reaction, summed up over frames
    Quarantined quarantined_;     ///< since the run's start
    // Since the last look.
    std::uint64_t frames_ = 0, last_frame_ = 0;
    double particle_frames_ = 0;
    FrameCounts events_;
    bool ending_ = false; ///< nothing is taken back
    std::vector<Alarm> present_, past_;
    std::vector<int> quiet_looks_; ///< of present_
    bool changed_ = false;
};

} // namespace slod
