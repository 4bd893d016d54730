#pragma once

#include <cstdint>
#include <optional>

#include "effects/member_settings.hpp"
#include "effects/remaking.hpp"

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
    void reserve(const ClusterTable& clusters, std::size_t member_count)
    {
        remaking_.reserve(clusters, member_count);
    }

    /// Members expected to be changed in a frame, of so many particles: twice as many as in the last one and
    /// 4,096 more, unless it is all of them.
    std::size_t expected_members(std::size_t particle_count) const;

    /// Acts on places as they are after `context.frame` frames and on velocities that the next frame's
    /// opening half kick is in already, before anything moves.
    void update(SlodTree& tree, const UpdateContext& context);

    /// Members changed in the last update.
    std::uint64_t changed() const { return changed_; }

private:
    bool may_be_too_fast(const UpdateContext& context, std::size_t slot) const;
    bool kick(Particle& particle, std::uint64_t frame, double step) const;

    double limit_;    ///< infinite without one
    double strength_; ///< 0 without
    std::uint64_t seed_;
    Remaking remaking_;
    std::uint64_t changed_ = 0;
};

} // namespace slod
