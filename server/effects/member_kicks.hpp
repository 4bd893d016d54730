#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "effects/member_settings.hpp"
#include "tree/grouping.hpp"
#include "tree/slod_tree.hpp"

namespace slod {

/// What changes each particle's velocity by itself, so that no map can follow: a speed limit and Brownian
/// kicks. Clusters that they may reach are mapped out, and those that they change are formed anew of the same
/// members: O(members), some tenths of a microsecond each, where clusters take as long all together.
class MemberKicks {
public:
    MemberKicks(const std::optional<SpeedLimitSettings>& limit,
                const std::optional<BrownianSettings>& brownian, std::uint64_t seed);

    /// Whether every particle is changed in every frame; else only those that are too fast.
    bool reaches_all() const { return strength_ > 0; }

    /// Provides memory for so many members, in the clusters there is room for.
    void reserve(const ClusterTable& clusters, std::size_t member_count);

    /// Members expected to be changed in a frame, of so many particles: twice as many as in the last one and
    /// 4,096 more, unless it is all of them.
    std::size_t expected_members(std::size_t particle_count) const;

    /// Acts on places as they are after `context.frame` frames and on velocities that the next frame's
    /// opening half kick is in already, before anything moves.
    void update(SlodTree& tree, const UpdateContext& context);

    /// Members changed in the last update.
    std::uint64_t changed() const { return changed_; }

private:
    /// A cluster that is reached, and where its members are in `members_`.
    struct Reached {
        ClusterSlot slot;
        std::uint32_t first, count;
        std::uint32_t changed = 0;
    };

    /// What was last measured of a cluster. It holds for one formed anew where it was, of the same members.
    struct Measured {
        Vector3d acceleration{0, 0, 0};
        Symmetric3 tide{};
        Vector3d turning{0, 0, 0};
        double variance = 0;
    };

    static Measured measured(const ClusterTable& clusters, std::size_t slot);
    static void write(ClusterTable& clusters, std::size_t slot, const Measured& measured);
    void find(const UpdateContext& context);
    bool kick(Particle& particle, std::uint64_t frame, double step) const;
    void gather(ClusterTable& clusters);

    double limit_;    ///< infinite without one
    double strength_; ///< 0 without
    std::uint64_t seed_;
    std::vector<std::uint8_t> marks_;
    std::vector<Reached> reached_; ///< in order of slots
    std::vector<Particle> members_;
    std::vector<ClusterSlot> ending_;
    std::vector<Measured> measured_; ///< by group
    Grouping grouping_;
    std::uint64_t changed_ = 0;
};

} // namespace slod
