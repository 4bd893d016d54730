#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "effects/losses.hpp"
#include "effects/remaking.hpp"
#include "effects/sinks.hpp"

namespace slod {

/// Clusters among sinks. Those whose bound may have come into one in a frame are mapped out; of their members
/// those that did die, and what they leave is formed anew. All others cost a distance.
class Draining {
public:
    explicit Draining(const std::vector<SinkSettings>& settings) : sinks_(settings) {}

    const Sinks& sinks() const { return sinks_; }

    /// Provides memory for so many members, in the clusters there is room for.
    void reserve(const ClusterTable& clusters, std::size_t member_count);

    /// Members expected to be looked at in a frame, of so many particles.
    std::size_t expected_members(std::size_t particle_count) const
    {
        return remaking_.expected_members(particle_count);
    }

    /// Before clusters move through frame `context.frame`: where sinks may be flown through, keeps in mind
    /// where they are.
    void remember(const UpdateContext& context);

    /// At the end of frame `context.frame`, ends the lives of particles that are in a sink or were on their
    /// way, taken as straight. Of those that a collider took out of their cluster only the end of it counts.
    /// Returns what sinks took.
    Losses update(SlodTree& tree, const UpdateContext& context);

private:
    /// A cluster at a frame's start.
    struct Past {
        ClusterPast cluster;
        double radius = 0; ///< that no member is beyond
    };

    bool remembers(const ClusterTable& clusters, std::size_t slot) const;
    bool may_meet_one(const UpdateContext& context, std::size_t slot) const;
    std::uint32_t drain(const UpdateContext& context, const Remaking::Mapped& mapped,
                        std::span<Particle> members);

    Sinks sinks_;
    std::vector<Past> past_; ///< by slot; empty where no sink may be flown through
    Remaking remaking_;
    std::vector<Vector3d> places_; ///< by member that is mapped out: at the frame's start
};

} // namespace slod
