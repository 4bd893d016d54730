#pragma once

#include <cstddef>

namespace slod::cost {

/// Targets that sum_of_bare_pairs() has in registers.
inline constexpr std::size_t bare_targets = 32;

/// A sum over so many pairs of 32 targets with `sources` sources, by the arithmetic of the gravity kernels on
/// the processor's widest registers, without touching memory: how fast any kernel could be. What it comes to
/// means nothing.
float sum_of_bare_pairs(std::size_t sources);

} // namespace slod::cost
