#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "cluster/forming.hpp"
#include "effects/colliders.hpp"
#include "effects/path.hpp"

namespace slod {

/// Which members of a cluster may come through the fences about its centre during a flight. How high a member
/// is above a fence, at the flight's start and at its end, is linear in what it has stored of its forming:
/// two sums of six products each. In between, its path is no lower than the lower one, less what it sags.
class NearMembers {
public:
    /// How members fly from the end of `frame` on: as the map has them, but for their velocity.
    struct Flight {
        Elapsed elapsed;
        Vector3d acceleration; ///< of what is at rest
        double drag;
        Vector3d change; ///< of the velocity, as it begins
    };

    /// `relative` is no less than the speed of any member about the cluster's.
    NearMembers(const ClusterStore& store, ClusterSlot slot, std::uint64_t frame, const Fences& fences,
                const Flight& flight, double relative);

    bool operator()(const FormedOffset& offset) const
    {
        const Vector3d o = offset.position.cast<double>(), w = offset.velocity.cast<double>();
        for (std::size_t i = 0; i < count_; ++i) {
            const Heights& heights = heights_[i];
            const double first = heights.first.o.dot(o) + heights.first.w.dot(w);
            const double last = heights.last.o.dot(o) + heights.last.w.dot(w);
            if (first <= heights.least_first || last <= heights.least_last)
                return true;
        }
        return false;
    }

private:
    /// A number that is linear in what a member has stored.
    struct Linear {
        Vector3d o, w;

        double of(const MapBlocks::Offset& offset) const
        {
            return o.dot(offset.position) + w.dot(offset.velocity);
        }
    };

    /// Those above one fence, but for what is the same for all members, which is in the bounds.
    struct Heights {
        Linear first, last;
        double least_first, least_last;
    };

    std::array<Heights, Fences::most> heights_;
    std::size_t count_;
};

} // namespace slod
