#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/messages.hpp"

namespace slod::client {

/// The regions of one frame, all of the same moment.
struct ClusterFrame {
    std::uint64_t frame = 0;
    double time = 0;
    std::vector<RegionClusters> regions;

    std::size_t nodes() const;
};

/// Puts frames together from the samples of their regions, which arrive one by one, and keeps the newest
/// complete one. Steady traffic allocates nothing.
class FrameAssembler {
public:
    /// `region` alone is expected; empty: every region of a frame's manifest.
    explicit FrameAssembler(std::string_view region = {}) : region_(region) {}

    void on_clusters(const wire::Clusters& clusters);
    void on_manifest(const wire::FrameManifest& manifest);

    /// The newest complete frame; null before there was one.
    const ClusterFrame* newest() const { return complete_count_ > 0 ? &newest_ : nullptr; }

    /// Frames completed so far: another number means another frame.
    std::uint64_t complete_count() const { return complete_count_; }

    /// Forgets everything: another session begins.
    void reset();

private:
    RegionClusters& arriving(std::string_view region);
    void complete_if_all_arrived();

    std::string region_;
    std::vector<RegionClusters> arriving_;
    std::vector<std::string> expected_;
    std::optional<std::uint64_t> expected_frame_; ///< of a manifest whose frame is not complete yet
    double expected_time_ = 0;
    ClusterFrame newest_;
    std::uint64_t complete_count_ = 0;
};

} // namespace slod::client
