#pragma once

#include <cstddef>
#include <filesystem>

#include <CLI/CLI.hpp>

#include "cost/paper_runs.hpp"
#include "scene/scene.hpp"

namespace slod::cost {

/// slod-cost paper: measures Figures 5 and 9 of O'Brien et al. 2001.
class PaperCommand {
public:
    explicit PaperCommand(CLI::App& app);

    bool chosen() const { return command_->parsed(); }
    int run() const; ///< exit code; what is wrong goes to stderr

private:
    int measure(const Scene& galaxy, const ParticleSet& stars, const Scene& fountain,
                const Scene& with_nozzles) const;

    CLI::App* command_;
    std::filesystem::path scenes_, picture_;
    std::size_t droplets_;
    int threads_ = 0;
    bool as_json_ = false, quick_ = false;
};

} // namespace slod::cost
