#include "sim/quarantine.hpp"

#include <algorithm>

#include "tree/grouping.hpp"

namespace slod {

Quarantined& Quarantined::operator+=(const Quarantined& other)
{
    particles += other.particles;
    mass += other.mass;
    const std::size_t room = most_named - ids.size();
    ids.insert(ids.end(), other.ids.begin(),
               other.ids.begin() + std::ptrdiff_t(std::min(room, other.ids.size())));
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

Quarantined quarantine(SlodTree& tree, const UpdateContext& context, double range)
{
    const ClusterTable& clusters = context.store.clusters;
    Quarantined taken;
    std::vector<ClusterSlot> unsound;
    ParticleSet members;
    for (std::uint32_t slot = 0; slot < clusters.slot_count(); ++slot) {
        if (!clusters.alive(slot) || is_sound(clusters, slot, range))
            continue;
        unsound.push_back({slot});
        taken.particles += clusters.count[slot];
        taken.mass += clusters.mass(slot);
        members.resize(clusters.count[slot]);
        map_out(context.store, {slot}, context.frame, members);
        for (std::size_t i = 0; i < members.size() && taken.ids.size() < Quarantined::most_named; ++i)
            taken.ids.push_back(members[i].id);
    }
    end_clusters(tree, unsound, context);
    return taken;
}

} // namespace slod
