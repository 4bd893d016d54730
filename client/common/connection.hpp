#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <stop_token>
#include <string>

#include "common/frame_assembler.hpp"
#include "common/messages.hpp"
#include "common/server_watch.hpp"
#include "common/stream_meter.hpp"
#include "idl/dds.hpp"

namespace slod::client {

/// What a client reads besides the server's state. What it does not read the server does not send, nor,
/// when nobody does, compute.
struct Subscription {
    bool stats = false;
    bool clusters = false;
    bool overview = false;
    bool errors = false;
    bool effects = false;
    bool regions = false;
    std::string region{};                         ///< of the clusters; empty: all
    wire::Repair repair = wire::Repair::AskAgain; ///< of the clusters
};

/// A client's end of the wire: the server that is followed, and the newest of everything subscribed to.
/// Call it from one thread. What it hands out is valid until the next poll() or wait().
class Connection {
public:
    /// Throws wire::DdsError with a remedy when the domain cannot be joined.
    Connection(std::uint32_t domain, wire::Profile profile, const Subscription& subscription);

    /// Takes in what has arrived.
    void poll();

    /// Waits until something arrives, `timeout` passes or stop is requested; then takes it in.
    void wait(const std::stop_token& stop, std::chrono::nanoseconds timeout);

    Status status() const;

    /// The server that is followed, as it last said; null when there never was one.
    const ServerInfo* server() const { return watch_.server(); }
    std::size_t other_servers() const { return watch_.others(); }

    /// Null before the first sample of the present session.
    const ServerStats* stats() const { return stats_ ? &*stats_ : nullptr; }
    const OverviewNodes* overview() const { return overview_ ? &*overview_ : nullptr; }
    using Errors = std::map<std::string, MeasuredError>; ///< by region; "": of all particles
    const Errors& errors() const { return errors_; }     ///< empty: they are not measured, or not yet
    const MeasuredError* error() const;                  ///< of all particles; null likewise
    using Effects = std::map<std::string, EffectInfo>;   ///< by name
    const Effects& effects() const { return effects_; }  ///< empty: not told yet
    using Regions = std::map<std::string, RegionInfo>;   ///< by name
    const Regions& regions() const;

    /// Whether as many regions are known as the server last said it has.
    bool knows_all_regions() const { return server() && regions().size() == server()->regions; }
    bool lacks_region(const std::string& name) const ///< false as long as that is not known
    {
        return knows_all_regions() && !regions().contains(name);
    }

    const ClusterFrame* frame() const { return assembler_.newest(); }
    std::uint64_t complete_frames() const { return assembler_.complete_count(); }

    /// For more readers and writers of this client's.
    const wire::Participant& participant() const { return participant_; }

    StreamMeter::Report clusters_traffic() const { return clusters_meter_.report(Clock::now()); }

private:
    void take_states();
    void take_stats();
    void take_errors();
    void take_effects();
    void take_regions();
    void take_frames();
    void follow_session();
    template <class Message>
    bool is_ours(const Message& message, const dds_sample_info_t& info) const;

    std::uint32_t domain_;
    wire::Profile profile_;
    wire::Participant participant_;
    wire::WaitSet arrivals_;
    wire::Reader<wire::ServerState> state_reader_;
    std::optional<wire::Reader<wire::Stats>> stats_reader_;
    std::optional<wire::Reader<wire::Overview>> overview_reader_;
    std::optional<wire::Reader<wire::ErrorEstimate>> errors_reader_;
    std::optional<wire::Reader<wire::EffectStats>> effects_reader_;
    std::optional<wire::Reader<wire::RoiState>> regions_reader_;
    std::optional<wire::Reader<wire::Clusters>> clusters_reader_;
    std::optional<wire::Reader<wire::Clusters>> shared_clusters_reader_; ///< of regions without a partition
    std::optional<wire::Reader<wire::FrameManifest>> manifest_reader_;

    ServerWatch watch_;
    std::optional<wire::Uuid> session_; ///< of what is kept below
    std::optional<ServerStats> stats_;
    std::optional<OverviewNodes> overview_;
    Errors errors_;
    Effects effects_;
    std::map<wire::Uuid, Regions> regions_; ///< by session
    FrameAssembler assembler_;
    StreamMeter clusters_meter_;
};

} // namespace slod::client
