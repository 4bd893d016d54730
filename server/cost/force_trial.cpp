#include "cost/force_trial.hpp"

#include <algorithm>
#include <cmath>

#include "cost/quantile.hpp"
#include "simd/kernels.hpp"
#include "tree/reforming.hpp"

namespace slod::cost {
namespace {

ClusterStore store_of_singles(double softening)
{
    ClusterStore store({.acceleration = true}, {.mass = true}, {MapKind::Identity, 0, 1});
    store.kind_softening_squared = {softening * softening};
    return store;
}

template <class Vector>
std::size_t bytes_of(const Vector& vector)
{
    return vector.size() * sizeof(typename Vector::value_type);
}

} // namespace

ForceWorld::ForceWorld(const ParticleSet& bodies, double softening)
    : store_(store_of_singles(softening)), tree_({.max_cluster_size = 1}, spanning_cell_side(bodies))
{
    Reforming({}, {store_, 0, 1}).found(tree_, bodies, 0, Reforming::Strays::None);
}

void ForceWorld::rebuild()
{
    measure_shapes(store_, gravity_, 1, 0);
    build(view_, tree_, store_.clusters, gravity_);
}

ForceCounts ForceWorld::evaluate()
{
    return evaluate_gravity(view_, simd::kernels(), gravity_, 1, lists_, store_.clusters);
}

std::vector<Vector3d> ForceWorld::accelerations() const
{
    const ClusterTable& clusters = store_.clusters;
    std::vector<Vector3d> all(clusters.alive_count());
    for (std::size_t slot = 0; slot < clusters.slot_count(); ++slot)
        all[*store_.members.ids(clusters.slab[slot]) - 1] = clusters.acceleration[slot];
    return all;
}

std::size_t ForceWorld::bytes() const
{
    const ForceView& v = view_;
    return bytes_of(v.x) + bytes_of(v.y) + bytes_of(v.z) + bytes_of(v.mass) + bytes_of(v.q) +
           bytes_of(v.slot) + bytes_of(v.nodes) + bytes_of(v.second_moments) + bytes_of(v.cells) +
           bytes_of(v.pools) + bytes_of(lists_.runs) + bytes_of(lists_.counts) +
           bytes_of(store_.clusters.acceleration) + bytes_of(store_.clusters.pull);
}

ForceTrial measure_forces(ForceWorld& world, const ExactForces& exact, int repeats, const Clock& clock)
{
    world.rebuild();
    world.evaluate();
    ForceTrial trial;
    std::vector<double> whole, built;
    for (int repeat = 0; repeat < repeats; ++repeat) {
        const double start = clock();
        world.rebuild();
        const double view_done = clock();
        trial.counts = world.evaluate();
        whole.push_back(1e-3 * (clock() - start));
        built.push_back(1e-3 * (view_done - start));
    }
    trial.seconds = quantile(whole, 0.5);
    trial.build_seconds = quantile(built, 0.5);
    trial.error = force_errors(world.accelerations(), exact);
    return trial;
}

} // namespace slod::cost
