#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "app/command_desk.hpp"
#include "app/command_inbox.hpp"
#include "app/publisher.hpp"
#include "app/regulator.hpp"
#include "core/parallel.hpp"
#include "scene/server_settings.hpp"

namespace slod {

/// What happens to the simulation between frames: commands and views come in, a log is repeated, answers and
/// news go out. Belongs to the simulation's thread.
class Steering {
public:
    /// Told of every change, for the input log.
    using Record = std::function<void(const LoggedCommand&)>;

    struct Options {
        const WireSettings& wire;
        LoopSettings loop{};               ///< at the start
        std::vector<LoggedCommand> replay; ///< of a log, by frame
        bool replaying = false;            ///< clients may change nothing
        bool paced = true;                 ///< there is a frame rate, which a controller may hold
        Record record;                     ///< may be empty
    };

    /// `publisher` may be null: nobody commands. Both must outlive the steering. Throws wire::DdsError.
    Steering(Simulation& simulation, Publisher* publisher, Options options);

    /// Makes the changes that `frame`, the next to run, is to have. `team` runs what is parallel in them.
    void prepare(std::uint64_t frame, ThreadTeam& team);

    /// Moves what follows clients' views, right before `frame` runs: however often commands are looked for,
    /// and however long the loop pauses, a view makes one change.
    void follow_views(std::uint64_t frame, ThreadTeam& team);

    /// Tells the controller, if there is one, of a frame that worked for so long and of errors measured in
    /// it.
    void add_work(const Snapshot& snapshot, double work_ms, std::span<const ErrorSample> errors)
    {
        regulator_.add(snapshot, work_ms, errors);
    }

    /// Sets the detail that the controller decided on, right before `frame` runs.
    void regulate(std::uint64_t frame, ThreadTeam& team);

    const LoopSettings& loop() const { return desk_.loop(); } ///< as they were set last
    std::uint64_t effect_changes() const { return desk_.editor().effect_changes(); } ///< so far
    ControlReport regulation() const { return regulator_.report(); }

    /// Makes the changes that a log has of `frame`, which did not run: the recorded run was stopped after
    /// them.
    void repeat_rest(std::uint64_t frame, ThreadTeam& team);

    RunControl& control() { return desk_.control(); }
    const RunControl& control() const { return desk_.control(); }

private:
    void repeat_log(std::uint64_t frame);
    void take_commands(std::uint64_t frame);
    void record_changes();
    void tell();

    Simulation& simulation_;
    bool regulating_; ///< a controller may decide
    Publisher* publisher_;
    std::size_t max_commands_;
    std::vector<LoggedCommand> replay_;
    std::size_t repeated_ = 0; ///< of the log's commands
    Record record_;
    CommandDesk desk_;
    Regulator regulator_;
    std::optional<CommandInbox> inbox_;
    std::vector<Answer> answers_;
};

} // namespace slod
