#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/answer_memory.hpp"
#include "app/leases.hpp"
#include "app/requests.hpp"
#include "app/run_control.hpp"
#include "app/scene_editor.hpp"

namespace slod {

/// Decides what clients may do, and does it: every request is answered exactly once per time it comes, and
/// applied at most once. Knows no network, file or clock. Belongs to the simulation's thread.
class CommandDesk {
public:
    using Clock = std::chrono::steady_clock;

    struct Options {
        std::size_t max_clients = 256; ///< whose answers are remembered; more are refused for a while
        bool read_only = false;        ///< nothing that changes the outcome is applied: a replay
        LoopSettings loop{};           ///< at the start
    };

    CommandDesk(Simulation& simulation, const Options& options)
        : editor_(simulation), loop_(options.loop), memory_(options.max_clients),
          read_only_(options.read_only)
    {}

    /// Applies a request unless it was before, and answers it. `frame` is the first that will have it.
    Answer handle(const Request& request, std::uint64_t frame, Clock::time_point now);

    /// Keeps the view until the next frame, in place of the client's last.
    void see(const ClientView& view, Clock::time_point now);

    /// Moves the frustum regions that follow the views which came. A view that no frustum can have moves
    /// none.
    void follow_views(std::uint64_t frame);

    /// Removes the regions whose owners have been silent for longer than their lease.
    void expire_leases(std::uint64_t frame, Clock::time_point now);

    SceneEditor& editor() { return editor_; }
    const SceneEditor& editor() const { return editor_; }
    const LoopSettings& loop() const { return loop_; } ///< as they were set last
    RunControl& control() { return control_; }
    const RunControl& control() const { return control_; }

private:
    struct Kind;
    static const std::array<Kind, 12> kinds;

    Answer decide(const Request& request);
    Answer pause(const Request& request);
    Answer resume(const Request& request);
    Answer step(const Request& request);
    Answer stop(const Request& request);
    Answer keep_alive(const Request& request);
    Answer set(const Request& request);
    Answer add_roi(const Request& request);
    Answer move_roi(const Request& request);
    Answer resize_roi(const Request& request);
    Answer set_roi(const Request& request);
    Answer remove_roi(const Request& request);
    Answer checkpoint(const Request& request);

    Answer set_loop(const Request& request);
    /// Why the request may not touch the region it names; none when it may.
    std::optional<Answer> objection(const Request& request) const;
    Answer change(const Request& request, const std::vector<Assignment>& settings);
    Answer applied(const Request& request) const;

    SceneEditor editor_;
    LoopSettings loop_;
    RunControl control_;
    AnswerMemory memory_;
    Leases leases_;
    std::map<wire::Uuid, ClientView> views_; ///< by client, since the last frame
    bool read_only_;
    std::uint64_t frame_ = 0; ///< of the request in hand
    Clock::time_point now_{}; ///< likewise
};

} // namespace slod
