#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/alarm.hpp"
#include "app/requests.hpp"
#include "control/controller.hpp"
#include "meter/error_window.hpp"
#include "scene/server_settings.hpp"
#include "sim/plan.hpp"
#include "sim/settings.hpp"
#include "sim/snapshot.hpp"

namespace slod::wire {
class Participant;
}

namespace slod {

/// What is known of the errors of accelerations.
struct ErrorReport {
    ErrorEstimate all;                            ///< of any particle
    std::map<std::string, ErrorEstimate> regions; ///< of the particles of each, by name
    double target = 0;                            ///< median that is held for all; 0: none
};

/// What the effects did in a frame.
struct EffectReport {
    struct Entry {
        PlannedEffect effect;
        EffectWork work;
    };
    std::uint64_t frame = 0;
    std::vector<Entry> effects; ///< all that the program knows
};

/// How the server's loop goes, as means over about the last second.
struct LoopStats {
    double frame_rate_hz;
    double work_ms;                                ///< of a frame, without the wait for the next
    double real_time_factor;                       ///< scene time, in SI seconds, per second of wall time
    double frame_rate_target_hz = 0;               ///< that the loop paces itself to; 0: as fast as it goes
    ControlReport regulation{};                    ///< at the frame's start
    std::shared_ptr<const ErrorReport> errors{};   ///< the newest; null: they are not measured
    std::shared_ptr<const EffectReport> effects{}; ///< the newest; null: nobody reads it
};

/// Publishes frames, statistics and the server's sign of life over DDS, on a thread of its own. The loop
/// hands frames in; whatever the network and the clients do, it never waits. All functions but the
/// constructor are called by the loop's thread alone.
class Publisher {
public:
    /// What clients are told about the server and its scene.
    struct Session {
        std::string scene_title;
        Units units;
        double time_step; ///< scene time per frame
        std::uint64_t particles;
        int threads;
        std::string isa;
        std::string version;
    };

    /// What was done since the start.
    struct Counters {
        std::uint64_t frames_offered = 0;   ///< with or without clusters
        std::uint64_t frames_published = 0; ///< whose clusters or overview were written
        std::uint64_t frames_skipped = 0;  ///< whose clusters a newer frame replaced before they were encoded
        std::uint64_t frames_delayed = 0;  ///< whose hand-over waited for 10 ms or more
        std::uint64_t samples_refused = 0; ///< by DDS, of any topic
        std::uint64_t bytes = 0;           ///< of all samples, once per sample whatever the number of readers
        double encode_ms = 0;              ///< processor time to encode and write the last frame
    };

    /// Joins the domain and announces the session. Throws std::runtime_error with a remedy when it cannot.
    Publisher(const WireSettings& settings, const Session& session);

    /// Takes leave of the clients.
    ~Publisher();

    /// Whether the next snapshot should have clusters: somebody reads them or the overview, and by the rates
    /// in the settings a frame is due.
    bool clusters_wanted() const;

    bool errors_wanted() const;  ///< Whether somebody reads errors.
    bool effects_wanted() const; ///< Whether somebody reads effects.

    /// Copies the frame into a slot that holds the newest one, and returns.
    void offer(const Snapshot& snapshot, const LoopStats& loop);

    /// Sends answers and news of regions, and whether the loop is paused, ahead of every later frame. Nothing
    /// of it is lost; what was said last of a region holds.
    void tell(std::vector<Answer>&& answers, std::vector<RegionRecord>&& regions, bool paused);

    /// Sends the alarms that there are now, likewise: also while the loop is paused.
    void tell(std::vector<Alarm>&& alarms);

    /// How many answers it takes at present: bounded, should the publisher's thread be held up.
    std::size_t answer_room() const;

    Counters counters() const;

    /// For readers of this server's own.
    const wire::Participant& participant() const;
    const wire::Uuid& session() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
    bool paused_ = false; ///< as was last told
};

} // namespace slod
