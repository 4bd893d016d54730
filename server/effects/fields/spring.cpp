#include "effects/fields/spring.hpp"

#include <string>

#include "core/number_text.hpp"

namespace slod {
namespace {

bool stable(double stiffness, double step)
{
    return stiffness * step * step < 4;
}

std::string too_stiff(double step)
{
    return " is more than a frame of " + number_text(step) + " can follow; use less than " +
           number_text(4 / (step * step)) + ", or a shorter time.step.";
}

} // namespace

Problems Spring::problems(const Settings& settings, double step)
{
    if (stable(settings.stiffness, step))
        return {};
    return {"stiffness = " + number_text(settings.stiffness) + too_stiff(step)};
}

Problems Spring::problems_together(const Table& springs, double step)
{
    double sum = 0;
    for (const Settings& spring : springs) {
        if (!stable(spring.stiffness, step))
            return {}; // it is refused by itself
        sum += spring.stiffness;
    }
    if (stable(sum, step))
        return {};
    const std::string key(name);
    return {"the sum of " + key + ".0.stiffness to " + key + "." + std::to_string(springs.size() - 1) +
            ".stiffness, " + number_text(sum) + "," + too_stiff(step)};
}

} // namespace slod
