#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "cluster/motion.hpp"
#include "sim/phase.hpp"

/// Figure 5 of O'Brien et al. 2001: how much faster the fountain and the galaxy are with clusters of at most
/// so many particles than without.
namespace slod::cost {

/// The figure's row of one simulation, and what sections 6.1 and Figure 5 say of it.
struct PaperFigures {
    std::array<double, 4> sizes{8, 16, 32, 64}; ///< largest cluster sizes
    std::array<double, 4> factors{};
    std::optional<double> break_even{};   ///< the size from which clusters pay
    double least_exponent, most_exponent; ///< of a speed-up in proportion to a power of the size
};

/// The fountain's speed-up is "roughly linear": the figure's own exponents from size to size are 0.7 to 1.05.
/// The galaxy's is more than that.
extern const PaperFigures paper_fountain, paper_galaxy;

/// A program without clusters.
struct Baseline {
    std::string name;
    double ms; ///< of a frame, mean
};

/// A run with clusters.
struct Clustered {
    Motion motion;
    double size; ///< largest, particles
    double ms;   ///< of a frame, mean
    StepProfile phases{};
};

/// What was measured of one simulation.
struct PaperRun {
    std::string name;
    std::vector<Baseline> baselines;
    std::vector<Clustered> clustered; ///< by motion, by ascending size
};

/// One motion's row of the figure.
struct SpeedUps {
    /// Beside one of the baselines.
    struct Over {
        std::array<double, 4> factors{};    ///< at the figure's sizes
        bool at_least = false;              ///< each is at least the paper's
        std::optional<double> break_even{}; ///< the least size from which on clusters pay; none may
        bool in_time = false;               ///< that is no larger than the paper's, if it says
    };

    Motion motion;
    std::vector<Over> over{}; ///< by baseline
    double exponent = 0;      ///< of the size, over the figure's sizes
    bool exponent_holds = false;
};

/// `run` must have the figure's sizes in each motion that it has.
std::vector<SpeedUps> speed_ups(const PaperRun& run, const PaperFigures& paper);

/// The phase that takes most of a frame.
Phase longest_phase(const StepProfile& phases);

} // namespace slod::cost
