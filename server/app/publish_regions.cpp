#include "app/publish_regions.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <string_view>

#include "app/publish_fields.hpp"

namespace slod {

namespace {

/// Settings of a region that RoiState has fields for.
constexpr std::array<std::string_view, 15> named_fields{
    "name",   "precedence",    "shape", "centre", "half_extent", "radius",           "direction",  "up",
    "aspect", "field_of_view", "near",  "far",    "follows",     "max_cluster_size", "max_breadth"};

bool is_named(std::string_view key)
{
    return std::find(named_fields.begin(), named_fields.end(), key) != named_fields.end();
}

} // namespace

RegionEncoder::RegionEncoder(const wire::Uuid& session)
{
    wire::set(message_.session, session);
}

const wire::RoiState& RegionEncoder::encode(const RegionRecord& record, const RegionLoad& load,
                                            std::string_view partition)
{
    const RegionOfInterest& region = record.settings;
    wire::set(message_.region, region.name);
    message_.revision = record.revision;
    wire::set(message_.partition, partition);
    wire::set(message_.shape, names(region.shape)[std::size_t(region.shape)]);
    message_.centre = message_of(region.centre);
    message_.half_extent = message_of(region.half_extent);
    message_.radius = region.radius;
    message_.direction = message_of(region.direction);
    message_.up = message_of(region.up);
    message_.field_of_view_deg = region.field_of_view_deg;
    message_.aspect = region.aspect;
    message_.near_distance = region.near_distance;
    message_.far_distance = region.far_distance;
    wire::set(message_.follows, region.follows);
    message_.precedence = std::int32_t(region.precedence); // within 1e9 by its range
    message_.max_cluster_size = region.partition.max_cluster_size;
    message_.max_breadth = region.partition.max_breadth;
    message_.present_max_cluster_size = load.max_cluster_size;
    message_.present_max_breadth = load.max_breadth;
    settings_.clear();
    for (const Assignment& field : fields_of(region))
        if (!is_named(field.key)) {
            wire::Assignment& entry = settings_.emplace_back();
            wire::set(entry.setting, field.key);
            wire::set(entry.value, field.value);
        }
    wire::lend(message_.settings, settings_);
    wire::set(message_.owner, record.owner);
    message_.lease_s = record.lease_s;
    message_.clusters = load.clusters;
    message_.particles = load.particles;
    return message_;
}

PublishedRegions::PublishedRegions(const wire::Participant& participant, const wire::Uuid& session,
                                   Outlet& outlet)
    : participant_(participant), session_(session), outlet_(outlet), encoder_(session),
      state_writer_(participant)
{
    open(std::string(background_name), background_row);
}

PublishedRegions::Region& PublishedRegions::open(const std::string& name, RegionRow row)
{
    const auto [place, is_new] = regions_.try_emplace(name, session_, name, row);
    Region& region = place->second;
    if (is_new && own_partitions_ < max_own_partitions) {
        region.own_writer.emplace(participant_, wire::region_partition(name));
        ++own_partitions_;
    } else if (is_new && !shared_writer_) {
        shared_writer_.emplace(participant_, wire::shared_partition);
    }
    if (!is_new && by_row_[region.row] == &region) // removed and added again at once, elsewhere
        by_row_[region.row] = nullptr;
    region.row = region.load.row = row;
    if (by_row_.size() <= row)
        by_row_.resize(row + std::size_t{1}, nullptr);
    by_row_[row] = &region;
    return region;
}

void PublishedRegions::close(const std::string& name, const RegionRecord& record)
{
    const auto found = regions_.find(name);
    if (found != regions_.end()) {
        Region& region = found->second;
        if (by_row_[region.row] == &region)
            by_row_[region.row] = nullptr;
        own_partitions_ -= region.own_writer ? 1 : 0;
        if (!region.own_writer) {
            wire::Clusters gone{};
            wire::set(gone.session, session_);
            wire::set(gone.region, name);
            outlet_.forget(*shared_writer_, gone);
        }
        regions_.erase(found);
    }
    outlet_.forget(state_writer_, encoder_.encode(record, {}, {}));
}

void PublishedRegions::update(const RegionRecord& record)
{
    const std::string& name = record.settings.name;
    if (record.removed)
        return close(name, record);
    Region& region = open(name, record.row);
    region.record = record;
    write_state(region);
}

std::string PublishedRegions::partition_of(const Region& region) const
{
    return region.own_writer ? wire::region_partition(region.record.settings.name)
                             : std::string(wire::shared_partition);
}

void PublishedRegions::write_state(Region& region)
{
    outlet_.send(state_writer_, encoder_.encode(region.record, region.load, partition_of(region)));
}

void PublishedRegions::write_counts(std::span<const RegionLoad> loads)
{
    for (const RegionLoad& load : loads) {
        Region* const region = load.row < by_row_.size() ? by_row_[load.row] : nullptr;
        if (!region || region->record.revision == 0)
            continue;
        const bool same = region->load == load;
        region->load = load;
        if (!same)
            write_state(*region);
    }
}

void PublishedRegions::sort_rows(const ClusterStates& states)
{
    const auto region_of = [&](std::size_t cluster) -> std::size_t {
        const std::uint16_t row = states.region[cluster];
        return row < by_row_.size() && by_row_[row] ? row : background_row;
    };
    first_.assign(by_row_.size() + 1, 0);
    for (std::size_t cluster = 0; cluster < states.size(); ++cluster)
        ++first_[region_of(cluster) + 1];
    std::inclusive_scan(first_.begin(), first_.end(), first_.begin());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    rows_.resize(states.size());
    for (std::uint32_t cluster = 0; cluster < states.size(); ++cluster)
        rows_[next[region_of(cluster)]++] = cluster;
}

void PublishedRegions::write_clusters(const ClusterStates& states, const FrameStamp& stamp, std::size_t limit,
                                      ManifestEncoder& manifest)
{
    sort_rows(states);
    for (std::size_t row = 0; row < by_row_.size(); ++row) {
        Region* const region = by_row_[row];
        const std::span<const std::uint32_t> own =
            std::span(rows_).subspan(first_[row], first_[row + 1] - first_[row]);
        if (!region || (own.empty() && !region->own_writer))
            continue;
        const wire::Clusters& message = region->encoder.encode(states, own, stamp, limit);
        outlet_.send(region->own_writer ? *region->own_writer : *shared_writer_, message);
        largest_clusters_ = std::max<std::uint64_t>(largest_clusters_, wire::wire_bytes(message));
        manifest.add(region->encoder.manifest_entry());
    }
}

bool PublishedRegions::clusters_read() const
{
    return (shared_writer_ && shared_writer_->matched()) ||
           std::any_of(regions_.begin(), regions_.end(), [](const auto& entry) {
               return entry.second.own_writer && entry.second.own_writer->matched();
           });
}

} // namespace slod
