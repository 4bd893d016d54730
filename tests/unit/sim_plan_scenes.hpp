#pragma once

#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "sim/simulation.hpp"
#include "support/small_scenes.hpp"

// The table of plans: scenes, and what each has to come down to.
namespace slod::test {

using Names = std::vector<std::string>;

Names every_effect();

/// A scene by what it has besides four particles of one kind and mass in clusters of flow motion, and what
/// its plan has to be. Columns are those besides the ones that every scene has.
struct PlannedScene {
    const char* name;
    std::function<void(SmallScene&)> choose;
    Names phases = {"commands", "propagate", "update", "snapshot"};
    Names effects = {};
    MapKind map = MapKind::Scalar;
    bool exact = true, clocked = false, merging = false;
    Names member_columns = {}, cluster_columns = {};

    friend std::ostream& operator<<(std::ostream& out, const PlannedScene& scene)
    {
        return out << scene.name;
    }
};

std::vector<PlannedScene> scenes_of_motion();
std::vector<PlannedScene> scenes_of_particles();
std::vector<PlannedScene> scenes_of_fields();

} // namespace slod::test
