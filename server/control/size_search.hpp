#pragma once

#include <cstdint>

namespace slod {

/// Looks for the cluster size at which the error is at its target, by sizes that have been judged one after
/// another. The error may be noisy, change while it is looked for, and jump over the target between two
/// sizes.
///
/// False position (Press et al. 2007, section 9.2) once a size is known on either side, kept away from both
/// ends as errors are noisy; before that, turns as if the error grew with the size itself. An end that what
/// is found later contradicts is forgotten, and looked for near by first. Between two ends that nothing fits
/// between the error jumps, and the lower one is kept. The upper one is tried once more first, as what was
/// found there may be old; again after ever longer times, as the jump may have gone; and at once where the
/// error at the lower one falls, as the jump may have moved.
class SizeSearch {
public:
    SizeSearch();

    /// What size to judge next, where the error was judged to be off its target at `size`. Both are
    /// logarithms of sizes; `excess` is that of the error over its target, not 0. Frames never decrease.
    double next(double size, double excess, std::uint64_t frame);

    /// The error is at its target. Where it leaves it, the size wanted is near by, and what is known is old,
    /// but for a jump.
    void held();

    /// The error jumps over the target above the size that was asked for last, which is as near as can be
    /// had.
    bool kept_below_jump() const { return kept_below_; }

private:
    struct End {
        double size = 0, excess = 0;
        bool known = false;
    };

    struct Trial {
        double excess = 0;          ///< at the lower end when the upper one was last tried
        std::uint64_t patience = 0; ///< frames between that and the next trial
        std::uint64_t next = 0;     ///< frame from which on it is tried
    };

    void note(double size, double excess);
    bool at_jump() const;
    bool trial_is_due(std::uint64_t frame) const;
    double keep_below_jump(double excess, std::uint64_t frame);

    End fine_, coarse_; ///< the error was below its target here, and above it there
    double reach_;      ///< of the next turn where only one of them is known
    bool kept_below_ = false;
    Trial trial_; ///< of the upper end, where the error jumps
};

} // namespace slod
