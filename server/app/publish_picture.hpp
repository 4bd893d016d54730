#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "app/publish_fields.hpp"
#include "app/publish_nodes.hpp"
#include "idl/messages.hpp"
#include "sim/snapshot.hpp"

namespace slod {

/// Turns the clusters of one region into a message. Keeps its memory: a steady scene allocates nothing.
class ClustersEncoder {
public:
    ClustersEncoder(const wire::Uuid& session, std::string_view region);

    /// The clusters in `rows` as at most `limit` nodes. The message is valid until the next call.
    const wire::Clusters& encode(const ClusterStates& states, std::span<const std::uint32_t> rows,
                                 const FrameStamp& stamp, std::size_t limit);

    /// The last message's entry in its frame's manifest.
    wire::RegionCount manifest_entry() const;

private:
    void resize(std::size_t nodes);

    NodeGroups groups_;
    std::vector<float> position_, velocity_, mass_, covariance_;
    std::vector<std::uint32_t> particles_;
    std::vector<std::uint64_t> cluster_id_, formation_;
    wire::Clusters message_{};
};

/// Turns the clusters of all regions into the overview.
class OverviewEncoder {
public:
    explicit OverviewEncoder(const wire::Uuid& session);

    const wire::Overview& encode(const ClusterStates& states, const FrameStamp& stamp, std::size_t limit);

private:
    void resize(std::size_t nodes);

    NodeGroups groups_;
    std::vector<float> position_, velocity_, mass_, radius_;
    std::vector<std::uint32_t> particles_;
    wire::Overview message_{};
};

/// Says which regions a frame has, once their clusters are written.
class ManifestEncoder {
public:
    explicit ManifestEncoder(const wire::Uuid& session);

    void begin() { regions_.clear(); }
    void add(const wire::RegionCount& entry) { regions_.push_back(entry); }
    const wire::FrameManifest& encode(const FrameStamp& stamp);

private:
    std::vector<wire::RegionCount> regions_;
    wire::FrameManifest message_{};
};

} // namespace slod
