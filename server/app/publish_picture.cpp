#include "app/publish_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace slod {

namespace {

/// Stores a vector as the `index`-th xyz triple.
void store(std::vector<float>& triples, std::size_t index, const Vector3d& value)
{
    for (std::size_t axis = 0; axis < 3; ++axis)
        triples[3 * index + axis] = static_cast<float>(value[Eigen::Index(axis)]);
}

void store(std::vector<float>& sextuples, std::size_t index, const Symmetric3& value)
{
    const std::array entries{value.xx, value.xy, value.xz, value.yy, value.yz, value.zz};
    for (std::size_t entry = 0; entry < entries.size(); ++entry)
        sextuples[6 * index + entry] = static_cast<float>(entries[entry]);
}

std::uint64_t packed(const ClusterId& id)
{
    return std::uint64_t(id.generation) << 32 | id.slot.index;
}

} // namespace

ClustersEncoder::ClustersEncoder(const wire::Uuid& session, std::string_view region)
{
    wire::set(message_.session, session);
    wire::set(message_.region, region);
}

const wire::Clusters& ClustersEncoder::encode(const ClusterStates& states,
                                              std::span<const std::uint32_t> rows, const FrameStamp& stamp,
                                              std::size_t limit)
{
    groups_.form(states, rows, limit);
    resize(groups_.size());
    const Vector3d origin = groups_.origin();
    for (std::size_t i = 0; i < groups_.size(); ++i) {
        const PublishedNode node = sum_of(states, groups_[i]);
        store(position_, i, node.position - origin);
        store(velocity_, i, node.velocity);
        store(covariance_, i, node.covariance);
        mass_[i] = static_cast<float>(node.mass);
        particles_[i] = node.particles;
        cluster_id_[i] = packed(node.id);
        formation_[i] = node.formation;
    }
    stamp_next(message_, stamp);
    message_.region_clusters = groups_.clusters();
    message_.clusters_per_node = groups_.clusters_per_group();
    message_.origin = message_of(origin);
    return message_;
}

void ClustersEncoder::resize(std::size_t nodes)
{
    position_.resize(3 * nodes);
    velocity_.resize(3 * nodes);
    mass_.resize(nodes);
    particles_.resize(nodes);
    covariance_.resize(6 * nodes);
    cluster_id_.resize(nodes);
    formation_.resize(nodes);
    wire::lend(message_.position, position_);
    wire::lend(message_.velocity, velocity_);
    wire::lend(message_.mass, mass_);
    wire::lend(message_.particles, particles_);
    wire::lend(message_.covariance, covariance_);
    wire::lend(message_.cluster_id, cluster_id_);
    wire::lend(message_.formation, formation_);
}

wire::RegionCount ClustersEncoder::manifest_entry() const
{
    wire::RegionCount entry{};
    wire::set(entry.region, message_.region);
    entry.region_clusters = message_.region_clusters;
    entry.published_nodes = message_.mass._length;
    return entry;
}

OverviewEncoder::OverviewEncoder(const wire::Uuid& session)
{
    wire::set(message_.session, session);
}

const wire::Overview& OverviewEncoder::encode(const ClusterStates& states, const FrameStamp& stamp,
                                              std::size_t limit)
{
    groups_.form(states, limit);
    resize(groups_.size());
    const Vector3d origin = groups_.origin();
    for (std::size_t i = 0; i < groups_.size(); ++i) {
        const PublishedNode node = sum_of(states, groups_[i]);
        store(position_, i, node.position - origin);
        store(velocity_, i, node.velocity);
        mass_[i] = static_cast<float>(node.mass);
        particles_[i] = node.particles;
        radius_[i] = static_cast<float>(std::sqrt(std::max(node.covariance.trace(), 0.0)));
    }
    stamp_next(message_, stamp);
    message_.scene_clusters = groups_.clusters();
    message_.clusters_per_node = groups_.clusters_per_group();
    message_.origin = message_of(origin);
    return message_;
}

void OverviewEncoder::resize(std::size_t nodes)
{
    position_.resize(3 * nodes);
    velocity_.resize(3 * nodes);
    mass_.resize(nodes);
    particles_.resize(nodes);
    radius_.resize(nodes);
    wire::lend(message_.position, position_);
    wire::lend(message_.velocity, velocity_);
    wire::lend(message_.mass, mass_);
    wire::lend(message_.particles, particles_);
    wire::lend(message_.radius, radius_);
}

ManifestEncoder::ManifestEncoder(const wire::Uuid& session)
{
    wire::set(message_.session, session);
}

const wire::FrameManifest& ManifestEncoder::encode(const FrameStamp& stamp)
{
    stamp_next(message_, stamp);
    wire::lend(message_.regions, regions_);
    return message_;
}

} // namespace slod
