#pragma once

#include <cstddef>
#include <string>

#include "cost/force_trial.hpp"
#include "cost/kernel_rates.hpp"

namespace slod::cost {

/// What one evaluation of the forces cost, and how exact it was.
struct ForceReport {
    std::string model;
    std::size_t bodies = 0;
    int threads = 1;
    double softening = 0;
    GravitySettings gravity{};
    ForceTrial trial{};
    KernelRates rates{}; ///< in the same run, of the same threads
    double tree_seconds =
        0;                 ///< of forming the clusters and their tree from nothing, which no evaluation does
    double body_bytes = 0; ///< memory that the evaluation takes, by body

    /// Pairs a body that the faster of the kernel and the bare loop evaluates in the same time: a measure
    /// that does not depend on the machine.
    double normalised_cost() const { return trial.seconds * rates.faster() / double(bodies); }
};

/// Fills in what `asked`, with its model, numbers and settings, leaves open. Call it inside a ThreadTeam of
/// asked.threads.
ForceReport measure(ForceWorld& world, const ExactForces& exact, const ForceReport& asked, int repeats,
                    const Clock& clock);

/// In SI units, on one line.
std::string json_text(const ForceReport& report);

/// For a terminal: a line per figure.
std::string text(const ForceReport& report);

/// One line of a table, for a terminal and comma-separated, and what its columns are.
std::string table_head();
std::string table_row(const ForceReport& report);
std::string csv_head();
std::string csv_row(const ForceReport& report);

} // namespace slod::cost
