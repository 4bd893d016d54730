#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace slod::cost {

/// slod-cost scene: runs a scene at many settings, and compares each with the unclustered run.
class SceneCommand {
public:
    explicit SceneCommand(CLI::App& app);

    bool chosen() const { return command_->parsed(); }
    int run() const; ///< exit code; what is wrong goes to stderr

private:
    CLI::App* command_;
    std::filesystem::path scene_, input_, folder_ = "cost";
    std::vector<std::string> settings_;
    bool quick_ = false;
    int frames_ = 0;
    int threads_ = 0;
};

} // namespace slod::cost
