#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "scene/scene.hpp"

namespace slod {

/// One table of a scene file.
struct Section {
    std::string_view name; ///< empty for the keys before the first table
    std::string_view help; ///< one sentence
};

/// The keys before the first table.
struct TopLevel {
    std::string& title;
    std::uint64_t& seed;
};

template <class Visitor>
void for_each_field(TopLevel& top, Visitor&& visit)
{
    visit(Field{"title", "", "What the scene shows, in a few words."}, top.title);
    visit(Field{"seed", "", "Seed of every random number of the scene.", 0, 1e15}, top.seed);
}

/// Calls visit(section, settings) for each table of a scene file that says what is simulated. `settings` is a
/// struct with fields, a std::optional of one (an effect, active when its table is there) or a std::vector of
/// one (a [[table]] for each element).
template <class Visitor>
void for_each_section(SimulationSettings& simulation, Visitor&& visit)
{
    visit(Section{"units", "What one unit of the scene is in SI."}, simulation.units);
    visit(Section{"time", "The passage of time."}, simulation.time);
    visit(Section{"kind", "The kinds of particles, at least one."}, simulation.kinds);
    visit(Section{"motion", "How particles move with their cluster."}, simulation.motion);
    visit(Section{"background", "Partitioning of all space that no other region of interest holds."},
          simulation.background);
    visit(Section{"sharing", "How regions of interest share space."}, simulation.sharing);
    visit(Section{"region", "Regions of interest with a partitioning of their own."}, simulation.regions);
    visit(Section{"gravity", "The particles' attraction for each other."}, simulation.gravity);
    visit(Section{"uniform_gravity", "The same acceleration for everything."}, simulation.uniform_gravity);
    visit(Section{"linear_drag", "Air resistance proportional to the velocity."}, simulation.linear_drag);
    visit(Section{"quadratic_drag", "Air resistance proportional to the square of the velocity."},
          simulation.quadratic_drag);
    visit(Section{"uniform_wind", "Moving air; needs a drag."}, simulation.uniform_wind);
    for_each_field_table(simulation.fields, [&]<class F>(typename F::Table& table) {
        visit(Section{F::name, F::help}, table);
    });
    visit(Section{"speed_limit", "The fastest that a particle may be."}, simulation.speed_limit);
    visit(Section{"brownian", "Random kicks, of each particle by itself: takes as long as without clusters."},
          simulation.brownian);
    visit(Section{"collider", "Solids that particles bounce off."}, simulation.colliders);
    visit(Section{"emitter", "Sources of particles."}, simulation.emitters);
    visit(Section{"sink", "Parts of space in which particles die."}, simulation.sinks);
    visit(Section{"effects", "Which of the scene's effects run; one that is switched off costs nothing."},
          simulation.effects);
    visit(Section{"limits", "What the scene may grow to."}, simulation.limits);
}

/// Likewise for the tables that say how the server runs it.
template <class Visitor>
void for_each_section(LoopSettings& loop, Visitor&& visit)
{
    visit(Section{"server", "How the server runs the scene; the outcome does not depend on it."},
          loop.server);
    visit(Section{"control", "The frame rate and the error, held by changing the level of detail."},
          loop.control);
    visit(Section{"meter", "The error of accelerations, measured while the scene runs."}, loop.meter);
    visit(Section{"alarms", "From where on the server raises an alarm."}, loop.alarms);
}

/// Likewise for every table, in the order of the reference. The two are the only list of tables.
template <class Visitor>
void for_each_section(Scene& scene, Visitor&& visit)
{
    TopLevel top{scene.title, scene.simulation.seed};
    visit(Section{"", "Before the first table."}, top);
    for_each_section(scene.simulation, visit);
    visit(Section{"initial", "The particles at the start."}, scene.initial);
    visit(Section{"galaxy", "The generated galaxy, for the models galaxy and galaxy_pair."}, scene.galaxy);
    visit(Section{"encounter", "The orbit of a galaxy_pair."}, scene.encounter);
    for_each_section(scene.loop, visit);
    visit(Section{"wire", "What is published over DDS."}, scene.wire);
}

} // namespace slod
