#pragma once

#include <string_view>

#include "sim/settings.hpp"

namespace slod {

/// The first of the scene's effects under which its total energy is not conserved, or "attracts" where
/// regions do not attract everything; empty: it is.
std::string_view breaks_energy(const SimulationSettings& settings);

/// Likewise for momentum and angular momentum, which self-gravity alone leaves as they are.
std::string_view breaks_momentum(const SimulationSettings& settings);

} // namespace slod
