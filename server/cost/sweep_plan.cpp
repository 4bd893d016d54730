#include "cost/sweep_plan.hpp"

#include <algorithm>
#include <array>

#include "sim/plan.hpp"

namespace slod::cost {
namespace {

constexpr double shortest_clock = 1e-3, longest_clock = 10; ///< of MotionSettings

/// Evenly spread over the front of the motion's clusters.
std::vector<Row> points_of_front(std::vector<Row> rows, Motion motion, int count)
{
    std::erase_if(rows, [](const Row& row) { return row.setting.unclustered(); });
    const std::vector<Row> front = pareto_front(rows, motion);
    std::vector<Row> points;
    const std::size_t wanted = std::min(front.size(), std::size_t(count));
    for (std::size_t i = 0; i < wanted; ++i)
        points.push_back(front[(2 * i + 1) * front.size() / (2 * wanted)]);
    return points;
}

/// The setting with one value changed, in all ways that are to be tried.
class Variations {
public:
    Variations(const SweepPlan& plan, const SimulationSettings& scene, const ParticleSet& initial)
        : plan_(plan), scene_(scene), initial_(initial)
    {}

    std::vector<Setting> of(const Row& row) const
    {
        std::vector<Setting> found;
        const Setting full = in_full(row.setting, scene_);
        if (compile_plan(with_setting(scene_, row.setting), initial_).clocked)
            for (const double factor : plan_.clocks)
                found.push_back(with(row.setting, &Setting::clock,
                                     std::clamp(*full.clock * factor, shortest_clock, longest_clock)));
        for (const std::uint32_t steps : plan_.steps) {
            found.push_back(row.setting);
            found.back().steps = steps;
        }
        if (scene_.gravity) {
            if (row.clusters >= scene_.gravity->direct_below)
                add_openings(found, row.setting, *full.opening);
            found.push_back(
                with(row.setting, &Setting::precision,
                     *full.precision == Precision::Double ? Precision::Mixed : Precision::Double));
        }
        return found;
    }

private:
    template <class Value>
    static Setting with(Setting setting, std::optional<Value> Setting::*member, Value value)
    {
        setting.*member = value;
        return setting;
    }

    void add_openings(std::vector<Setting>& found, const Setting& setting, double present) const
    {
        const Opening opening = opening_of(*scene_.gravity);
        for (const double factor : {opening.finer, opening.coarser})
            found.push_back(
                with(setting, &Setting::opening, std::clamp(present * factor, opening.least, opening.most)));
    }

    const SweepPlan& plan_;
    const SimulationSettings& scene_;
    const ParticleSet& initial_;
};

} // namespace

SweepPlan SweepPlan::full()
{
    SweepPlan plan;
    for (const Motion motion : {Motion::Flow, Motion::Stream, Motion::Rigid})
        for (double size = 2; size <= 256; size *= 2)
            plan.settings.push_back({motion, size});
    return plan;
}

SweepPlan SweepPlan::quick()
{
    SweepPlan plan{.frames = 100, .seeds = 2, .rounds = 1, .points = 1, .clocks = {0.5, 2}};
    for (const Motion motion : {Motion::Flow, Motion::Rigid})
        for (const double size : {4.0, 16.0, 64.0})
            plan.settings.push_back({motion, size});
    return plan;
}

std::vector<Setting> next_round(const SweepPlan& plan, const std::vector<Row>& rows,
                                const SimulationSettings& scene, const ParticleSet& initial)
{
    std::vector<Setting> known, found;
    for (const Row& row : rows)
        known.push_back(in_full(row.setting, scene));
    const Variations variations(plan, scene, initial);
    for (const Motion motion : {Motion::Flow, Motion::Stream, Motion::Rigid})
        for (const Row& point : points_of_front(rows, motion, plan.points))
            for (const Setting& setting : variations.of(point)) {
                const Setting full = in_full(setting, scene);
                if (std::find(known.begin(), known.end(), full) != known.end())
                    continue;
                known.push_back(full);
                found.push_back(setting);
            }
    return found;
}

} // namespace slod::cost
