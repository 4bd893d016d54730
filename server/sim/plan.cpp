#include "sim/plan.hpp"

#include <algorithm>
#include <cmath>

#include "cluster/cluster_table.hpp"
#include "cluster/member_pool.hpp"
#include "effects/fields/field_set.hpp"

namespace slod {
namespace {

void decide_masses(Plan& plan, const SimulationSettings& settings, const ParticleSet& initial)
{
    std::vector<float> masses;
    const auto note = [&](float mass) {
        if (masses.empty() || masses.front() != mass)
            masses.push_back(mass);
    };
    for (const Particle& particle : initial)
        if (masses.size() < 2)
            note(particle.mass);
    for (const EmitterSettings& emitter : settings.emitters)
        note(float(emitter.particle_mass));
    plan.several_masses = masses.size() > 1;
    plan.uniform_mass = masses.empty() ? 0 : masses.front();
    plan.counting_moments = plan.several_masses || !(plan.uniform_mass > 0);
}

void decide_fields(Plan& plan, const SimulationSettings& settings)
{
    const FieldSet<ForceFields> forces(settings.fields, {settings.seed});
    plan.field_forces = !forces.empty();
    plan.turning = !forces.symmetric();
    const bool quadratic = settings.quadratic_drag && settings.quadratic_drag->coefficient > 0;
    const FieldSet<AirFields> winds(settings.fields, {settings.seed});
    plan.air = quadratic || !winds.empty();
    plan.local_air = quadratic || !winds.uniform();
    plan.member_kicks = settings.speed_limit || (settings.brownian && settings.brownian->strength > 0);
}

void decide_map(Plan& plan, const SimulationSettings& settings)
{
    const bool position_dependent = settings.gravity.has_value() || plan.field_forces || plan.local_air;
    const Motion motion = settings.motion.motion;
    const auto single = [](const RegionSettings& partition) { return partition.max_cluster_size < 2; };
    const auto of_singles = [&](const RegionOfInterest& region) { return single(region.partition); };
    plan.unclustered = single(settings.background) &&
                       std::all_of(settings.regions.begin(), settings.regions.end(), of_singles);
    if (plan.unclustered || motion == Motion::Rigid)
        plan.map = MapKind::Identity;
    else if (position_dependent && motion == Motion::Flow)
        plan.map = MapKind::Full;
    else
        plan.map = MapKind::Scalar;
    plan.map_is_exact = plan.unclustered || (plan.map == MapKind::Scalar && !position_dependent);
    plan.clocked = !plan.map_is_exact && plan.map != MapKind::Identity;
    const auto by_first = [](const RegionSettings& partition) {
        return partition.cluster_velocity == ClusterVelocity::First;
    };
    plan.withholding =
        by_first(settings.background) ||
        std::any_of(settings.regions.begin(), settings.regions.end(),
                    [&](const RegionOfInterest& region) { return by_first(region.partition); });
    plan.merging = !plan.unclustered && (motion == Motion::Rigid || !settings.regions.empty() ||
                                         !settings.colliders.empty() || plan.member_kicks);
}

void decide_phases(Plan& plan, const SimulationSettings& settings)
{
    const auto runs = [&](Phase phase, bool needed) { plan.runs[std::size_t(phase)] = needed; };
    const bool kicked = settings.gravity.has_value() || plan.field_forces;
    runs(Phase::Commands, true);
    runs(Phase::OpenKick, kicked);
    runs(Phase::Propagate, true);
    runs(Phase::Expire, plan.finite_lives || !settings.sinks.empty());
    runs(Phase::Emit, !settings.emitters.empty());
    runs(Phase::Update, kicked || plan.local_air || !plan.unclustered || !settings.regions.empty());
    runs(Phase::Moments, settings.gravity.has_value() || plan.clocked);
    runs(Phase::Forces, kicked);
    runs(Phase::CloseKick, kicked);
    plan.substeps = kicked && settings.time.max_substeps > 1;
    plan.tides = kicked && (plan.clocked || plan.substeps);
    plan.turning = plan.turning && plan.tides;
    runs(Phase::Snapshot, true);
    const bool drags = settings.linear_drag || plan.air;
    const bool rigid = plan.map == MapKind::Identity && !plan.unclustered;
    runs(Phase::Meter, kicked || plan.local_air || (rigid && drags)); // else members get what they should
}

void list_columns(Plan& plan)
{
    plan.member_columns = {{"offset and relative velocity", sizeof(FormedOffset)}, {"particle id", 8}};
    const auto member = [&](bool needed, std::string_view name, std::size_t bytes) {
        if (needed)
            plan.member_columns.push_back({name, bytes});
    };
    member(plan.several_masses, "mass", 4);
    member(plan.several_kinds, "kind", 1);
    member(plan.finite_lives, "expiry frame", 4);

    plan.cluster_columns = {{"position and velocity", 2 * sizeof(Vector3d)},
                            {"moments", sizeof(Moments)},
                            {"bounds and softening", 3 * sizeof(float)},
                            {"slab and counts", sizeof(Slab) + 2 * sizeof(std::uint32_t)},
                            {"identity and place in the tree", 2 * 8 + 4 + 2 + 3 * 4}};
    const auto cluster = [&](bool needed, std::string_view name, std::size_t bytes) {
        if (needed)
            plan.cluster_columns.push_back({name, bytes});
    };
    cluster(plan.map == MapKind::Full, "flow map and closure", sizeof(FlowMap) + sizeof(double));
    cluster(plan.counting_moments, "moments by number", sizeof(Moments));
    cluster(plan.finite_lives, "next expiry", 4);
    cluster(plan.withholding, "velocity withheld", sizeof(Vector3d));
    cluster(plan.has(Phase::Forces), "acceleration and variance", sizeof(Vector3d) + 2 * sizeof(double));
    cluster(plan.clocked && !plan.has(Phase::Forces), "variance", sizeof(double));
    cluster(plan.tides, "tidal tensor", sizeof(Symmetric3));
    cluster(plan.turning, "curl of the acceleration", sizeof(Vector3d));
    cluster(plan.field_forces, "fields", sizeof(FieldValue));
    cluster(plan.local_air, "winds", sizeof(FieldValue));
    cluster(plan.local_air && plan.clocked, "strain", sizeof(double));
}

void list_effects(Plan& plan, const SimulationSettings& settings)
{
    plan.effects = {{"gravity", settings.gravity.has_value(), "linearised"},
                    {"uniform_gravity", settings.uniform_gravity.has_value(), "linear"},
                    {"linear_drag", settings.linear_drag.has_value(), "linear"},
                    {"uniform_wind", settings.uniform_wind.has_value(), "linear"}};
    const bool drags = settings.quadratic_drag && settings.quadratic_drag->coefficient > 0;
    plan.effects.push_back({"quadratic_drag", drags, "linearised", settings.quadratic_drag && !drags});
    for_each_field_table(settings.fields, [&]<class F>(const typename F::Table& table) {
        const auto all = elements(table);
        const auto acts = [&](const auto& each) { return F(each, {settings.seed}).acts(); };
        const auto active = std::size_t(std::count_if(all.begin(), all.end(), acts));
        plan.effects.push_back({F::name, active > 0, "linearised", all.size() - active});
    });
    plan.effects.push_back({"speed_limit", settings.speed_limit.has_value(), "per member"});
    const bool shakes = settings.brownian && settings.brownian->strength > 0;
    plan.effects.push_back({"brownian", shakes, "per member", settings.brownian && !shakes});
    plan.effects.push_back({"collider", !settings.colliders.empty(), "per member"});
    plan.effects.push_back({"emitter", !settings.emitters.empty(), "births"});
    plan.effects.push_back({"lifetime", plan.finite_lives, "deaths"});
    plan.effects.push_back({"sink", !settings.sinks.empty(), "per member"});
}

} // namespace

std::string_view PlannedEffect::state() const
{
    if (active)
        return "active";
    if (switched_off)
        return "off";
    return powerless > 0 ? "powerless" : "absent";
}

void describe_effects(Plan& plan, const SimulationSettings& asked)
{
    list_effects(plan, called_for(asked));
    for_each_effect(asked, [&](std::string_view name, const auto& table) {
        plan.effects[effect_row(name)].switched_off = named(table) && !asked.effects.runs(name);
    });
}

Plan compile_plan(const SimulationSettings& asked, const ParticleSet& initial)
{
    const SimulationSettings settings = called_for(asked);
    Plan plan;
    plan.several_kinds = settings.kinds.size() > 1;
    const auto mortal = [](const EmitterSettings& emitter) { return std::isfinite(emitter.lifetime); };
    const auto expires = [](const Particle& particle) { return particle.expiry_frame != Particle::never; };
    plan.finite_lives = std::any_of(settings.emitters.begin(), settings.emitters.end(), mortal) ||
                        std::any_of(initial.begin(), initial.end(), expires);
    decide_masses(plan, settings, initial);
    decide_fields(plan, settings);
    decide_map(plan, settings);
    decide_phases(plan, settings);
    list_columns(plan);
    describe_effects(plan, asked);
    return plan;
}

} // namespace slod
