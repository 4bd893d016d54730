#pragma once

#include <cstdint>
#include <vector>

#include "effects/air.hpp"
#include "effects/colliders.hpp"
#include "effects/losses.hpp"
#include "effects/remaking.hpp"

namespace slod {

/// What collisions came to in one frame.
struct CollisionCounts {
    std::uint64_t struck = 0;          ///< clusters whose bound may have touched a collider
    std::uint64_t taken_apart = 0;     ///< those that ended, and whose members were formed anew
    std::uint64_t impacts = 0;         ///< of particles
    std::uint64_t impacts_cut_off = 0; ///< particles that rest, having met too many surfaces
    std::uint64_t killed = 0;          ///< particles that died of an impact; those just born are not counted
};

/// Clusters among colliders. One whose bound may touch a collider on its way through the frame is mapped out
/// before it moves, and its members fly by themselves, from impact to impact (O'Brien et al. 2001, section
/// 5.1). Then it goes on as it is if none of them touched anything, or if all are where they were; else it is
/// taken apart and its members are formed into clusters anew.
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

    /// Members that may be struck in the next frame, of so many particles: twice as many as in the last one,
    /// and 65,536 more. Should there be even more at once, memory for them is taken in that frame.
    std::size_t expected_members(std::size_t particle_count) const
    {
        return remaking_.expected_members(particle_count, 65'536);
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
    /// Where a struck cluster was, and how its members fared.
    struct Outcome {
        Vector3d position{0, 0, 0}, velocity{0, 0, 0};
        bool touched = false;    ///< any of them
        std::uint32_t moved = 0; ///< members whose place or velocity is another
        std::uint64_t impacts = 0, cut_off = 0;
        Losses killed{};
    };

    enum class Fate : std::uint8_t { Free, Touching, Killed };

    bool may_be_struck(const UpdateContext& context, std::size_t slot) const;
    Air::Felt felt_by(const UpdateContext& context, std::size_t slot) const;
    Outcome fly(const UpdateContext& context, const Remaking::Mapped& struck, std::span<Particle> members);
    bool keep(ClusterTable& clusters, const Remaking::Mapped& struck, const Outcome& outcome) const;
    void take_apart(const ClusterTable& clusters, const Remaking::Mapped& struck, std::uint64_t frame);

    Colliders colliders_;
    Rules rules_;
    const Air* air_;
    Remaking remaking_;             ///< of the struck
    std::vector<Outcome> outcomes_; ///< by cluster that is mapped out
    std::vector<Fate> fates_;       ///< by member
    std::uint64_t left_out_ = 0;
};

} // namespace slod
