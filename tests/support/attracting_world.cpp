#include "support/attracting_world.hpp"

#include <algorithm>

#include "tree/regrouping.hpp"

namespace slod::test {
namespace {

/// The widest that any of the regions asks for.
double widest_cell_side(const std::vector<ParticleSet>& regions)
{
    double side = 0;
    for (const ParticleSet& particles : regions)
        side = std::max(side, spanning_cell_side(particles));
    return side;
}

} // namespace

AttractingWorld::AttractingWorld(const ParticleSet& particles, double softening)
    : AttractingWorld(std::vector<ParticleSet>{particles}, softening)
{}

AttractingWorld::AttractingWorld(const std::vector<ParticleSet>& regions, double softening)
    : world_({MapKind::Identity, 0, 1}, {.kinds = true}, {.max_cluster_size = 1}, widest_cell_side(regions))
{
    world_.store.kind_softening_squared = {softening * softening, 4 * softening * softening,
                                           100 * softening * softening};
    for (std::size_t region = 0; region < regions.size(); ++region) {
        if (region > 0)
            world_.tree.subtrees.emplace_back(world_.region().settings, std::uint16_t(region),
                                              world_.region().cell_side);
        for (const Particle& particle : regions[region]) {
            Subtree& subtree = world_.tree.subtrees[region];
            const ClusterSlot slot = form(world_.store, {particle});
            link(subtree, clusters(), locate_or_grow(subtree, particle.position), slot);
        }
    }
    UpdateCounts ignored;
    if (regions.size() == 1)
        Regrouping({}, world_.context(0)).update(world_.tree, 0, ignored);
    rebuild();
    for (std::size_t body = 0; body < view.body_count(); ++body)
        bodies.push_back({view.position(body), view.mass[body], view.q[body]});
}

void AttractingWorld::rebuild()
{
    measure_shapes(world_.store, settings, 1, 0);
    build(view, world_.tree, clusters(), settings);
}

ForceCounts AttractingWorld::evaluate(const simd::KernelTable& kernels)
{
    return evaluate_gravity(view, kernels, settings, 1, lists, clusters());
}

ForceCounts AttractingWorld::evaluate_again()
{
    evaluate();
    return evaluate();
}

Vector3d AttractingWorld::exact(std::size_t body) const
{
    return acceleration_at(bodies[body].position, bodies[body].q, bodies, 1, &bodies[body]);
}

std::vector<Vector3d> AttractingWorld::by_id() const
{
    std::vector<Vector3d> sorted;
    for (std::size_t body = 0; body < view.body_count(); ++body) {
        const Slab& slab = world_.store.clusters.slab[view.slot[body].index];
        const std::uint64_t id = *world_.store.members.ids(slab);
        sorted.resize(std::max<std::size_t>(sorted.size(), id));
        sorted[id - 1] = acceleration(body);
    }
    return sorted;
}

AttractingWorld walked(const ParticleSet& particles, double softening)
{
    AttractingWorld world(particles, softening);
    world.settings.direct_below = 0;
    return world;
}

ForceErrors force_errors(const AttractingWorld& world, std::size_t count)
{
    const std::size_t total = world.bodies.size();
    count = std::min(count, total);
    std::vector<double> errors;
    double squares = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t body = i * total / count;
        const Vector3d exact = world.exact(body);
        errors.push_back((world.acceleration(body) - exact).norm() / exact.norm());
        squares += errors.back() * errors.back();
    }
    std::sort(errors.begin(), errors.end());
    return {errors[count / 2], errors[count * 99 / 100], errors.back(), std::sqrt(squares / double(count))};
}

} // namespace slod::test
