#pragma once

#include <cstddef>

namespace slod::test {

/// Keeps the calling team's threads busy until `wanted` of them have taken part, or a thousand rounds of
/// naps have passed, which are far more than it takes; returns how many have.
std::size_t gather_team(std::size_t wanted);

} // namespace slod::test
