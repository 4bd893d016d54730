#pragma once

#include "cost/trial.hpp"

namespace slod::cost {

/// Pairs of bodies that all threads together evaluate in a second, in float: what the forces would take if
/// they were nothing but pairs.
struct KernelRates {
    double kernel = 0; ///< of the direct sum's kernel, sources in the first-level cache
    double bare = 0;   ///< of a loop with the same arithmetic that never leaves the registers

    double faster() const { return kernel > bare ? kernel : bare; }
};

/// With so many tasks at once, each for a tenth of a second; the best of some rounds, as what disturbs only
/// ever slows. Call it inside the ThreadTeam.
KernelRates measure_kernel_rates(int threads, const Clock& clock);

} // namespace slod::cost
