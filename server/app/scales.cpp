#include "app/scales.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string_view>

#include <spdlog/fmt/fmt.h>

namespace slod {
namespace {

struct NamedUnit {
    std::string_view name;
    double si;
};

// Astronomical units after IAU 2012 resolution B2 and 2015 resolution B3; years are Julian.
constexpr std::array<NamedUnit, 9> lengths{{{"mm", 1e-3},
                                            {"cm", 1e-2},
                                            {"m", 1},
                                            {"km", 1e3},
                                            {"au", 1.495978707e11},
                                            {"ly", 9.4607304725808e15},
                                            {"pc", 3.0856775814913673e16},
                                            {"kpc", 3.0856775814913673e19},
                                            {"Mpc", 3.0856775814913673e22}}};
constexpr std::array<NamedUnit, 5> masses{
    {{"g", 1e-3}, {"kg", 1}, {"t", 1e3}, {"Msun", 1.98841e30}, {"1e10 Msun", 1.98841e40}}};
constexpr std::array<NamedUnit, 7> durations{{{"s", 1},
                                              {"h", 3600},
                                              {"d", 86400},
                                              {"yr", 3.15576e7},
                                              {"kyr", 3.15576e10},
                                              {"Myr", 3.15576e13},
                                              {"Gyr", 3.15576e16}}};

/// Scenes give their units with three or four digits.
constexpr double same_unit = 2e-3;

std::string unit_name(std::span<const NamedUnit> units, double si, std::string_view si_name)
{
    for (const NamedUnit& unit : units)
        if (std::abs(si / unit.si - 1) < same_unit)
            return std::string(unit.name);
    return fmt::format("{:.4g} {}", si, si_name);
}

} // namespace

std::vector<double> round_numbers(double low, double high, int intervals)
{
    const double ideal = (high - low) / intervals;
    const double power = std::pow(10, std::floor(std::log10(ideal)));
    double step = 10 * power;
    for (const double factor : {5, 2, 1})
        if (factor * power >= ideal)
            step = factor * power;
    std::vector<double> numbers;
    for (double index = std::ceil(low / step); index * step <= high; ++index)
        numbers.push_back(index * step + 0.0); // the sum is never -0
    return numbers;
}

std::string length_unit(const Units& units)
{
    return unit_name(lengths, units.length_m, "m");
}

std::string mass_unit(const Units& units)
{
    return unit_name(masses, units.mass_kg, "kg");
}

std::string duration_text(double seconds)
{
    const NamedUnit* best = durations.data();
    for (const NamedUnit& unit : durations)
        if (std::abs(seconds) >= unit.si)
            best = &unit;
    return fmt::format("{:.4g} {}", seconds / best->si, best->name);
}

std::string grouped(std::uint64_t number)
{
    std::string digits = std::to_string(number);
    for (auto place = std::ptrdiff_t(digits.size()) - 3; place > 0; place -= 3)
        digits.insert(std::size_t(place), 1, ',');
    return digits;
}

} // namespace slod
