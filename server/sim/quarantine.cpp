#include "sim/quarantine.hpp"

#include <algorithm>

#include "tree/grouping.hpp"

namespace slod {

Quarantined& Quarantined::operator+=(const Quarantined& other)
{
    const std::size_t known = ids().size(), room = most_named - known;
    std::copy_n(other.first_ids.begin(), std::min(room, other.ids().size()),
                first_ids.begin() + std::ptrdiff_t(known));
    particles += other.particles;
    mass += other.mass;
    return *this;
}

double scene_range(const SimulationSettings& settings)
{
    double range = largest_number;
    if (settings.gravity && settings.gravity->precision == Precision::Mixed)
        for (const ParticleKind& kind : settings.kinds)
            if (kind.softening > 0)
                range = std::min(range, 1e22 * kind.softening);
    return range;
}

bool is_sound(const ClusterTable& clusters, std::size_t slot, double range)
{
    return in_range(clusters.position[slot], range) && in_range(clusters.velocity[slot], largest_number) &&
           (!clusters.columns.map || is_finite(clusters.map[slot]));
}

Quarantined quarantine(SlodTree& tree, const UpdateContext& context, double range,
                       std::vector<ClusterSlot>& unsound)
{
    const ClusterTable& clusters = context.store.clusters;
    Quarantined taken;
    unsound.clear();
    for (std::uint32_t slot = 0; slot < clusters.slot_count(); ++slot) {
        if (!clusters.alive(slot) || is_sound(clusters, slot, range))
            continue;
        unsound.push_back({slot});
        Quarantined members{.particles = clusters.count[slot], .mass = clusters.mass(slot)};
        for (std::uint32_t i = 0; i < members.ids().size(); ++i)
            members.first_ids[i] = member_at(context.store, {slot}, context.frame, i).id;
        taken += members;
    }
    end_clusters(tree, unsound, context);
    return taken;
}

} // namespace slod
