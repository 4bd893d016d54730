#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "e2e/server_process.hpp"
#include "support/scratch_folder.hpp"

namespace slod {

using Arguments = std::vector<std::string>;

/// A scene that emits 6,000 droplets a second, each gone after a fifth of one.
inline constexpr const char* fountain = R"(title = "A small fountain"

[[kind]]
name = "water"

[uniform_gravity]
acceleration = [0.0, 0.0, -9.81]

[[emitter]]
name = "jet"
kind = "water"
speed = 10.0
cone_angle = 20.0
rate = 6000.0
lifetime = 0.2

[initial]
model = "none"

[background]
max_breadth = 1.0
)";

/// A folder of the test's own with the fountain in it.
class ServerTest : public testing::Test {
protected:
    ServerTest() { write_file(scene_, fountain); }

    /// Runs the fountain at full speed, off the wire, and returns its report.
    nlohmann::json reported(const Arguments& more)
    {
        Arguments arguments{scene_, "--no-dds", "--free-run", "--report", report_};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ServerRun run = run_server(arguments);
        EXPECT_EQ(run.exit_code, 0) << run.output;
        return nlohmann::json::parse(file_content(report_));
    }

    const ScratchFolder scratch_;
    const std::filesystem::path& folder_ = scratch_.path();
    const std::filesystem::path scene_ = folder_ / "fountain.toml";
    const std::filesystem::path report_ = folder_ / "report.json";
    const std::filesystem::path log_ = folder_ / "input.log";
};

inline bool contains(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

} // namespace slod
