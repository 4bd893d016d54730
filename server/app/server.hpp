#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>

#include "app/loop_meter.hpp"
#include "app/publisher.hpp"
#include "app/run_summary.hpp"
#include "core/parallel.hpp"
#include "scene/scene.hpp"
#include "sim/simulation.hpp"

namespace slod {

/// Runs one scene frame by frame. The thread that calls it owns the simulation; the publisher has a thread
/// of its own and never delays a frame. Members are destroyed bottom-up: publishing stops, then the state
/// goes.
class Server {
public:
    /// How long and how fast to run.
    struct Pace {
        std::uint64_t frames = 0; ///< 0: until stopped
        bool free_run = false;    ///< no waiting between frames
    };

    /// Told once a second, between frames, how the run goes.
    using EachSecond = std::function<void(const Snapshot&, const LoopMeans&, const Plan&)>;

    /// Forms the first clusters of `initial` and opens the wire if the scene asks for it. Throws
    /// std::runtime_error when the wire or the instruction set is not to be had.
    Server(const Scene& scene, ParticleSet initial, Pace pace, EachSecond each_second);

    /// Runs to the last frame, or to the end of the frame in which stop is requested.
    RunSummary run(const std::stop_token& stop);

    const Simulation& simulation() const { return *simulation_; }
    int threads() const { return threads_; }

private:
    /// One frame and its publication; adds it to `summary`.
    void run_frame(LoopMeter& meter, RunSummary& summary);

    ConservedQuantities measure_conserved();

    Pace pace_;
    double frame_rate_hz_; ///< that the pacer holds
    double frame_s_;       ///< simulated time of a frame, SI
    EachSecond each_second_;
    int threads_;
    ThreadTeam team_;
    std::optional<Simulation> simulation_;
    std::optional<Publisher> publisher_;
    bool new_second_ = true; ///< the next frame is the first of a second
};

} // namespace slod
