#include "sim/state.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cluster/sums_problems.hpp"
#include "core/assert.hpp"
#include "core/parallel.hpp"
#include "sim/integrator.hpp"

namespace slod {
namespace {

const simd::KernelTable* kernels_named(std::string_view isa)
{
    const simd::KernelTable* found = simd::kernels(isa);
    SLOD_ASSERT(found != nullptr);
    return found;
}

ClusterTable::Columns cluster_columns(const Plan& plan)
{
    return {.map = plan.map == MapKind::Full,
            .tide = plan.clocked && plan.has(Phase::Forces),
            .acceleration = plan.has(Phase::Forces),
            .counting_moments = plan.counting_moments,
            .expiry = plan.finite_lives,
            .withheld = plan.withholding,
            .turning = plan.turning,
            .strain = plan.local_air && plan.clocked};
}

MapRule map_rule(const Plan& plan, const UniformFields& fields, double step)
{
    return {plan.map, fields.drag, step, !plan.turning && !plan.local_air};
}

double background_cell_side(const RegionSettings& background, const ParticleSet& initial)
{
    return std::isfinite(background.max_breadth) ? background.max_breadth : spanning_cell_side(initial);
}

SlodTree tree_of(const SimulationSettings& settings, const ParticleSet& initial)
{
    SlodTree tree(settings.background, background_cell_side(settings.background, initial));
    for (const RegionOfInterest& region : settings.regions)
        open_region(tree, region);
    settle(tree);
    return tree;
}

std::vector<Emitter> emitters_of(const SimulationSettings& settings)
{
    std::vector<Emitter> emitters;
    for (const EmitterSettings& emitter : settings.emitters) {
        const auto named = [&](const ParticleKind& kind) { return kind.name == emitter.kind; };
        const auto kind = std::find_if(settings.kinds.begin(), settings.kinds.end(), named);
        SLOD_ASSERT(kind != settings.kinds.end());
        emitters.emplace_back(emitter, std::uint32_t(emitters.size()),
                              std::uint8_t(kind - settings.kinds.begin()), settings.seed);
    }
    return emitters;
}

std::optional<Collisions> collisions_of(const SimulationSettings& settings, const Plan& plan,
                                        const UniformFields& fields, const Air* air)
{
    if (settings.colliders.empty())
        return {};
    const Collisions::Rules rules{.carries_members = plan.map != MapKind::Identity,
                                  .exact = plan.map_is_exact,
                                  .full_map = plan.map == MapKind::Full};
    return Collisions(settings.colliders, fields, settings.time.step, rules, air);
}

std::optional<Draining> draining_of(const SimulationSettings& settings)
{
    return settings.sinks.empty() ? std::nullopt : std::optional<Draining>(std::in_place, settings.sinks);
}

std::optional<Air> air_of(const SimulationSettings& settings, const Plan& plan, const UniformFields& fields)
{
    if (!plan.air)
        return {};
    return std::optional<Air>(std::in_place, fields, settings.quadratic_drag, settings.fields,
                              FieldSource{settings.seed}, settings.time.step);
}

} // namespace

Simulation::State::State(const SimulationSettings& scene, const ParticleSet& initial, const Options& options)
    : settings(scene), plan(compile_plan(scene, initial)), kernels(kernels_named(options.isa)),
      tick(options.tick), gravitational_constant(scene.units.gravitational_constant()),
      fields(scene.uniform_gravity, scene.linear_drag, scene.uniform_wind),
      propagator(fields.over(scene.time.step)),
      store(cluster_columns(plan), {plan.several_masses, plan.several_kinds, plan.finite_lives},
            map_rule(plan, fields, scene.time.step)),
      tree(tree_of(scene, initial)), reforming(scene.motion, context()), regrouping(scene.motion, context()),
      air(air_of(scene, plan, fields)),
      collisions(collisions_of(scene, plan, fields, plan.local_air ? &*air : nullptr)),
      draining(draining_of(scene)),
      emission(emitters_of(scene), fields, 0.5 * scene.motion.longest_life * scene.time.step,
               collisions ? &collisions->colliders() : nullptr, air ? &*air : nullptr,
               draining ? &draining->sinks() : nullptr),
      meter(scene.seed), particle_count(initial.size())
{
    if (scene.gravity)
        gravitational_constant *= scene.gravity->strength;
    else
        gravity.closure = false; // members do not attract each other
    if (plan.member_kicks)
        member_kicks.emplace(scene.speed_limit, scene.brownian, scene.seed);
    if (plan.field_forces)
        field_forces.emplace(scene.fields, FieldSource{scene.seed}, scene.gravity.has_value());
    set_detail();
    tree.merging = tree.merging || plan.merging;
    store.uniform_mass = plan.uniform_mass;
    for (const ParticleKind& kind : scene.kinds)
        store.kind_softening_squared.push_back(kind.softening * kind.softening);
    // By one of its own, so that its room for all particles is given back.
    Reforming(scene.motion, context())
        .found(tree, initial, frame, plan.clocked ? Reforming::Strays::Come : Reforming::Strays::None);
    if (plan.merging && scene.motion.build_respects_limits)
        regrouping.divide_by_velocity(tree, frame);
    make_room();
    look_around();
    if (plan.clocked) {
        // The first forces set the clocks; what was formed without them is formed anew.
        UpdateCounts ignored;
        reforming.reform_all(tree, frame, ignored);
        look_around();
    }
    if constexpr (validating)
        SLOD_ASSERT(problems().empty());
    observe({});
}

void Simulation::State::open(const Request& request)
{
    meter.give_up_late(frame);
    store.members.recycle(meter.recyclable_before(frame + 1));
    if (tree.unsettled)
        settle(tree);
    make_room();
    if (request.error_pairs > 0 && plan.has(Phase::Meter))
        meter.reserve(store.clusters.slot_capacity(), tree.subtrees.size());
    if (std::exchange(forces_stale, false))
        look_around();
    ++frame;
}

void Simulation::State::look_around()
{
    if (plan.has(Phase::Moments))
        measure_moments();
    if (plan.has(Phase::Forces))
        evaluate_forces();
    if (store.clusters.columns.strain)
        air->measure_strain(store.clusters, time());
}

void Simulation::State::make_room()
{
    // All pools may be due at once; splits and merges come one by one.
    const std::uint64_t moving = plan.clocked ? particle_count : particle_count / 8 + 4096;
    const std::uint64_t struck = collisions ? collisions->expected_members(particle_count) : 0;
    const std::uint64_t kicked = member_kicks ? member_kicks->expected_members(particle_count) : 0;
    const std::uint64_t drained = draining ? draining->expected_members(particle_count) : 0;
    const std::uint64_t formed = moving + struck + kicked + drained;
    store.members.reserve(formed + formed / 2, store.clusters.alive_count() / 2 + 1024);
    store.clusters.reserve(store.clusters.alive_count() / 2 + 1024);
    if (plan.finite_lives)
        expiry.reserve(store.clusters);
    for (Subtree& subtree : tree.subtrees)
        reserve(subtree, subtree.pool_count() / 2 + (subtree.region == background_row ? 256 : 32));
    if (plan.clocked)
        reforming.reserve(tree, moving);
    else
        regrouping.reserve(tree, moving);
    if (collisions)
        collisions->reserve(store.clusters, struck);
    if (member_kicks)
        member_kicks->reserve(store.clusters, kicked);
    if (draining)
        draining->reserve(store.clusters, drained);
    if (field_forces)
        field_forces->reserve(store.clusters.slot_capacity());
    if (air)
        air->reserve(store.clusters.slot_capacity());
    if (settings.gravity) {
        reserve(view, store.clusters.slot_capacity(), tree.pool_capacity(), tree.subtrees.size(), gravity);
        reserve(force_lists, store.clusters.slot_capacity());
    }
}

void Simulation::State::kick()
{
    kick_clusters(store.clusters, 0.5 * settings.time.step);
}

/// Newborn clusters are kicked for as long as they have existed, the others for half a step.
void Simulation::State::close_kick()
{
    kick_clusters(store.clusters, 0.5 * settings.time.step);
    for (const Emission::NewCluster& born : emission.new_clusters()) {
        const std::size_t slot = born.id.slot.index;
        if (store.clusters.alive(slot) && store.clusters.id(slot) == born.id) // else re-formed already
            kick_cluster(store.clusters, slot, born.age - 0.5 * settings.time.step);
    }
}

/// Regrouping looks at all that moved, re-forming only at what is due. Without an update nobody else looks at
/// a place either, and a sixteenth in each frame is enough: to look at all would take a tenth of the frame.
bool Simulation::State::places_are_finite() const
{
    constexpr std::size_t many = 10'000;
    if (!plan.has(Phase::Update))
        return all_finite(store.clusters, frame, store.clusters.slot_count() > many ? 16 : 1);
    return !plan.clocked || all_finite(store.clusters);
}

void Simulation::State::propagate()
{
    if (member_kicks) {
        member_kicks->update(tree, {store, frame - 1, settings.time.step});
        snapshot.counts.kicked = member_kicks->changed();
    }
    if (draining)
        draining->remember(context());
    if (air && !plan.local_air)
        turn_wind();
    if (plan.local_air)
        air->ask(store.clusters, double(frame - 1) * settings.time.step);
    if (collisions)
        collisions->fly_members(context());
    if (plan.local_air)
        air->propagate(store.clusters);
    else
        propagate_clusters(store.clusters, propagator);
    if (air)
        note(air->take_counts(), ForceFields::size);
    if (!places_are_finite())
        refuse_unbounded(frame);
    if (collisions) {
        snapshot.counts.died = collisions->put_back(tree, context(), snapshot.counts, snapshot.killed);
        particle_count -= snapshot.counts.died;
    }
}

void Simulation::State::turn_wind()
{
    fields = air->at((double(frame) - 0.5) * settings.time.step, store.clusters.alive_count());
    propagator = fields.over(settings.time.step);
    emission.set_fields(fields);
    if (collisions)
        collisions->set_fields(fields);
}

void Simulation::State::expire()
{
    if (plan.finite_lives) {
        const std::uint64_t died = expiry.update(tree, context());
        snapshot.counts.died += died;
        particle_count -= died;
    }
    if (draining)
        drain();
}

void Simulation::State::drain()
{
    snapshot.drained = draining->update(tree, context());
    snapshot.counts.drained = snapshot.drained.particles;
    snapshot.counts.died += snapshot.drained.particles;
    particle_count -= snapshot.drained.particles;
}

void Simulation::State::emit()
{
    const std::uint64_t room =
        settings.limits.max_particles - std::min(settings.limits.max_particles, particle_count);
    const Emission::Births births = emission.update(tree, context(), plan.has(Phase::CloseKick), room);
    snapshot.counts.born = births.born;
    snapshot.counts.births_refused = births.refused;
    particle_count += snapshot.counts.born;
    make_room(); // for the newborn
}

void Simulation::State::update()
{
    snapshot.counts.reinserted = std::exchange(tree.reinserted, 0);
    if (plan.clocked)
        reforming.update(tree, frame, snapshot.counts);
    else
        regrouping.update(tree, frame, snapshot.counts);
    if (plan.withholding)
        release_velocities(tree, store.clusters);
}

void Simulation::State::measure_moments()
{
    measure_shapes(store, gravity, gravitational_constant, frame);
    if (settings.gravity)
        build(view, tree, store.clusters, gravity);
}

void Simulation::State::evaluate_forces()
{
    if (!field_forces)
        return evaluate_gravity();
    const auto evaluate_fields = [&] { field_forces->evaluate(store.clusters, time()); };
    if (settings.gravity)
        run_both([&] { evaluate_gravity(); }, evaluate_fields);
    else
        evaluate_fields();
    field_forces->add_to(store.clusters);
    note(field_forces->take_counts(), 0);
}

void Simulation::State::evaluate_gravity()
{
    const ForceCounts counts =
        slod::evaluate_gravity(view, *kernels, gravity, gravitational_constant, force_lists, store.clusters);
    snapshot.counts.interactions = counts.interactions;
    snapshot.counts.far_nodes = counts.far_nodes;
    snapshot.unanswered_force = counts.unanswered;
    snapshot.counts.walks = counts.groups;
    snapshot.counts.nodes_tested = counts.nodes_tested;
}

Problems Simulation::State::problems() const
{
    Problems found = slod::problems(tree, store.clusters);
    std::uint64_t members = 0;
    for (const std::uint32_t count : store.clusters.count)
        members += count;
    if (members != particle_count)
        found.push_back("clusters hold " + std::to_string(members) + " particles of " +
                        std::to_string(particle_count));
    const auto add = [&](const Problems& more) { found.insert(found.end(), more.begin(), more.end()); };
    add(sums_problems(store, frame));
    if (settings.gravity)
        add(slod::problems(view, store.clusters));
    return found;
}

} // namespace slod
