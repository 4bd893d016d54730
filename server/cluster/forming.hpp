#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cluster/cluster_table.hpp"
#include "cluster/member_pool.hpp"
#include "cluster/particles.hpp"

namespace slod {

/// The clusters and their members, and what is common to all of them: how maps are obtained and what
/// members of a kind share. Every operation below conserves mass and momentum to rounding in double and
/// moves no member by more than one float rounding of its offset.
struct ClusterStore {
    ClusterStore(const ClusterTable::Columns& cluster_columns, const MemberPool::Columns& member_columns,
                 const MapRule& map_rule)
        : clusters(cluster_columns), members(member_columns), rule(map_rule), drift(map_rule)
    {}

    ClusterTable clusters;
    MemberPool members;
    MapRule rule;
    DriftByAge drift;                           ///< of scalar maps
    float uniform_mass = 0;                     ///< of members, when they have no mass column
    std::vector<double> kind_softening_squared; ///< eps^2 by kind
};

/// Forms a cluster of `particles` (at least one) in `slot`, whose slab must have room for them: centre and
/// velocity by mass, or by number when all are massless; offsets and moments from them; the identity map.
/// Where particles expire it reorders them: by expiry, then id. Leaves region, pool and list to the caller.
void form_cluster(ClusterStore& store, ClusterSlot slot, std::span<Particle> particles, std::uint64_t frame);

/// Writes the cluster's live members as they are at the end of frame `frame`; `out` has room for count of
/// them. Order as stored.
void map_out(const ClusterStore& store, ClusterSlot slot, std::uint64_t frame, std::span<Particle> out);

/// Single members of a cluster as they are at the end of a frame.
class MemberReader {
public:
    MemberReader(const ClusterStore& store, ClusterSlot slot, std::uint64_t frame);

    /// The member in a row that has been written.
    Particle operator()(std::uint32_t row) const;

private:
    const ClusterStore& store_;
    Slab slab_;
    MapBlocks map_;
    MapBlocks::Offset mean_; ///< what the map is applied about
    Vector3d position_, velocity_;
};

/// The one that map_out() writes at `place`, in [0, count).
Particle member_at(const ClusterStore& store, ClusterSlot slot, std::uint64_t frame, std::uint32_t place);

/// A member's place and velocity when its cluster was formed, relative to the members' mean.
inline MapBlocks::Offset relative_to(const FormedOffset& offset, const MapBlocks::Offset& mean)
{
    return {offset.position.cast<double>() - mean.position, offset.velocity.cast<double>() - mean.velocity};
}

/// All that a cluster's members' places follow from besides their rows, which stay as long as their slab is
/// not recycled, whatever becomes of the cluster.
struct ClusterPicture {
    Slab slab;
    std::uint32_t stored = 0;
    Vector3d position{0, 0, 0};
    MapBlocks::Offset mean;          ///< what the map is applied about
    Matrix3d of_offset, of_velocity; ///< the map's blocks that give a place

    /// Exactly where map_out() has the member.
    Vector3d place_of(const FormedOffset& formed) const
    {
        const MapBlocks::Offset offset = relative_to(formed, mean);
        return position + (of_offset * offset.position + of_velocity * offset.velocity);
    }
};

ClusterPicture picture_of(const ClusterStore& store, ClusterSlot slot, std::uint64_t frame);

/// A member as others feel it.
struct MemberPlace {
    Vector3d place;
    double mass;
    std::uint8_t kind;
};

/// Calls visit(MemberPlace) for each member that was alive at the end of `frame`, of which the picture is.
template <class Visit>
void visit_members(const ClusterStore& store, const ClusterPicture& picture, std::uint64_t frame,
                   const Visit& visit)
{
    const FormedOffset* const offsets = store.members.offsets(picture.slab);
    const float* const masses = store.members.masses(picture.slab);
    const std::uint8_t* const kinds = store.members.kinds(picture.slab);
    const std::uint32_t* const expiries = store.members.expiries(picture.slab);
    for (std::uint32_t row = 0; row < picture.stored; ++row) {
        if (expiries != nullptr && expiries[row] <= frame)
            continue;
        visit(MemberPlace{picture.place_of(offsets[row]),
                          double(masses != nullptr ? masses[row] : store.uniform_mass),
                          kinds != nullptr ? kinds[row] : std::uint8_t(0)});
    }
}

/// Where a cluster was at the end of an earlier frame of its life, for its members' places then.
struct ClusterPast {
    std::uint64_t formation = 0; ///< which cluster
    Vector3d position{0, 0, 0};
    MapBlocks::Offset mean; ///< what its map was applied about
    FlowMap map;            ///< where it has one of its own
};

ClusterPast past_of(const ClusterTable& clusters, std::size_t slot);

/// Writes where those of the cluster's members that are alive at the end of frame `frame` were at the end of
/// the one before, in the order of map_out(). `past` is of then.
void map_out_past(const ClusterStore& store, ClusterSlot slot, std::uint64_t frame, const ClusterPast& past,
                  std::span<Vector3d> places);

/// Whether a particle may join: the slab has a free row, and drag has not shrunk the map so far that its
/// inverse would magnify the rounding of an offset more than 16 times.
bool takes_members(const ClusterStore& store, ClusterSlot slot, std::uint64_t frame);

/// Adds a particle through the inverse map. The cluster must take members.
void insert_member(ClusterStore& store, ClusterSlot slot, const Particle& particle, std::uint64_t frame);

/// Takes away the members whose time has come at the end of frame `frame`; returns how many. The cluster
/// may be left with count 0, for the caller to free.
std::uint32_t remove_expired(ClusterStore& store, ClusterSlot slot, std::uint64_t frame);

/// Lets members go whatever their time, and moves the cluster into `slab`, which has room for the others:
/// those of `rows` (ascending; not all) of the members that were alive at the end of the frame before
/// `frame`, which its map has been carried to. The others stay where the map has them. The old slab is the
/// caller's.
void release_members(ClusterStore& store, ClusterSlot slot, const Slab& slab,
                     std::span<const std::uint32_t> rows, std::uint64_t frame);

/// Lets the cluster move at `velocity` instead of its members' mean, which is kept in mind.
void hold_velocity(ClusterTable& clusters, std::size_t slot, const Vector3d& velocity);

/// Gives the cluster its members' mean velocity back.
void release_velocity(ClusterTable& clusters, std::size_t slot);

/// What the map is applied about: the means of the members' stored offsets, by mass, or by number of a
/// massless cluster.
MapBlocks::Offset map_centre(const ClusterTable& clusters, std::size_t slot);

} // namespace slod
