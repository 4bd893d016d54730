#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/settings.hpp"
#include "scene/server_settings.hpp"
#include "sim/settings.hpp"
#include "tree/detail.hpp"

namespace slod {

/// A setting by its key and its value, both as in a scene file.
struct Assignment {
    std::string key;
    std::string value; ///< TOML, or plain text for a string

    friend bool operator==(const Assignment&, const Assignment&) = default;
};

/// Gives fields of a region their values, by the keys of [[region]], in order. Nothing changes unless all are
/// right by themselves, of which the first eight problems are told; what is wrong with the region as a whole
/// is problems(RegionOfInterest)'s to say.
Problems assign_fields(RegionOfInterest& region, std::span<const Assignment> assignments);

/// Likewise settings of the simulation by "table.key", or "table.0.key" of [[tables]], of which the number of
/// those that are there adds one.
Problems assign_fields(SimulationSettings& settings, std::span<const Assignment> assignments);

/// Likewise settings of the loop.
Problems assign_fields(LoopSettings& settings, std::span<const Assignment> assignments);

/// Likewise a level of detail, by its fields' keys.
Problems assign_fields(Detail& detail, std::span<const Assignment> assignments);

/// All fields; assign_fields() makes the same of them.
std::vector<Assignment> fields_of(const RegionOfInterest& region);
std::vector<Assignment> fields_of(const Detail& detail);

} // namespace slod
