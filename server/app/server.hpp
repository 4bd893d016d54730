#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>

#include "app/alarms.hpp"
#include "app/job.hpp"
#include "app/loop_meter.hpp"
#include "app/meter_budget.hpp"
#include "app/publisher.hpp"
#include "app/run_summary.hpp"
#include "app/status.hpp"
#include "app/steering.hpp"
#include "app/trace.hpp"
#include "core/parallel.hpp"
#include "sim/simulation.hpp"

namespace slod {

/// Runs one scene frame by frame. The thread that calls it owns the simulation; the publisher has a thread
/// of its own and never delays a frame. Members are destroyed bottom-up: no more commands are taken,
/// publishing stops, then the state goes.
class Server {
public:
    /// Told once a second, between frames, how the run goes.
    using EachSecond = std::function<void(const RunStatus&)>;

    /// Told after each frame what it took.
    using EachFrame = std::function<void(const Snapshot&, const FrameTime&, const ControlReport&)>;

    /// Who is told of what.
    struct Listeners {
        EachSecond each_second;
        EachFrame each_frame{};    ///< may be empty
        Steering::Record record{}; ///< may be empty
    };

    /// Forms the first clusters of the job's particles, which it takes, and opens the wire if the scene asks
    /// for it. Throws std::runtime_error when the wire or the instruction set is not to be had.
    Server(Job& job, bool free_run, Listeners listeners);

    /// Runs to the last frame, or to the end of the frame in which stop is requested. Throws
    /// std::runtime_error when a log cannot be repeated.
    RunSummary run(const std::stop_token& stop);

    const Simulation& simulation() const { return *simulation_; }
    int threads() const { return threads_; }

private:
    /// Takes what came in between frames; then waits for the next one's time, if there is one, taking on. A
    /// pause is no part of what the meter measures.
    void wait_for_frame(Pacer& pacer, LoopMeter& meter, const RunSummary& summary,
                        const std::stop_token& stop);

    bool ended(const RunSummary& summary, const std::stop_token& stop) const;

    /// One frame and its publication; adds it to `summary`.
    void run_frame(LoopMeter& meter, RunSummary& summary);

    /// Has the errors that are known now published.
    void report_errors(const MeterSettings& metering, const ControlReport& regulation);
    void report_effects(const Snapshot& snapshot);

    /// What the publisher spent on a frame since the last call, if it encoded one.
    double encoding_ms();

    /// Says in the log which alarms came and went, and has them published.
    void log_alarms();
    void log_quarantined();

    Alarms::Start measure_conserved();

    std::uint64_t frames_; ///< to run; 0: until stopped
    bool free_run_;        ///< no waiting between frames
    double frame_s_;       ///< simulated time of a frame, SI
    EachSecond each_second_;
    EachFrame each_frame_;
    int threads_;
    ThreadTeam team_;
    std::optional<Simulation> simulation_;
    std::optional<Publisher> publisher_;
    std::optional<Steering> steering_;
    MeterBudget meter_budget_;
    std::shared_ptr<const ErrorReport> errors_;   ///< to be published
    std::shared_ptr<const EffectReport> effects_; ///< likewise
    std::optional<Alarms> alarms_;
    std::vector<Alarm> logged_alarms_; ///< as they were last told
    Quarantined taken_out_;            ///< since the log last had them
    std::uint64_t effects_known_ = 0;  ///< changes of effects that drifts begin after
    Pacer::Clock::time_point start_{}; ///< of the run
    std::uint64_t frames_encoded_ = 0; ///< by the publisher, when that was last asked
    bool new_second_ = true;           ///< the next frame is the first of a second
};

} // namespace slod
