#include "gravity/settings.hpp"

#include <array>

#include "core/number_text.hpp"
#include "core/portable_math.hpp"

namespace slod {
namespace {

/// Median errors of walks of quadrupoles by the relative criterion.
struct Calibration {
    double tolerance, median;
};

/// The largest of nine clouds: Plummer sphere, two clumps, disc and box of 20,000 and of 100,000 bodies, and
/// the collision of galaxies (slod-cost forces). The smallest are 0.4 of it. Ascending.
constexpr std::array<Calibration, 6> calibrations{
    {{1e-6, 1.9e-5}, {1e-5, 6.4e-5}, {1e-4, 2.0e-4}, {1e-3, 7.3e-4}, {1e-2, 2.6e-3}, {3e-2, 4.4e-3}}};

/// Along straight lines between the logarithms, the first and last of which go on.
double tolerance_for(double accuracy)
{
    std::size_t upper = 1;
    while (upper + 1 < calibrations.size() && calibrations[upper].median < accuracy)
        ++upper;
    const Calibration& a = calibrations[upper - 1];
    const Calibration& b = calibrations[upper];
    const double along = portable_log(accuracy / a.median) / portable_log(b.median / a.median);
    return a.tolerance * portable_exp(along * portable_log(b.tolerance / a.tolerance));
}

} // namespace

GravitySettings with_accuracy(const GravitySettings& asked)
{
    GravitySettings chosen = asked;
    if (asked.accuracy > 0) {
        chosen.opening = OpeningCriterion::Relative;
        chosen.multipoles = Multipoles::Quadrupole;
        chosen.force_tolerance = tolerance_for(asked.accuracy);
    }
    return chosen;
}

Problems problems(const GravitySettings& gravity)
{
    if (gravity.accuracy <= 0)
        return {};
    Problems found;
    const std::string given = "accuracy = " + number_text(gravity.accuracy);
    if (gravity.accuracy < least_accuracy)
        found.push_back(given + " is less than pairs in float can keep; use at least " +
                        number_text(least_accuracy) + ", or 0 and force_tolerance.");
    const GravitySettings defaults;
    const auto clash = [&](const std::string& key, bool differs) {
        if (differs)
            found.push_back(given + " chooses " + key + ", which is given too; leave one of them out.");
    };
    clash("opening", gravity.opening != defaults.opening);
    clash("multipoles", gravity.multipoles != defaults.multipoles);
    clash("force_tolerance", gravity.force_tolerance != defaults.force_tolerance);
    return found;
}

} // namespace slod
