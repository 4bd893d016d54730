#pragma once

#include <span>
#include <string>

#include "app/alarm.hpp"
#include "app/log.hpp"
#include "app/loop_meter.hpp"
#include "control/controller.hpp"
#include "meter/error_window.hpp"
#include "sim/plan.hpp"
#include "sim/snapshot.hpp"

namespace slod {

/// How a run goes, at the end of a second.
struct RunStatus {
    const Snapshot& snapshot;
    const LoopMeans& means;
    const Plan& plan;
    ControlReport regulation{};
    ErrorEstimate error{}; ///< of accelerations
    std::span<const Alarm> alarms{};
};

/// One line for people: frame, rates, sizes, the error with its interval, and the milliseconds of the longest
/// phases, longest first.
std::string status_line(const RunStatus& status);

/// The same as key=value, for a log.
std::string status_record(const RunStatus& status);

/// Shows how the run goes: on a terminal every second in place, elsewhere a log line every few seconds.
class StatusDisplay {
public:
    /// `logging` must outlive the display.
    explicit StatusDisplay(Logging& logging) : logging_(logging) {}

    /// To be called once a second.
    void update(const RunStatus& status);

private:
    Logging& logging_;
    int seconds_ = 0;
};

} // namespace slod
