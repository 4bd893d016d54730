#include "app/regulator.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace slod {
namespace {

ControlScope scope_of(const SceneEditor& editor, const Simulation& simulation)
{
    ControlScope scope{.least_size = INFINITY, .most_size = 0, .regions = editor.region_count()};
    for (const auto& [name, record] : editor.records()) {
        const RegionSettings& partition = record.settings.partition;
        if (partition.control_share == 0)
            continue;
        scope.least_size = std::min(scope.least_size, partition.max_cluster_size);
        scope.most_size = std::max(scope.most_size, partition.max_cluster_size);
        scope.breadth = scope.breadth || std::isfinite(partition.max_breadth);
    }
    scope.opening = called_for(simulation.settings()).gravity.has_value();
    scope.life = simulation.plan().clocked;
    return scope;
}

} // namespace

void Regulator::set(const LoopSettings& settings, const SceneEditor& editor, const Simulation& simulation)
{
    frame_rate_hz_ = settings.server.frame_rate;
    const bool other_settings = settings.control != settings_;
    const bool other_plan = editor.plan_changes() != plan_changes_;
    if (!other_settings && !other_plan && editor.revision() == revision_)
        return;
    if (settings_.mode != ControlMode::Off && settings.control.mode == ControlMode::Off)
        decided_ = Detail{};
    settings_ = settings.control;
    revision_ = editor.revision();
    plan_changes_ = editor.plan_changes();
    const ControlScope scope = scope_of(editor, simulation);
    ControlSettings asked = settings_;
    if (asked.mode == ControlMode::Error && !simulation.plan().has(Phase::Meter))
        asked.mode = ControlMode::Smooth; // there is no error to hold
    const bool has_target = paced_ || asked.mode == ControlMode::Error;
    const bool turnable = has_target && !simulation.plan().unclustered && scope.most_size > 0;
    if (!turnable)
        controller_.reset();
    else if (other_settings || other_plan || !controller_)
        controller_ = make_controller(asked, scope, simulation.detail());
    else if (scope != scope_) // not whenever a region moves
        controller_->set_scope(scope);
    scope_ = scope;
}

void Regulator::add(const Snapshot& snapshot, double work_ms, std::span<const ErrorSample> errors)
{
    if (!controller_)
        return;
    decided_ = controller_->next({.work_ms = work_ms,
                                  .target_ms = paced_ ? report().target_ms : INFINITY,
                                  .particles = snapshot.counts.particles,
                                  .clusters = snapshot.counts.clusters,
                                  .growth = double(snapshot.counts.born) - double(snapshot.counts.died),
                                  .frame = snapshot.frame,
                                  .errors = errors});
}

void Regulator::apply(SceneEditor& editor, std::uint64_t frame)
{
    if (!decided_)
        return;
    const Detail wanted = *std::exchange(decided_, {});
    if (editor.set_detail(wanted, frame))
        ++decisions_;
}

ControlReport Regulator::report() const
{
    if (!controller_)
        return {.mode = settings_.mode};
    return {.mode = settings_.mode,
            .state = controller_->state(),
            .target_ms = paced_ ? 1000 * settings_.work_share / frame_rate_hz_ : 0,
            .target_error = settings_.mode == ControlMode::Error ? settings_.target_error : 0,
            .decisions = decisions_};
}

} // namespace slod
