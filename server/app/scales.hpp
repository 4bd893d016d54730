#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/settings.hpp"

namespace slod {

/// The multiples of a round step (1, 2 or 5 times a power of ten) in [low, high], with at most `intervals`
/// steps between them and, as far as round steps go, no fewer than two fifths of that. `low` < `high`.
std::vector<double> round_numbers(double low, double high, int intervals);

/// The scene's unit of length: "kpc", or "3.2e+18 m" where it has no name.
std::string length_unit(const Units& units);

/// The scene's unit of mass: "kg", "1e10 Msun", or the number of kilograms.
std::string mass_unit(const Units& units);

/// A span of time in the largest fitting of s, h, d, yr, kyr, Myr and Gyr: "117 Myr".
std::string duration_text(double seconds);

/// 1234567 as "1,234,567".
std::string grouped(std::uint64_t number);

} // namespace slod
