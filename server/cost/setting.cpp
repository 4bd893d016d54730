#include "cost/setting.hpp"

#include <algorithm>

#include "core/number_text.hpp"

namespace slod::cost {

std::string Setting::name() const
{
    std::string text =
        unclustered() ? "unclustered"
                      : std::string(names(motion)[std::size_t(motion)]) + " " + number_text(max_cluster_size);
    if (clock)
        text += ", clock " + number_text(*clock);
    if (opening)
        text += ", opening " + number_text(*opening);
    if (steps != 1)
        text += ", " + std::to_string(steps) + " steps";
    if (precision)
        text += ", " + std::string(names(*precision)[std::size_t(*precision)]);
    return text;
}

Opening opening_of(const GravitySettings& gravity)
{
    if (gravity.accuracy > 0)
        return {"accuracy", &GravitySettings::accuracy, least_accuracy, most_accuracy, 0.2, 5};
    if (gravity.opening == OpeningCriterion::Geometric)
        return {"opening_angle", &GravitySettings::opening_angle, 0.05, widest_opening, 0.5, 1.6};
    return {"force_tolerance", &GravitySettings::force_tolerance, 1e-6, 0.1, 0.1, 10};
}

SimulationSettings with_setting(const SimulationSettings& scene, const Setting& setting)
{
    SimulationSettings settings = scene;
    settings.motion.motion = setting.motion;
    if (setting.motion != Motion::Rigid) { // what the two others do not have
        settings.motion.merged_velocities = MergedVelocities::Keep;
        settings.motion.build_respects_limits = false;
    }
    const double factor = setting.max_cluster_size / scene.background.max_cluster_size;
    settings.background.max_cluster_size = setting.max_cluster_size;
    for (RegionOfInterest& region : settings.regions)
        region.partition.max_cluster_size = std::max(region.partition.max_cluster_size * factor, 1.0);
    settings.motion.clock = setting.clock.value_or(scene.motion.clock);
    settings.time.step = scene.time.step / setting.steps;
    if (settings.gravity) {
        double& opening = *settings.gravity.*opening_of(*settings.gravity).value;
        opening = setting.opening.value_or(opening);
        settings.gravity->precision = setting.precision.value_or(settings.gravity->precision);
    }
    return settings;
}

Setting in_full(const Setting& setting, const SimulationSettings& scene)
{
    const SimulationSettings settings = with_setting(scene, setting);
    Setting full = setting;
    full.clock = settings.motion.clock;
    if (settings.gravity) {
        full.opening = *settings.gravity.*opening_of(*settings.gravity).value;
        full.precision = settings.gravity->precision;
    }
    return full;
}

} // namespace slod::cost
