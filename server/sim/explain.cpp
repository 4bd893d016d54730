#include <cstdio>
#include <numeric>

#include "core/number_text.hpp"
#include "sim/plan.hpp"

namespace slod {
namespace {

template <class Enum>
std::string name_of(Enum value)
{
    return std::string(names(value)[std::size_t(value)]);
}

std::string line(const char* format, std::string_view name, std::string_view what)
{
    char text[160];
    std::snprintf(text, sizeof text, format, int(name.size()), name.data(), int(what.size()), what.data());
    return text;
}

std::string table(const std::string& title, const std::vector<PlannedColumn>& columns)
{
    std::string text = title + "\n";
    std::size_t total = 0;
    for (const PlannedColumn& column : columns) {
        text += line("  %-34.*s %.*s\n", column.name, std::to_string(column.bytes));
        total += column.bytes;
    }
    return text + line("  %-34.*s %.*s\n", "together", std::to_string(total));
}

std::string what_it_does(const PlannedEffect& effect)
{
    if (effect.switched_off)
        return "switched off";
    const std::string left_out =
        effect.powerless == 0 ? ""
                              : "strength 0 left out: " + std::to_string(effect.powerless) + " of them, ";
    return left_out + std::string(effect.active ? effect.acts_on_clusters : "absent");
}

/// What is chosen for the accuracy that was asked for.
std::string gravity_line(const GravitySettings& asked)
{
    const GravitySettings chosen = with_accuracy(asked);
    const std::string given = asked.accuracy > 0 ? ", for accuracy " + number_text(asked.accuracy) : "";
    const std::string bound = chosen.opening == OpeningCriterion::Relative
                                  ? "force_tolerance " + number_text(chosen.force_tolerance)
                                  : "opening_angle " + number_text(chosen.opening_angle);
    return "gravity  " + name_of(chosen.opening) + " opening, " + name_of(chosen.multipoles) + ", " + bound +
           given + "\n";
}

std::string updates(const Plan& plan)
{
    if (plan.clocked)
        return "pools are re-formed by the dynamical clock";
    if (plan.merging)
        return "clusters cross, split and merge by size, breadth, speed ratio and angle";
    return plan.has(Phase::Update) ? "clusters cross cells; size and breadth split them"
                                   : "none: nothing to regroup";
}

} // namespace

std::string explain(const Plan& plan, const SimulationSettings& settings)
{
    std::string text;
    text += "motion   " + name_of(settings.motion.motion) + "\n";
    text += "flow map " + name_of(plan.map) + (plan.map_is_exact ? ", exact at every cluster size\n" : "\n");
    text += "update   " + updates(plan) + "\n";
    if (settings.gravity && settings.effects.runs("gravity"))
        text += gravity_line(*settings.gravity);
    text += "\nphases\n";
    for (std::size_t phase = 0; phase < phase_count; ++phase)
        text += line("  %-34.*s %.*s\n", names(Phase{})[phase], plan.runs[phase] ? "runs" : "absent");
    text += "\neffects\n";
    for (const PlannedEffect& effect : plan.effects)
        text += line("  %-34.*s %.*s\n", effect.name, what_it_does(effect));
    text += "\n" + table("bytes per particle", plan.member_columns);
    text += "\n" + table("bytes per cluster", plan.cluster_columns);
    return text;
}

} // namespace slod
