#include <limits>

#include "core/parallel.hpp"
#include "gravity/potential.hpp"
#include "sim/state.hpp"

namespace slod {
namespace {

std::array<float, 6> covariance(const ClusterStore& store, std::size_t slot, std::uint64_t frame)
{
    const Moments& moments = store.clusters.counting_moments(slot);
    const double number = moments.weight > 0 ? moments.weight : 1.0;
    const Symmetric3 sum = map_position_moments(moments, store.clusters.blocks(slot, store.rule, frame));
    return {float(sum.xx / number), float(sum.xy / number), float(sum.xz / number),
            float(sum.yy / number), float(sum.yz / number), float(sum.zz / number)};
}

} // namespace

void ClusterStates::clear()
{
    position.clear();
    velocity.clear();
    mass.clear();
    count.clear();
    covariance.clear();
    id.clear();
    formation.clear();
    region.clear();
}

void Simulation::State::observe(const Request& request)
{
    snapshot.frame = frame;
    snapshot.time = double(frame) * settings.time.step;
    snapshot.counts.particles = particle_count;
    snapshot.counts.clusters = store.clusters.alive_count();
    snapshot.counts.pools = tree.pool_count();
    snapshot.detail = tree.detail;
    count_regions();
    note_effects();
    snapshot.conserved = {};
    snapshot.potential_energy = std::numeric_limits<double>::quiet_NaN();
    if (request.conserved) {
        snapshot.conserved = conserved_quantities(store, frame);
        if (request.potential_energy)
            snapshot.potential_energy = potential_energy();
    }
    if (request.clusters)
        copy_clusters();
    else
        snapshot.clusters.clear();
}

/// To be called when the conserved quantities are known.
double Simulation::State::potential_energy() const
{
    double energy = -fields.gravity.dot(snapshot.conserved.mass_moment);
    if (field_forces)
        energy += field_forces->potential_energy(store, frame);
    if (!settings.gravity)
        return energy;
    if (!plan.unclustered || view.body_count() > Snapshot::most_pairwise)
        return std::numeric_limits<double>::quiet_NaN();
    return energy + slod::potential_energy(view, *kernels, gravitational_constant);
}

void Simulation::State::count_regions()
{
    snapshot.regions.clear();
    const auto load_of = [&](RegionRow row, std::uint64_t clusters, std::uint64_t particles) -> RegionLoad {
        const RegionSettings& present = tree.subtrees[row].settings;
        return {row, clusters, particles, present.max_cluster_size, present.max_breadth};
    };
    RegionLoad rest = load_of(background_row, store.clusters.alive_count(), particle_count);
    for (const RegionIndex::Entry& entry : tree.index.entries()) {
        RegionLoad load = load_of(entry.row, 0, 0);
        for (const Pool& pool : tree.subtrees[entry.row].pools) {
            load.clusters += pool.node.valid() ? pool.clusters : 0;
            load.particles += pool.node.valid() ? pool.members : 0;
        }
        rest.clusters -= load.clusters;
        rest.particles -= load.particles;
        snapshot.regions.push_back(load);
    }
    snapshot.regions.push_back(rest);
}

void Simulation::State::copy_clusters()
{
    const ClusterTable& clusters = store.clusters;
    ClusterStates& out = snapshot.clusters;
    const std::size_t room = clusters.slot_capacity();
    out.id.reserve(room);
    out.id.clear();
    for (std::size_t slot = 0; slot < clusters.slot_count(); ++slot)
        if (clusters.alive(slot))
            out.id.push_back(clusters.id(slot));
    const std::size_t count = out.id.size();
    const auto resize = [&](auto& column) {
        column.reserve(room);
        column.resize(count);
    };
    resize(out.position);
    resize(out.velocity);
    resize(out.mass);
    resize(out.count);
    resize(out.covariance);
    resize(out.formation);
    resize(out.region);
    for_each_block(count, 1024, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const std::size_t slot = out.id[i].slot.index;
            out.position[i] = clusters.position[slot];
            out.velocity[i] = clusters.velocity[slot];
            out.mass[i] = clusters.mass(slot);
            out.count[i] = clusters.count[slot];
            out.covariance[i] = covariance(store, slot, frame);
            out.formation[i] = clusters.formation[slot];
            out.region[i] = clusters.region[slot];
        }
    });
}

} // namespace slod
