#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "app/line_file.hpp"
#include "cluster/particles.hpp"
#include "core/settings.hpp"
#include "effects/collider_settings.hpp"
#include "scene/assignments.hpp"

namespace slod {

/// Everything a run starts from; the first line of an input log.
struct InputLogHeader {
    std::string version;               ///< of the program that wrote it
    std::string scene_name;            ///< name of the scene file, for messages
    std::string scene_text;            ///< what was in it
    std::vector<std::string> settings; ///< overrides, "table.key=value"
    std::filesystem::path input;       ///< file of initial conditions that was read, absolute; empty: none
    std::string initial_source;        ///< in words, where the first particles came from
    std::uint64_t initial_hash = 0;    ///< content_hash() of them
    std::filesystem::path folder{};    ///< of the scene file, absolute
    std::uint64_t surfaces_hash = 0;   ///< content_hash() of its colliders; 0 where none is from a file
};

/// What may change between frames.
enum class InputKind : std::uint8_t { AddRegion, ChangeRegion, RemoveRegion, ChangeSettings, SetDetail };

constexpr std::array<std::string_view, 5> names(InputKind)
{
    return {"add_region", "change_region", "remove_region", "change_settings", "set_detail"};
}

/// One change, made before a frame.
struct LoggedCommand {
    std::uint64_t frame = 0; ///< first that has the change
    InputKind kind{};
    std::string region;               ///< name; empty for settings and detail
    std::vector<Assignment> settings; ///< all fields of the region or detail, or table.key of what was set

    friend bool operator==(const LoggedCommand&, const LoggedCommand&) = default;
};

/// The outcome; the last line of the log of a run that ended in order.
struct InputLogEnd {
    std::uint64_t frames = 0;
    std::uint64_t state_hash = 0;
};

/// All inputs of a run, in JSON lines: run again, they give the same state hash.
struct InputLog {
    InputLogHeader header;
    std::vector<LoggedCommand> commands; ///< by frame
    std::optional<InputLogEnd> end;
};

/// Reads a log. What is wrong with it comes with file and line.
std::variant<InputLog, Problems> read_input_log(const std::filesystem::path& file);

/// Writes a log as the run goes, so that what a crash leaves can still be read.
class InputLogWriter {
public:
    /// Makes `folder` if need be and starts its input.log; an older one becomes input-1.log, or the next
    /// number that is free. Throws std::system_error.
    InputLogWriter(const std::filesystem::path& folder, const InputLogHeader& header);

    /// Throws std::system_error, as does finish().
    void record(const LoggedCommand& command);

    /// The last line; syncs the file.
    void finish(const InputLogEnd& end);

private:
    /// Whole lines only, so that what a crash leaves can still be read.
    void write_line(const std::string& line);

    LineFile file_;
};

} // namespace slod
