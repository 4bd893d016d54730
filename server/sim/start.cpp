#include <algorithm>
#include <cmath>
#include <utility>

#include "core/assert.hpp"
#include "sim/state.hpp"

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
            .tide = plan.tides,
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

std::vector<Emitter> emitters_of(const SimulationSettings& settings, const simd::NumberKernels& numbers)
{
    std::vector<Emitter> emitters;
    for (const EmitterSettings& emitter : settings.emitters) {
        const auto named = [&](const ParticleKind& kind) { return kind.name == emitter.kind; };
        const auto kind = std::find_if(settings.kinds.begin(), settings.kinds.end(), named);
        SLOD_ASSERT(kind != settings.kinds.end());
        emitters.emplace_back(emitter, std::uint32_t(emitters.size()),
                              std::uint8_t(kind - settings.kinds.begin()), settings.seed, numbers);
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

std::optional<Air> air_of(const SimulationSettings& settings, const Plan& plan, const UniformFields& fields,
                          const Tick& tick, const simd::KernelTable& kernels)
{
    if (!plan.air)
        return {};
    return std::optional<Air>(std::in_place, fields, settings.quadratic_drag, settings.fields,
                              FieldSource{settings.seed, &kernels.waves}, settings.time.step, tick);
}

} // namespace

Simulation::State::State(const SimulationSettings& wanted, const ParticleSet& initial, const Options& options)
    : State(wanted, initial, options, {tree_of(wanted, initial)})
{}

Simulation::State::State(const SimulationSettings& wanted, const ParticleSet& initial, const Options& options,
                         Start start)
    : asked(wanted), settings(called_for(wanted)), plan(compile_plan(wanted, initial)),
      kernels(kernels_named(options.isa)), tick(options.tick),
      gravitational_constant(settings.units.gravitational_constant()),
      fields(settings.uniform_gravity, settings.linear_drag, settings.uniform_wind),
      propagator(fields.over(settings.time.step)), range(scene_range(settings)), substep(settings.time.step),
      frame(start.frame),
      store(cluster_columns(plan), {plan.several_masses, plan.several_kinds, plan.finite_lives},
            map_rule(plan, fields, settings.time.step)),
      tree(std::move(start.tree)), reforming(settings.motion, context()),
      regrouping(settings.motion, context()), air(air_of(settings, plan, fields, tick, *kernels)),
      collisions(collisions_of(settings, plan, fields, plan.local_air ? &*air : nullptr)),
      draining(draining_of(settings)),
      emission(emitters_of(settings, kernels->numbers), fields,
               0.5 * settings.motion.longest_life * settings.time.step,
               collisions ? &collisions->colliders() : nullptr, air ? &*air : nullptr,
               draining ? &draining->sinks() : nullptr),
      meter(settings.seed), particle_count(initial.size())
{
    store.clusters.formations = start.formations;
    store.clusters.generations = start.generations;
    if (settings.gravity)
        gravitational_constant *= settings.gravity->strength;
    else
        gravity.closure = false; // members do not attract each other
    if (plan.member_kicks)
        member_kicks.emplace(settings.speed_limit, settings.brownian, settings.seed);
    if (plan.field_forces)
        field_forces.emplace(settings.fields, field_source(), settings.gravity.has_value(), tick);
    set_detail();
    tree.merging = tree.merging || plan.merging;
    if (tree.regions.size() > 1)
        plan.runs[std::size_t(Phase::Update)] = true;
    store.uniform_mass = plan.uniform_mass;
    for (const ParticleKind& kind : settings.kinds)
        store.kind_softening_squared.push_back(kind.softening * kind.softening);
    form_clusters(initial);
    if constexpr (validating)
        require_none(problems());
    observe({});
}

std::unique_ptr<Simulation::State> Simulation::State::with(const SimulationSettings& wanted,
                                                           const ParticleSet& particles) const
{
    const auto& generation = store.clusters.generation;
    const auto latest = std::max_element(generation.begin(), generation.end());
    return std::make_unique<State>(
        wanted, particles, Options{kernels->name, tick},
        Start{.tree = SlodTree::with_regions_of(tree),
              .frame = frame,
              .formations = store.clusters.formations,
              .generations = latest != generation.end() ? *latest : store.clusters.generations});
}

void Simulation::State::form_clusters(const ParticleSet& particles)
{
    // By one of its own, so that its room for all particles is given back.
    Reforming(settings.motion, context())
        .found(tree, particles, frame, plan.clocked ? Reforming::Strays::Come : Reforming::Strays::None);
    if (plan.merging && settings.motion.build_respects_limits)
        regrouping.divide_by_velocity(tree, frame);
    make_room();
    look_around();
    if (plan.clocked) {
        // The first forces set the clocks; what was formed without them is formed anew.
        UpdateCounts ignored;
        reforming.reform_all(tree, frame, ignored);
        look_around();
    }
}

} // namespace slod
