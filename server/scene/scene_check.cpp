#include "scene/scene_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "core/number_text.hpp"
#include "scene/kinds.hpp"
#include "scene/value_text.hpp"
#include "sim/conservation.hpp"
#include "sim/snapshot.hpp"
#include "simd/kernels.hpp"

namespace slod {

namespace {

bool may_start_with(const Scene& scene, InitialModel model)
{
    return scene.initial.model == model ||
           (scene.initial.model == InitialModel::Gadget2 && scene.initial.fallback == model);
}

/// One component of the generated galaxy.
struct Component {
    std::string_view name;
    double mass;
    double share; ///< of the galaxy's particles
};

void check_galaxy(const Scene& scene, Problems& found)
{
    const GalaxySettings& galaxy = scene.galaxy;
    const double bulge_share = galaxy.bulge_mass > 0 ? galaxy.bulge_share : 0;
    const double halo_share = 1 - galaxy.disc_share - bulge_share;
    const std::array<Component, 3> components{{{"disc", galaxy.disc_mass, galaxy.disc_share},
                                               {"bulge", galaxy.bulge_mass, galaxy.bulge_share},
                                               {"halo", galaxy.halo_mass, halo_share}}};
    for (const auto& [name, mass, share] : components) {
        if (mass <= 0)
            continue;
        const std::string key = "galaxy." + std::string(name) + "_mass";
        if (share * double(galaxy.particles) < 1)
            found.push_back(key + " = " + float_text(mass) + " has no particle to carry it: the " +
                            std::string(name) + "'s share of galaxy.particles is " + float_text(share) +
                            "; raise the share or set " + std::string(name) + "_mass to 0.");
        if (!kind_index(scene.simulation.kinds, name))
            found.push_back(key + " = " + float_text(mass) +
                            " needs a kind for its particles; add a [[kind]] with "
                            "name = \"" +
                            std::string(name) + "\".");
    }
}

void check_encounter(const EncounterSettings& encounter, Problems& found)
{
    if (encounter.separation <= 0)
        found.push_back("encounter.separation = " + float_text(encounter.separation) +
                        " puts the galaxies into each other; use more than 0.");
    if (encounter.pericentre > encounter.separation)
        found.push_back("encounter.pericentre = " + float_text(encounter.pericentre) +
                        " is larger than encounter.separation = " + float_text(encounter.separation) +
                        "; use at most that.");
}

void check_instruction_set(const ServerSettings& server, Problems& found)
{
    const std::string_view name = names(server.isa)[std::size_t(server.isa)];
    if (simd::kernels(name) != nullptr)
        return;
    std::string runnable(names(InstructionSet::Auto).front());
    for (const simd::KernelTable* table : simd::runnable_kernels())
        runnable += ", " + std::string(table->name);
    found.push_back("server.isa = " + string_text(name) + " does not run on this processor; use one of " +
                    runnable + ".");
}

} // namespace

Problems problems(const LoopSettings& loop)
{
    Problems found;
    for (const std::string& problem : problems(loop.control))
        found.push_back("control." + problem);
    if (loop.control.mode == ControlMode::Error && !loop.meter.enabled)
        found.push_back("control.mode = \"error\" holds what is not measured; set meter.enabled = true.");
    return found;
}

Problems problems(const AlarmSettings& alarms, const SimulationSettings& simulation)
{
    Problems found;
    const auto check = [&](std::string_view key, double limit, std::string_view breaks) {
        if (std::isfinite(limit) && !breaks.empty())
            found.push_back("alarms." + std::string(key) + " = " + number_text(limit) + " limits what " +
                            std::string(breaks) + " does not conserve; use inf, or do without that.");
    };
    check("energy_drift", alarms.energy_drift, breaks_energy(simulation));
    check("momentum_drift", alarms.momentum_drift, breaks_momentum(simulation));
    check("angular_momentum_drift", alarms.angular_momentum_drift, breaks_momentum(simulation));
    const auto clustered = [](const RegionSettings& partition) { return partition.max_cluster_size >= 2; };
    if (std::isfinite(alarms.energy_drift) && simulation.gravity && simulation.effects.runs("gravity") &&
        (clustered(simulation.background) ||
         std::any_of(simulation.regions.begin(), simulation.regions.end(),
                     [&](const RegionOfInterest& region) { return clustered(region.partition); })))
        found.push_back("alarms.energy_drift = " + number_text(alarms.energy_drift) +
                        " needs the potential energy of all pairs, which clusters do not have; use inf, or "
                        "background.max_cluster_size = 1 and at most " +
                        std::to_string(Snapshot::most_pairwise) + " particles.");
    return found;
}

Problems problems(const Scene& scene)
{
    Problems found = problems(scene.simulation);
    const bool pair = may_start_with(scene, InitialModel::GalaxyPair);
    if (pair || may_start_with(scene, InitialModel::Galaxy))
        check_galaxy(scene, found);
    if (pair)
        check_encounter(scene.encounter, found);
    check_instruction_set(scene.loop.server, found);
    for (const std::string& problem : problems(scene.loop))
        found.push_back(problem);
    for (const std::string& problem : problems(scene.loop.alarms, scene.simulation))
        found.push_back(problem);
    if (scene.initial.fallback == InitialModel::Gadget2)
        found.push_back("initial.fallback = \"gadget2\" is what it would fall back from; use none, galaxy or "
                        "galaxy_pair.");
    // The grid's cells follow from the particles at the start; without any they follow from the breadth.
    if (scene.initial.model == InitialModel::None && !std::isfinite(scene.simulation.background.max_breadth))
        found.push_back(
            "background.max_breadth = inf leaves the grid's cells without a size, as there are no "
            "particles at the start; set it to a length, such as a twentieth of what particles fly "
            "through.");
    return found;
}

} // namespace slod
