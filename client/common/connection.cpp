#include "common/connection.hpp"

#include "common/domains_in_use.hpp"

namespace slod::client {

namespace {

/// Samples taken of one topic per poll: a flood cannot hold a client for ever.
constexpr int samples_per_poll = 256;

std::chrono::nanoseconds age(const dds_sample_info_t& info)
{
    return std::chrono::nanoseconds(dds_time() - info.source_timestamp);
}

/// What may be wrong when nobody is heard: a server that stands still, or the other domains that this
/// machine's programs use.
std::string clues(std::uint32_t domain)
{
    std::string here, others;
    for (const auto& [used, participants] : domains_in_use()) {
        if (used == domain && participants > 1) // one is this program
            here =
                "; other programs on this machine are in the domain: clients, or a server that is suspended "
                "(kill -CONT lets it go on)";
        if (used != domain)
            others += (others.empty() ? "" : ", ") + std::to_string(used);
    }
    return here + (others.empty() ? "" : "; programs on this machine use DDS domain " + others);
}

} // namespace

Connection::Connection(std::uint32_t domain, wire::Profile profile, const Subscription& subscription)
    : domain_(domain), profile_(profile), participant_(domain, profile), arrivals_(participant_),
      state_reader_(participant_), assembler_(subscription.region)
{
    arrivals_.watch(state_reader_);
    if (subscription.stats)
        arrivals_.watch(stats_reader_.emplace(participant_));
    if (subscription.overview)
        arrivals_.watch(overview_reader_.emplace(participant_));
    if (subscription.errors)
        arrivals_.watch(errors_reader_.emplace(participant_));
    if (subscription.effects)
        arrivals_.watch(effects_reader_.emplace(participant_));
    if (subscription.regions)
        arrivals_.watch(regions_reader_.emplace(participant_));
    if (subscription.clusters && subscription.region.empty())
        arrivals_.watch(
            shared_clusters_reader_.emplace(participant_, wire::shared_partition, subscription.repair));
    if (subscription.clusters) {
        const std::string region = subscription.region.empty() ? "*" : subscription.region;
        arrivals_.watch(
            clusters_reader_.emplace(participant_, wire::region_partition(region), subscription.repair));
        arrivals_.watch(manifest_reader_.emplace(participant_));
    }
}

void Connection::poll()
{
    take_states();
    take_stats();
    take_errors();
    take_effects();
    take_regions();
    take_frames();
}

void Connection::wait(const std::stop_token& stop, std::chrono::nanoseconds timeout)
{
    const std::stop_callback wake(stop, [this] { arrivals_.wake(); });
    if (!stop.stop_requested())
        arrivals_.wait(timeout);
    poll();
}

Status Connection::status() const
{
    const Clock::time_point now = Clock::now();
    if (watch_.server())
        return watch_.status(now);
    const std::string where =
        " on domain " + std::to_string(domain_) + " (" + wire::configuration_source(profile_) + ")";
    if (state_reader_.misfits() > 0)
        return {Contact::NoServer, "the server" + where + " speaks another version of the protocol"};
    return {Contact::NoServer, "no server was heard" + where + clues(domain_)};
}

void Connection::take_states()
{
    const Clock::time_point now = Clock::now();
    state_reader_.take_each(samples_per_poll, [&](const wire::ServerState& state,
                                                  const dds_sample_info_t& info) {
        if (info.valid_data)
            watch_.on_state(state, now);
        if (info.instance_state != DDS_IST_ALIVE)
            watch_.on_gone(wire::uuid_of(state.session), info.instance_state == DDS_IST_NOT_ALIVE_DISPOSED);
    });
    follow_session();
}

void Connection::follow_session()
{
    const ServerInfo* server = watch_.server();
    if (!server || session_ == server->session)
        return;
    session_ = server->session;
    stats_.reset();
    overview_.reset();
    errors_.clear();
    effects_.clear();
    assembler_.reset();
    clusters_meter_.reset();
}

template <class Message>
bool Connection::is_ours(const Message& message, const dds_sample_info_t& info) const
{
    return info.valid_data && session_ == wire::uuid_of(message.session);
}

void Connection::take_stats()
{
    if (stats_reader_)
        stats_reader_->take_each(samples_per_poll,
                                 [&](const wire::Stats& stats, const dds_sample_info_t& info) {
                                     if (!is_ours(stats, info))
                                         return;
                                     assign(stats_ ? *stats_ : stats_.emplace(), stats);
                                 });
}

void Connection::take_errors()
{
    if (errors_reader_)
        errors_reader_->take_each(
            samples_per_poll, [&](const wire::ErrorEstimate& error, const dds_sample_info_t& info) {
                if (is_ours(error, info))
                    assign(errors_[error.region], error);
                if (info.instance_state != DDS_IST_ALIVE && session_ == wire::uuid_of(error.session))
                    errors_.erase(error.region);
            });
}

void Connection::take_effects()
{
    if (effects_reader_)
        effects_reader_->take_each(samples_per_poll,
                                   [&](const wire::EffectStats& effect, const dds_sample_info_t& info) {
                                       if (is_ours(effect, info))
                                           assign(effects_[effect.effect], effect);
                                   });
}

const MeasuredError* Connection::error() const
{
    const auto found = errors_.find("");
    return found != errors_.end() ? &found->second : nullptr;
}

/// Of every session: which one is followed may be known later, or change.
void Connection::take_regions()
{
    if (!regions_reader_)
        return;
    regions_reader_->take_each(samples_per_poll,
                               [&](const wire::RoiState& state, const dds_sample_info_t& info) {
                                   Regions& regions = regions_[wire::uuid_of(state.session)];
                                   if (info.valid_data)
                                       assign(regions[state.region], state);
                                   if (info.instance_state != DDS_IST_ALIVE)
                                       regions.erase(state.region);
                               });
    std::erase_if(regions_, [](const auto& entry) { return entry.second.empty(); });
}

const Connection::Regions& Connection::regions() const
{
    static const Regions none;
    const auto known = session_ ? regions_.find(*session_) : regions_.end();
    return known != regions_.end() ? known->second : none;
}

void Connection::take_frames()
{
    if (overview_reader_)
        overview_reader_->take_each(samples_per_poll,
                                    [&](const wire::Overview& overview, const dds_sample_info_t& info) {
                                        if (!is_ours(overview, info))
                                            return;
                                        assign(overview_ ? *overview_ : overview_.emplace(), overview);
                                    });
    if (!clusters_reader_)
        return;
    const auto take_clusters = [&](const wire::Clusters& clusters, const dds_sample_info_t& info) {
        if (!is_ours(clusters, info))
            return;
        assembler_.on_clusters(clusters);
        clusters_meter_.on_sample(clusters.region, clusters.serial, wire::wire_bytes(clusters), age(info),
                                  Clock::now());
    };
    clusters_reader_->take_each(samples_per_poll, take_clusters);
    if (shared_clusters_reader_)
        shared_clusters_reader_->take_each(samples_per_poll, take_clusters);
    manifest_reader_->take_each(samples_per_poll,
                                [&](const wire::FrameManifest& manifest, const dds_sample_info_t& info) {
                                    if (is_ours(manifest, info))
                                        assembler_.on_manifest(manifest);
                                });
}

} // namespace slod::client
