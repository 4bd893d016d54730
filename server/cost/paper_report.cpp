#include "cost/paper_report.hpp"

#include <algorithm>
#include <cmath>

#include "core/formatted.hpp"
#include "core/number_text.hpp"

namespace slod::cost {
namespace {

using Json = nlohmann::ordered_json;

std::string name_of(Motion motion)
{
    return std::string(names(motion)[std::size_t(motion)]);
}

std::string name_of(Phase phase)
{
    return std::string(names(phase)[std::size_t(phase)]);
}

/// By which a baseline is named.
std::string letter(std::size_t baseline)
{
    return {char('A' + baseline)};
}

double share(const Clustered& clustered, Phase phase)
{
    const double total = clustered.phases.total();
    return total > 0 ? clustered.phases[phase] / total : 0;
}

std::string head(const PaperRun& run)
{
    std::string text = run.name + "\n";
    for (std::size_t i = 0; i < run.baselines.size(); ++i)
        text += formatted("  %s  %-30s %10.3f ms\n", letter(i).c_str(), run.baselines[i].name.c_str(),
                          run.baselines[i].ms);
    text += formatted("  %-10s %10s", "clusters", "ms");
    for (std::size_t i = 0; i < run.baselines.size(); ++i)
        text += formatted(" %8s/ms", letter(i).c_str());
    return text + formatted(" %8s  %-10s %s\n", "paper", "reached by", "longest phase");
}

std::string line(const Clustered& clustered, const PaperRun& run, const PaperFigures& paper)
{
    std::string text =
        formatted("  %-10s %10.3f", (name_of(clustered.motion) + " " + number_text(clustered.size)).c_str(),
                  clustered.ms);
    for (const Baseline& baseline : run.baselines)
        text += formatted(" %11.2f", baseline.ms / clustered.ms);
    const auto size = std::find(paper.sizes.begin(), paper.sizes.end(), clustered.size);
    std::string factor, reached;
    if (size != paper.sizes.end()) {
        const double wanted = paper.factors[std::size_t(size - paper.sizes.begin())];
        factor = formatted("%.2f", wanted);
        for (std::size_t i = 0; i < run.baselines.size(); ++i)
            reached += run.baselines[i].ms / clustered.ms >= wanted ? letter(i) + " " : "";
    }
    text += formatted(" %8s  %-10s", factor.c_str(), reached.c_str());
    const Phase longest = longest_phase(clustered.phases);
    return text + formatted(" %s %.0f %%\n", name_of(longest).c_str(), 100 * share(clustered, longest));
}

/// "A, C", of the baselines for which it holds; "none of them" for none.
template <class Holds>
std::string letters(const SpeedUps& found, const Holds& holds)
{
    std::string text;
    for (std::size_t i = 0; i < found.over.size(); ++i)
        if (holds(found.over[i]))
            text += (text.empty() ? "" : ", ") + letter(i);
    return text.empty() ? "none of them" : text;
}

std::string claims(const SpeedUps& found, const PaperFigures& paper)
{
    using Over = SpeedUps::Over;
    std::string text = "  " + name_of(found.motion) + ": all speed-ups are at least the paper's over " +
                       letters(found, [](const Over& over) { return over.at_least; }) + "\n    clusters pay";
    for (std::size_t i = 0; i < found.over.size(); ++i) {
        const std::optional<double>& size = found.over[i].break_even;
        text += std::string(i > 0 ? "," : "") + " over " + letter(i) + " " +
                (size ? "from " + number_text(*size) : std::string("never"));
    }
    if (paper.break_even)
        text += formatted("; the paper's from %g, which holds over ", *paper.break_even) +
                letters(found, [](const Over& over) { return over.in_time; });
    text += formatted("\n    speed-up as size^%.2f; the paper's from ^%.2f", found.exponent,
                      paper.least_exponent);
    if (std::isfinite(paper.most_exponent))
        text += formatted(" to ^%.2f", paper.most_exponent);
    return text + (found.exponent_holds ? ": holds\n" : ": deviates\n");
}

Json json_of(const SpeedUps& found)
{
    Json over = Json::array();
    for (const SpeedUps::Over& each : found.over)
        over.push_back({{"speed_ups", each.factors},
                        {"at_least_the_papers", each.at_least},
                        {"break_even", each.break_even ? Json(*each.break_even) : Json()},
                        {"break_even_holds", each.in_time}});
    return {{"motion", name_of(found.motion)},
            {"over_baselines", over},
            {"exponent", found.exponent},
            {"exponent_holds", found.exponent_holds}};
}

Json json_of(const Clustered& clustered)
{
    Json phases;
    for (std::size_t phase = 0; phase < phase_count; ++phase)
        if (clustered.phases.milliseconds[phase] > 0)
            phases[name_of(Phase(phase))] = clustered.phases.milliseconds[phase];
    return {{"motion", name_of(clustered.motion)},
            {"max_cluster_size", clustered.size},
            {"ms", clustered.ms},
            {"phases_ms", phases}};
}

} // namespace

std::string text(const PaperRun& run, const PaperFigures& paper)
{
    std::string text = head(run);
    for (const Clustered& clustered : run.clustered)
        text += line(clustered, run, paper);
    for (const SpeedUps& found : speed_ups(run, paper))
        text += claims(found, paper);
    return text;
}

Json json_of(const PaperRun& run, const PaperFigures& paper)
{
    Json json = {{"name", run.name}, {"baselines", Json::array()}, {"runs", Json::array()}};
    for (const Baseline& baseline : run.baselines)
        json["baselines"].push_back({{"name", baseline.name}, {"ms", baseline.ms}});
    for (const Clustered& clustered : run.clustered)
        json["runs"].push_back(json_of(clustered));
    json["paper"] = {{"max_cluster_sizes", paper.sizes}, {"speed_ups", paper.factors}};
    json["motions"] = Json::array();
    for (const SpeedUps& found : speed_ups(run, paper))
        json["motions"].push_back(json_of(found));
    return json;
}

} // namespace slod::cost
