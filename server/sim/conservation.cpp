#include "sim/conservation.hpp"

#include <algorithm>

namespace slod {
namespace {

/// The first effect that runs and is none of those that `conserves(name)` says.
template <class Conserves>
std::string_view first_but(const SimulationSettings& settings, const Conserves& conserves)
{
    std::string_view first;
    for_each_effect(settings, [&](std::string_view name, const auto& table) {
        if (first.empty() && named(table) && settings.effects.runs(name) && !conserves(name))
            first = name;
    });
    return first;
}

/// Whether it is an acceleration that has a potential.
bool has_potential(std::string_view effect)
{
    bool has = false;
    ForceFields::for_each([&]<class F> {
        if constexpr (requires(const F& field, const Vector3d& x) { field.potential(x); })
            has = has || effect == F::name;
    });
    return has;
}

/// Whether some force has no reaction.
bool is_one_sided(const SimulationSettings& settings)
{
    const auto sided = [](const RegionSettings& partition) {
        return partition.attracts != Attracts::Everything;
    };
    return settings.gravity && settings.effects.runs("gravity") &&
           (sided(settings.background) ||
            std::any_of(settings.regions.begin(), settings.regions.end(),
                        [&](const RegionOfInterest& region) { return sided(region.partition); }));
}

} // namespace

std::string_view breaks_energy(const SimulationSettings& settings)
{
    if (is_one_sided(settings))
        return "attracts";
    return first_but(settings, [](std::string_view name) {
        return name == "gravity" || name == "uniform_gravity" || has_potential(name);
    });
}

std::string_view breaks_momentum(const SimulationSettings& settings)
{
    if (is_one_sided(settings))
        return "attracts";
    return first_but(settings, [](std::string_view name) { return name == "gravity"; });
}

} // namespace slod
