#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/publish_outlet.hpp"
#include "app/publish_picture.hpp"
#include "app/requests.hpp"
#include "idl/dds.hpp"
#include "sim/snapshot.hpp"

namespace slod {

/// Regions whose clusters have a partition of their own; all others share one.
inline constexpr std::size_t max_own_partitions = 64;

/// Turns a region into a message. Keeps its memory.
class RegionEncoder {
public:
    explicit RegionEncoder(const wire::Uuid& session);

    /// The message is valid until the next call.
    const wire::RoiState& encode(const RegionRecord& record, const RegionLoad& load,
                                 std::string_view partition);

private:
    std::vector<wire::Assignment> settings_;
    wire::RoiState message_{};
};

/// The regions as clients know them: their state, and where their clusters go. Belongs to the publisher's
/// thread.
class PublishedRegions {
public:
    /// `participant` and `outlet` must outlive it. Until the first update() there is the background alone.
    PublishedRegions(const wire::Participant& participant, const wire::Uuid& session, Outlet& outlet);

    /// Takes over a region's record and writes its state, or disposes of it.
    void update(const RegionRecord& record);

    /// Takes over what the regions hold; writes the states of those where that has changed.
    void write_counts(std::span<const RegionLoad> loads);

    /// Writes the clusters of every region, at most `limit` nodes each, and lists them in `manifest`. What is
    /// in a region not heard of belongs to the background.
    void write_clusters(const ClusterStates& states, const FrameStamp& stamp, std::size_t limit,
                        ManifestEncoder& manifest);

    /// Whether anybody reads clusters of any region.
    bool clusters_read() const;

    std::size_t count() const { return regions_.size(); }
    std::uint64_t largest_clusters() const { return largest_clusters_; } ///< bytes of a sample

private:
    struct Region {
        Region(const wire::Uuid& session, std::string_view name, RegionRow its_row)
            : row(its_row), encoder(session, name)
        {
            load.row = its_row;
        }

        RegionRow row;
        RegionRecord record{};
        RegionLoad load{};
        ClustersEncoder encoder;
        std::optional<wire::Writer<wire::Clusters>> own_writer;
    };

    Region& open(const std::string& name, RegionRow row);
    void close(const std::string& name, const RegionRecord& record);
    void write_state(Region& region);
    std::string partition_of(const Region& region) const;
    void sort_rows(const ClusterStates& states);

    const wire::Participant& participant_;
    wire::Uuid session_;
    Outlet& outlet_;
    RegionEncoder encoder_;
    wire::Writer<wire::RoiState> state_writer_;
    std::map<std::string, Region> regions_; ///< by name
    std::vector<Region*> by_row_;           ///< null: no region
    std::size_t own_partitions_ = 0;
    std::optional<wire::Writer<wire::Clusters>> shared_writer_; ///< once there is a region that needs it
    std::uint64_t largest_clusters_ = 0;

    // Rows of a frame's clusters by region: those of tree row r are rows_[first_[r], first_[r + 1]).
    std::vector<std::uint32_t> first_, rows_;
};

} // namespace slod
