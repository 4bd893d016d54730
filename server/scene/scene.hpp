#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "cluster/particles.hpp"
#include "scene/initial_settings.hpp"
#include "scene/server_settings.hpp"
#include "sim/settings.hpp"

namespace slod {

/// All that a scene file says.
struct Scene {
    std::string title;
    SimulationSettings simulation;
    InitialSettings initial;
    GalaxySettings galaxy;
    EncounterSettings encounter;
    LoopSettings loop;
    WireSettings wire;
};

/// A scene file as it stands. A pipe gives its text but once.
struct SceneText {
    std::string name;               ///< of the file, for problems
    std::string text;               ///< TOML
    std::filesystem::path folder{}; ///< from which the names of other files start; empty: the current one
};

/// Reads the file's text, which is at most 16 MiB.
std::variant<SceneText, Problems> read_scene_text(const std::filesystem::path& file);

/// Reads a scene and then the overrides, "table.key=value" with a TOML value, one each. Every problem is
/// reported, each with file, line, key, value and remedy, and with the overrides that it is owed to. Files of
/// colliders are read, nothing else is read or changed.
std::variant<Scene, Problems> load_scene(const SceneText& text, const std::vector<std::string>& overrides);

/// Likewise, from the file.
std::variant<Scene, Problems> load_scene(const std::filesystem::path& file,
                                         const std::vector<std::string>& overrides);

/// The scene as TOML, one line per key; load_scene reads it back to the same scene.
std::string to_toml(const Scene& scene);

/// Every key of a scene file with unit, default, range and meaning, as text for a terminal.
std::string scene_reference();

/// The particles a scene starts with.
struct InitialParticles {
    ParticleSet particles;
    std::string source;         ///< in words, for the log: which file, or which model and why
    std::filesystem::path file; ///< that was read; empty when none was
};

/// Reads or generates them. `input` (may be empty) names the file instead of the scene's own, which unless
/// absolute is looked up in the environment's SLOD_DATA_DIR. Only when the scene's own file is not there is
/// its fallback generated; a file that is there or named by `input`, but unusable, is a problem. The scene
/// must have no problems.
std::variant<InitialParticles, Problems> load_initial(const Scene& scene, const std::filesystem::path& input);

} // namespace slod
