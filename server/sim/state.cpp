#include "sim/state.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cluster/sums_problems.hpp"
#include "core/assert.hpp"
#include "core/parallel.hpp"
#include "sim/integrator.hpp"

namespace slod {

void Simulation::State::open(const Request& request)
{
    meter.give_up_late(frame);
    store.members.recycle(meter.recyclable_before(frame + 1));
    if (tree.unsettled)
        settle(tree);
    metering = request.error_pairs > 0 && plan.has(Phase::Meter);
    make_room();
    if (std::exchange(forces_stale, false))
        look_around();
    ++frame;
    time_left = settings.time.step;
    substeps_left = settings.time.max_substeps;
}

/// After the tides as they are now: equal steps, as far as tides stay so. A close passage is over long before
/// the frame is, so half of the sub-steps may be as short as they need be; what is left then has to do for
/// the rest.
bool Simulation::State::begin_substep()
{
    double rate = 0;
    if (plan.tides)
        timed(snapshot.profile[Phase::OpenKick],
              [&] { rate = std::sqrt(largest_rate_squared(store.clusters)); });
    const double angle = settings.time.substep_angle;
    double parts = std::max(std::ceil(time_left * rate / angle), 1.0);
    const bool spare = 2 * substeps_left > settings.time.max_substeps + 1 && std::isfinite(parts);
    if (!spare && !(parts <= double(substeps_left))) {
        snapshot.counts.under_resolved = 1;
        parts = double(substeps_left);
    }
    ++snapshot.counts.substeps;
    --substeps_left;
    substep = time_left / parts;
    time_left = parts > 1 ? time_left - substep : 0;
    if (plan.substeps)
        propagator = fields.over(substep);
    return parts > 1;
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
    unsound.reserve(store.clusters.slot_capacity());
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
    if (metering)
        meter.reserve(store.clusters.slot_capacity(), tree.subtrees.size());
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
    if (!kick_clusters(store.clusters, 0.5 * substep))
        take_out_unsound(frame - 1);
}

/// Newborn clusters are kicked for as long as they have existed, the others for half a step.
void Simulation::State::close_kick()
{
    bool sound = kick_clusters(store.clusters, 0.5 * substep);
    for (const Emission::NewCluster& born : emission.new_clusters()) {
        const std::size_t slot = born.id.slot.index;
        if (!store.clusters.alive(slot) || !(store.clusters.id(slot) == born.id))
            continue; // re-formed already
        kick_cluster(store.clusters, slot, born.age - 0.5 * substep);
        sound = sound && is_sound(store.clusters, slot, range);
        if (born.age * std::sqrt(store.clusters.rate_squared(slot)) > settings.time.substep_angle)
            snapshot.counts.under_resolved = 1;
    }
    if (sound)
        return;
    take_out_unsound(frame);
    if (settings.gravity)
        build(view, tree, store.clusters, gravity); // which showed them
}

void Simulation::State::take_out_unsound(std::uint64_t counted)
{
    const Quarantined taken = quarantine(tree, {store, counted, settings.time.step}, range, unsound);
    snapshot.quarantined += taken;
    snapshot.counts.quarantined += taken.particles;
    snapshot.counts.died += taken.particles;
    particle_count -= taken.particles;
}

void Simulation::State::propagate()
{
    const bool first = snapshot.counts.substeps == 1;
    if (member_kicks && first) {
        double ms = 0;
        timed(ms, [&] { member_kicks->update(tree, {store, frame - 1, settings.time.step}); });
        snapshot.counts.kicked = member_kicks->changed();
        for (const std::string_view kick : {"speed_limit", "brownian"})
            if (plan.effects[effect_row(kick)].active)
                work_of(kick) = {.particles = snapshot.counts.kicked, .ms = ms};
    }
    if (draining && first)
        draining->remember(context());
    if (air && !plan.local_air)
        turn_wind();
    if (plan.local_air)
        air->ask(store, frame - 1);
    if (collisions)
        timed(work_of("collider").ms, [&] { collisions->fly_members(context()); });
    bool sound;
    if (plan.local_air) {
        air->propagate(store.clusters);
        sound = all_sound(store.clusters, range);
    } else {
        sound = propagate_clusters(store.clusters, propagator, range);
    }
    if (air)
        note(air->take_counts(), air->take_times_ns(), ForceFields::size);
    if (collisions) {
        std::uint64_t killed = 0;
        timed(work_of("collider").ms,
              [&] { killed = collisions->put_back(tree, context(), snapshot.counts, snapshot.killed); });
        snapshot.counts.died += killed;
        particle_count -= killed;
    }
    if (!sound)
        take_out_unsound(frame - 1);
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
        EffectWork& work = work_of("lifetime");
        timed(work.ms, [&] { work.particles = expiry.update(tree, context()); });
        snapshot.counts.died += work.particles;
        particle_count -= work.particles;
    }
    if (draining)
        drain();
}

void Simulation::State::drain()
{
    timed(work_of("sink").ms, [&] { snapshot.drained = draining->update(tree, context()); });
    snapshot.counts.drained = snapshot.drained.particles;
    snapshot.counts.died += snapshot.drained.particles;
    particle_count -= snapshot.drained.particles;
}

void Simulation::State::emit()
{
    const std::uint64_t room =
        settings.limits.max_particles - std::min(settings.limits.max_particles, particle_count);
    Emission::Births births;
    timed(work_of("emitter").ms, [&] {
        births = emission.update(tree, context(), plan.has(Phase::CloseKick) ? 0.5 * substep : 0.0, room);
    });
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

/// Here is the last chance to take out what was born, formed anew or put back out of range: forces see it
/// next.
void Simulation::State::measure_moments()
{
    if (settings.gravity && !all_sound(store.clusters, range))
        take_out_unsound(time_left > 0 ? frame - 1 : frame);
    measure_shapes(store, gravity, gravitational_constant, frame);
    if (settings.gravity)
        build(view, tree, store.clusters, gravity);
}

void Simulation::State::evaluate_forces()
{
    if (!field_forces)
        return evaluate_gravity();
    const auto evaluate_fields = [&] { field_forces->evaluate(store, frame, time()); };
    if (settings.gravity)
        run_both([&] { evaluate_gravity(); }, evaluate_fields);
    else
        evaluate_fields();
    field_forces->add_to(store.clusters);
    note(field_forces->take_counts(), field_forces->take_times_ns(), 0);
}

void Simulation::State::evaluate_gravity()
{
    ForceCounts counts;
    timed(work_of("gravity").ms, [&] {
        counts = slod::evaluate_gravity(view, *kernels, gravity, gravitational_constant, force_lists,
                                        store.clusters);
    });
    snapshot.counts.interactions += counts.interactions;
    snapshot.counts.far_nodes += counts.far_nodes;
    snapshot.unanswered_force = counts.unanswered;
    snapshot.counts.walks += counts.groups;
    snapshot.counts.nodes_tested += counts.nodes_tested;
}

void Simulation::State::note_effects()
{
    for (const std::string_view everywhere :
         {"gravity", "uniform_gravity", "linear_drag", "uniform_wind", "quadratic_drag"})
        if (plan.effects[effect_row(everywhere)].active)
            work_of(everywhere).clusters = snapshot.counts.clusters;
    work_of("collider").clusters = snapshot.counts.struck;
    work_of("collider").particles = snapshot.counts.impacts;
    work_of("emitter").particles = snapshot.counts.born;
    work_of("sink").particles = snapshot.counts.drained;
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
