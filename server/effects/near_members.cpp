#include "effects/near_members.hpp"

#include <algorithm>

namespace slod {

NearMembers::NearMembers(const ClusterStore& store, ClusterSlot slot, std::uint64_t frame,
                         const Fences& fences, const Flight& flight, double relative)
    : count_(fences.count)
{
    const ClusterTable& clusters = store.clusters;
    const MapBlocks map = clusters.blocks(slot.index, store.rule, frame);
    const MapBlocks::Offset mean = map_centre(clusters, slot.index);
    const Vector3d velocity = clusters.mean_velocity(slot.index) + flight.change;
    const Elapsed& elapsed = flight.elapsed;
    for (std::size_t i = 0; i < count_; ++i) {
        const Fence& fence = fences.all[i];
        const Vector3d& n = fence.normal;
        Heights& heights = heights_[i];
        const Linear rise{map.c.transpose() * n, map.d.transpose() * n};
        heights.first = {map.a.transpose() * n, map.b.transpose() * n};
        heights.last = {heights.first.o + elapsed.drift * rise.o, heights.first.w + elapsed.drift * rise.w};
        const double speed = n.dot(velocity - fence.velocity);
        const double pull = n.dot(flight.acceleration - flight.drag * fence.velocity);
        const double centre = fence.height + elapsed.drift * speed + elapsed.fall * pull;
        // A path sags below its chord by an eighth of its curvature times the time squared, at most.
        const double curvature = pull - flight.drag * (speed - relative);
        const double sag = 0.125 * elapsed.time * elapsed.time * std::max(curvature, 0.0);
        heights.least_first = fence.near + sag - fence.height + heights.first.of(mean);
        heights.least_last = fence.near + sag - centre + heights.last.of(mean);
    }
}

} // namespace slod
