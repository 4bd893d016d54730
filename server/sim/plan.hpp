#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "cluster/flow_map.hpp"
#include "sim/phase.hpp"
#include "sim/settings.hpp"

namespace slod {

/// One array that the plan allocates.
struct PlannedColumn {
    std::string_view name;
    std::size_t bytes; ///< per particle or per cluster

    friend bool operator==(const PlannedColumn&, const PlannedColumn&) = default;
};

/// An effect the program knows, and whether this scene calls for it.
struct PlannedEffect {
    std::string_view name;
    bool active;
    std::string_view acts_on_clusters; ///< "linear", "linearised", "per member", "births" or "deaths"
    std::size_t powerless = 0;         ///< tables of it that are left out, as their strength is 0
    bool switched_off = false;         ///< the scene has it, and does not want it to run

    /// "active", "off", "powerless" or "absent".
    std::string_view state() const;

    /// Whether what runs is the same: what is powerless does not.
    friend bool operator==(const PlannedEffect& a, const PlannedEffect& b)
    {
        return a.name == b.name && a.active == b.active;
    }
};

/// What a scene comes down to: the phases that run, and the columns that exist. Compiled once from the
/// settings; what a scene does not name is not in it.
struct Plan {
    MapKind map = MapKind::Identity;
    bool map_is_exact = false; ///< maps never age: only size, breadth and regions re-form a cluster
    bool clocked = false;      ///< maps age, and pools are re-formed by the dynamical clock
    bool substeps = false;     ///< frames are cut into sub-steps where tides ask for it
    bool tides = false;        ///< how fast forces change with the place is evaluated with them
    bool unclustered = false;  ///< one particle per cluster everywhere
    bool merging = false;      ///< clusters that move alike merge from the start: SlodTree::merging
    bool finite_lives = false; ///< particles expire
    bool several_kinds = false;
    bool several_masses = false;
    bool field_forces = false;     ///< accelerations depend on the place, besides gravity's
    bool turning = false;          ///< such an acceleration has a curl
    bool air = false;              ///< the air moves, or resists, by more than uniform fields say
    bool local_air = false;        ///< and differs from cluster to cluster
    bool member_kicks = false;     ///< velocities are changed particle by particle
    bool withholding = false;      ///< clusters may move by their first particle's velocity
    bool counting_moments = false; ///< masses differ or are all 0: clusters are also weighed by number
    float uniform_mass = 0;        ///< of every particle, unless several_masses
    std::array<bool, phase_count> runs{};
    std::vector<PlannedEffect> effects; ///< by effect_row()
    std::vector<PlannedColumn> member_columns;
    std::vector<PlannedColumn> cluster_columns;

    bool has(Phase phase) const { return runs[std::size_t(phase)]; }

    friend bool operator==(const Plan&, const Plan&) = default;
};

/// Compiles the plan of a scene that starts with `initial`: of what of its effects is switched on.
Plan compile_plan(const SimulationSettings& settings, const ParticleSet& initial);

/// Takes down of the effects that the scene has which are switched off, and how many are powerless.
void describe_effects(Plan& plan, const SimulationSettings& asked);

/// The plan in words, for --explain: phases, effects active and absent, map kind, columns and bytes.
std::string explain(const Plan& plan, const SimulationSettings& settings);

} // namespace slod
