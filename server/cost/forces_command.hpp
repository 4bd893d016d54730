#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "cost/force_report.hpp"

namespace slod::cost {

/// slod-cost forces: measures one evaluation of gravity between single particles, and its errors.
class ForcesCommand {
public:
    explicit ForcesCommand(CLI::App& app);

    bool chosen() const { return command_->parsed(); }
    int run() const; ///< exit code; what is wrong goes to stderr

private:
    ForceReport measure(const ParticleSet& bodies) const;

    CLI::App* command_;
    std::string model_ = "plummer";
    std::optional<std::size_t> count_; ///< bodies; none: not given
    double softening_ = 0.01;
    double accuracy_ = 0, theta_ = 0, tolerance_ = 0; ///< 0: not given
    int threads_ = 0;
    int repeats_ = 5;
    std::optional<std::uint64_t> seed_; ///< none: not given
    std::filesystem::path accelerations_;
    bool as_json_ = false;
};

} // namespace slod::cost
