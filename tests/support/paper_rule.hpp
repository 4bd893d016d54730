#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "support/trace_file.hpp"

namespace slod::test {

/// 1 where the mean work of the three frames that end with `frame` is above the target, -1 where it is below,
/// and 0 where the trace's four decimals do not say (O'Brien et al. 2001, section 6.1).
inline int rule(const std::vector<TracedFrame>& frames, std::size_t frame)
{
    const double mean = (frames[frame - 2].work_ms + frames[frame - 1].work_ms + frames[frame].work_ms) / 3;
    const double excess = mean - frames[frame].target_ms;
    return std::abs(excess) < 3e-4 ? 0 : excess > 0 ? 1 : -1;
}

/// Decisions that were checked.
struct Directions {
    int up = 0, down = 0;
    int all() const { return up + down; }
};

/// Checks each size from `first` on against `next(size, direction)`.
template <class Next>
Directions expect_rule(const std::vector<TracedFrame>& frames, const Next& next, std::size_t first = 0)
{
    Directions checked;
    for (std::size_t frame = first + 2; frame + 1 < frames.size(); ++frame) {
        const int direction = rule(frames, frame);
        if (direction == 0)
            continue;
        ++(direction > 0 ? checked.up : checked.down);
        EXPECT_NEAR(frames[frame + 1].size, next(frames[frame].size, direction), 2e-4 * frames[frame].size)
            << "after row " << frame + 1;
    }
    return checked;
}

} // namespace slod::test
