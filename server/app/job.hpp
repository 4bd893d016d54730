#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "app/command_line.hpp"
#include "app/input_log.hpp"
#include "core/settings.hpp"
#include "scene/scene.hpp"

namespace slod {

/// A run that was asked for, with everything it needs read and found sound.
struct Job {
    Scene scene;
    InitialParticles initial;
    InputLogHeader origin;               ///< what the scene and the particles were made from
    std::vector<LoggedCommand> commands; ///< of a replay, by frame
    std::optional<InputLogEnd> expected; ///< of a replay
    std::uint64_t frames = 0;            ///< 0: until stopped
};

/// Reads scene and initial conditions, or the log to replay and what it names.
std::variant<Job, Problems> load_job(const CommandLine& line);

/// For --check: that all is sound, and what was read.
std::string soundness(const Job& job);

/// For --explain: what the scene comes down to.
std::string plan_text(const Job& job);

/// Logs what will run and the settings in effect.
void log_job(const Job& job);

} // namespace slod
