#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "cluster/bounds.hpp"
#include "effects/air.hpp"
#include "effects/colliders.hpp"
#include "effects/losses.hpp"
#include "effects/remaking.hpp"

namespace slod {

/// What collisions came to in one frame.
struct CollisionCounts {
    std::uint64_t struck = 0;          ///< clusters of which members may have touched a collider
    std::uint64_t taken_apart = 0;     ///< those that ended, or whose members were in part formed anew
    std::uint64_t impacts = 0;         ///< of particles
    std::uint64_t impacts_cut_off = 0; ///< particles that rest, having met too many surfaces
    std::uint64_t killed = 0;          ///< particles that died of an impact; those just born are not counted
};

/// Clusters among colliders. Of one whose bound may touch a collider on its way through the frame, those
/// members whose own way may are mapped out before it moves, and fly by themselves, from impact to impact
/// (O'Brien et al. 2001, section 5.1). Then it goes on as it is if none of them touched anything, or if all
/// are where they were; else those that did leave it, and are formed into clusters anew.
class Collisions {
public:
    /// What a cluster's map says of its members.
    struct Rules {
        bool carries_members = false; ///< they move as they would by themselves
        bool exact = false;           ///< wherever they go
        bool full_map = false;
    };

    /// `air`, the caller's, where it differs from place to place, and then asked for each frame before
    /// members fly; null otherwise.
    Collisions(const std::vector<ColliderSettings>& settings, const UniformFields& fields, double step,
               const Rules& rules, const Air* air = nullptr)
        : colliders_(settings, fields, step), rules_(rules), air_(air)
    {}

    const Colliders& colliders() const { return colliders_; }
    void set_fields(const UniformFields& fields) { colliders_.set_fields(fields); }

    /// Members of clusters that may be struck in the next frame, of so many particles: twice as many as in
    /// the last one, and 65,536 more. Should there be even more at once, memory for them is taken in that
    /// frame.
    std::size_t expected_members(std::size_t particle_count) const
    {
        return std::min(particle_count, 2 * struck_members_ + 65'536);
    }

    /// Provides memory for so many members, in the clusters there is room for.
    void reserve(const ClusterTable& clusters, std::size_t member_count);

    /// Before the clusters move through frame `context.frame`: finds those that are struck, and lets their
    /// members fly.
    void fly_members(const UpdateContext& context);

    /// After they have moved: gives the struck ones their members' outcome, the new ones places in the tree.
    /// Those that were killed are left out, and of what is taken apart those whose time has come; returns how
    /// many. `killed` is set to what the former had when they were struck.
    std::uint64_t put_back(SlodTree& tree, const UpdateContext& context, CollisionCounts& counts,
                           Losses& killed);

private:
    enum class Fate : std::uint8_t { Free, Touching, Killed };

    /// A member that may be struck.
    struct Flown {
        Particle particle; ///< as its flight left it
        Fate fate;
    };

    /// A cluster that has such, and how they fared.
    struct Struck {
        ClusterSlot slot;
        std::uint32_t first, count;               ///< of them
        std::uint32_t touching = 0;               ///< of them, also those killed; their rows come first
        std::array<std::uint32_t, 2> outliving{}; ///< by fate, but for those killed: whose time has not come
        std::uint32_t moved = 0;                  ///< of them, whose place or velocity is another
        Vector3d position{0, 0, 0}, velocity{0, 0, 0}; ///< where it was
        std::uint64_t impacts = 0, cut_off = 0;
        Losses killed{};
    };

    /// What a cluster gets from the forces of a frame.
    struct Kick {
        Vector3d acceleration{0, 0, 0};
        Vector3d half{0, 0, 0}; ///< of it, a velocity
    };

    /// What a struck cluster loses.
    struct Parting {
        const Struck* struck;
        std::uint32_t first; ///< of its members among those that are grouped
        Slab rest;           ///< for those that stay; none where it ends
    };

    double reach(const UpdateContext& context, std::size_t slot, const MemberBounds& bounds,
                 const Air::Felt* felt) const;
    template <class Visit>
    void visit_near(const UpdateContext& context, ClusterSlot slot, const Visit& visit) const;
    bool flies_whole(const ClusterTable& clusters, std::size_t slot) const;
    Kick kick_of(const UpdateContext& context, std::size_t slot) const;
    void list_struck(const ClusterTable& clusters);
    void fly(const UpdateContext& context, Struck& struck);
    bool keep(ClusterTable& clusters, const Struck& struck) const;
    void part(SlodTree& tree, const UpdateContext& context, const Struck& struck);
    void group(const ClusterTable& clusters, const Struck& struck, std::uint32_t count, bool together);
    void move_members(const UpdateContext& context, const Parting& parting);
    std::span<const Flown> flown_by(const Struck& struck) const
    {
        return std::span(flown_).subspan(struck.first, struck.count);
    }

    Colliders colliders_;
    Rules rules_;
    const Air* air_;
    Remaking remaking_;
    std::vector<std::uint32_t> near_counts_; ///< by slot: members that may be struck
    std::vector<Struck> struck_;             ///< in order of slots
    std::vector<Flown> flown_;               ///< struck cluster by struck cluster; as long as it ever was
    std::vector<std::uint32_t> rows_;        ///< likewise: where they are stored
    std::vector<Parting> partings_;
    std::size_t struck_members_ = 0; ///< of the clusters struck in the last frame
    std::uint64_t left_out_ = 0;
};

} // namespace slod
