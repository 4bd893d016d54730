#include "common/frame_assembler.hpp"

#include <algorithm>
#include <utility>

namespace slod::client {

namespace {

constexpr std::string_view unused; ///< name of memory that waits for a region

} // namespace

std::size_t ClusterFrame::nodes() const
{
    std::size_t sum = 0;
    for (const RegionClusters& region : regions)
        sum += region.mass.size();
    return sum;
}

void FrameAssembler::on_clusters(const wire::Clusters& clusters)
{
    assign(arriving(clusters.region), clusters);
    complete_if_all_arrived();
}

void FrameAssembler::on_manifest(const wire::FrameManifest& manifest)
{
    expected_.clear();
    for (const wire::RegionCount& entry : wire::span_of(manifest.regions))
        if (region_.empty() || region_ == entry.region)
            expected_.emplace_back(entry.region);
    expected_frame_ = manifest.frame;
    expected_time_ = manifest.time;
    complete_if_all_arrived();
}

void FrameAssembler::reset()
{
    arriving_.clear();
    expected_frame_.reset();
    newest_ = {};
    complete_count_ = 0;
}

RegionClusters& FrameAssembler::arriving(std::string_view region)
{
    const auto named = [this](std::string_view name) {
        return std::find_if(arriving_.begin(), arriving_.end(),
                            [name](const RegionClusters& known) { return known.region == name; });
    };
    auto found = named(region);
    if (found == arriving_.end())
        found = named(unused);
    return found != arriving_.end() ? *found : arriving_.emplace_back();
}

/// Regions that a newer frame has reached already wait for that frame's manifest.
void FrameAssembler::complete_if_all_arrived()
{
    if (!expected_frame_)
        return;
    const auto arrived = [this](const std::string& region) {
        return std::any_of(arriving_.begin(), arriving_.end(), [&](const RegionClusters& known) {
            return known.region == region && known.frame == *expected_frame_;
        });
    };
    if (!std::all_of(expected_.begin(), expected_.end(), arrived))
        return;
    newest_.frame = *expected_frame_;
    newest_.time = expected_time_;
    newest_.regions.resize(expected_.size());
    for (RegionClusters& old : newest_.regions)
        old.region = unused;
    for (std::size_t i = 0; i < expected_.size(); ++i)
        std::swap(newest_.regions[i], arriving(expected_[i]));
    for (RegionClusters& left : arriving_)
        if (left.frame <= *expected_frame_)
            left.region = unused;
    expected_frame_.reset();
    ++complete_count_;
}

} // namespace slod::client
