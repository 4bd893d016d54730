#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "cost/scene_choice.hpp"
#include "cost/sweep.hpp"

namespace slod::cost {

/// slod-cost scene: runs a scene at many settings, and compares each with the unclustered run.
class SceneCommand {
public:
    explicit SceneCommand(CLI::App& app);

    bool chosen() const { return command_->parsed(); }
    int run() const; ///< exit code; what is wrong goes to stderr

private:
    Problems wrong_together() const;
    Sweep sweep(const Scene& scene, const SweepPlan& plan, FinishedRuns& finished) const;
    int report(const Sweep& sweep, const Scene& scene, const std::string& text, int frames) const;
    int write_choice(const std::vector<Row>& rows, const SceneText& text, const Scene& scene) const;

    CLI::App* command_;
    std::filesystem::path scene_, input_, folder_ = "cost";
    std::vector<std::string> settings_;
    bool quick_ = false, fresh_ = false;
    int frames_ = 0;
    int threads_ = 0;
    std::filesystem::path chosen_; ///< the scene file to write
    Wish wish_;
};

} // namespace slod::cost
