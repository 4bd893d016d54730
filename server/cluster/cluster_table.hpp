#pragma once

#include <cstdint>
#include <vector>

#include "cluster/flow_map.hpp"
#include "cluster/member_pool.hpp"
#include "cluster/moments.hpp"
#include "core/aligned.hpp"
#include "core/ids.hpp"
#include "core/vectors.hpp"

namespace slod {

/// All clusters, one array per quantity, a row per slot. Slots of ended clusters are re-used, with a new
/// generation. Centres in double: they are few. Invariants:
///  - a slot is either free (count 0) or alive, with count live members within its slab's first `stored`
///  rows;
///  - the moments are those of the live members;
///  - every alive cluster is in the list of exactly one pool.
struct ClusterTable {
    /// Columns that not every plan needs.
    struct Columns {
        bool map = false;  ///< full flow maps
        bool tide = false; ///< tidal tensors
        bool acceleration = false;
        bool counting_moments = false; ///< when masses differ or are all 0, so that breadth counts particles
        bool expiry = false;
        bool withheld = false; ///< where clusters may move by their first particle's velocity
        bool turning = false;  ///< where accelerations have a curl
        bool strain = false;   ///< where winds deform clusters, or drag does

        bool variance() const { return acceleration || tide || strain; }
    };

    explicit ClusterTable(const Columns& asked) : columns(asked) {}

    Columns columns;

    // State, carried from frame to frame.
    AlignedVector<Vector3d> position; ///< centre of mass
    AlignedVector<Vector3d> velocity;
    AlignedVector<Vector3d> withheld;       ///< the members' mean velocity less `velocity`; columns.withheld
    AlignedVector<FlowMap> map;             ///< columns.map
    AlignedVector<Moments> moments;         ///< weighted by mass
    AlignedVector<Moments> counting;        ///< weighted by number; columns.counting_moments
    AlignedVector<float> offset_max;        ///< largest |o| at forming
    AlignedVector<float> speed_max;         ///< largest |w| at forming
    AlignedVector<float> softening_squared; ///< mass-weighted mean of the members' eps^2
    AlignedVector<Slab> slab;
    AlignedVector<std::uint32_t> stored;      ///< rows of the slab that have been written
    AlignedVector<std::uint32_t> count;       ///< live members; 0 in a free slot
    AlignedVector<std::uint32_t> next_expiry; ///< frame at whose end the next member dies; columns.expiry
    AlignedVector<std::uint64_t> formed_frame;
    AlignedVector<std::uint64_t> formation;  ///< number of the forming, never re-used
    AlignedVector<std::uint32_t> generation; ///< of the slot
    AlignedVector<std::uint16_t> region;
    AlignedVector<PoolId> pool;                ///< of the region's subtree
    AlignedVector<ClusterSlot> next, previous; ///< in the pool's list
    /// |a| at the last evaluation, by gravity where there is any, else by fields; of clusters formed since,
    /// the mean of those their members come from. 0: none is known. columns.acceleration
    AlignedVector<double> pull;

    // Derived anew each frame from the state.
    AlignedVector<Vector3d> acceleration; ///< columns.acceleration
    AlignedVector<Symmetric3> tide;       ///< symmetric part of da/dx without the closure; columns.tide
    AlignedVector<Vector3d> turning;      ///< half the curl of a; columns.turning
    AlignedVector<double> strain;         ///< square of the rate at which winds deform it; columns.strain
    AlignedVector<double> closure;        ///< self-gravity of the members, T_self = -closure 1; columns.map
    AlignedVector<double> variance;       ///< trace of the position covariance; columns.variance()

    std::size_t slot_count() const { return count.size(); }
    std::size_t slot_capacity() const { return position.capacity(); } ///< rows without taking memory
    std::size_t alive_count() const { return slot_count() - free_slots.size(); }
    bool alive(std::size_t slot) const { return count[slot] > 0; }
    Vector3d mean_velocity(std::size_t slot) const ///< of the members
    {
        return columns.withheld ? Vector3d(velocity[slot] + withheld[slot]) : velocity[slot];
    }
    /// Whether the cluster moves at another velocity than its members' mean.
    bool holds_velocity(std::size_t slot) const { return columns.withheld && !withheld[slot].isZero(0); }
    double mass(std::size_t slot) const { return moments[slot].weight; }
    ClusterId id(std::size_t slot) const { return {{std::uint32_t(slot)}, generation[slot]}; }

    /// da/dx about the cluster, without the members' own attraction. Needs columns.tide.
    Matrix3d gradient(std::size_t slot) const
    {
        Matrix3d gradient = tide[slot].matrix();
        if (columns.turning) {
            const Vector3d& w = turning[slot];
            Matrix3d turn;
            turn << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0;
            gradient += turn;
        }
        return gradient;
    }

    /// Square of the rate at which fields deform the cluster, 1 / time^2: |da/dx|, and what winds add.
    double rate_squared(std::size_t slot) const
    {
        const double tidal = columns.tide ? gradient(slot).norm() : 0.0;
        return columns.strain ? tidal + strain[slot] : tidal;
    }

    /// The moments that weigh every member alike: what decides how wide a cluster looks.
    const Moments& counting_moments(std::size_t slot) const
    {
        return columns.counting_moments ? counting[slot] : moments[slot];
    }

    /// Flow map of the cluster at the end of frame `frame`.
    MapBlocks blocks(std::size_t slot, const MapRule& rule, std::uint64_t frame) const
    {
        return rule.blocks(frame - formed_frame[slot], columns.map ? &map[slot] : nullptr);
    }

    /// A free slot, with generation and formation number set. Grows the table only when reserve() did not.
    ClusterSlot take_slot();

    /// Ends the cluster in `slot`; its slab is the caller's to retire.
    void free_slot(ClusterSlot slot);

    /// Provides room for `slots` more clusters.
    void reserve(std::size_t slots);

    std::vector<ClusterSlot> free_slots; ///< last freed, first taken
    std::uint64_t formations = 0;        ///< formings so far
    std::uint32_t generations = 0;       ///< that slots had before this table, at most
};

} // namespace slod
