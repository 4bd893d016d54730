#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "scene/scene.hpp"

namespace slod {

/// The settings in effect, by the tables and keys of a scene file: an object for a table, an array for
/// [[tables]]; effects that the scene does not have are absent, and what is chosen for an accuracy is said as
/// it is. JSON has no infinity: "inf" stands for it.
nlohmann::ordered_json settings_json(const Scene& scene);

/// The same for a log, one line a table: "settings table=time step=0.01".
std::vector<std::string> settings_records(const Scene& scene);

} // namespace slod
