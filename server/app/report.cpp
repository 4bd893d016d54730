#include "app/report.hpp"

#include <span>

#include <nlohmann/json.hpp>

#include "app/input_log.hpp"
#include "app/json_text.hpp"
#include "app/settings_json.hpp"
#include "idl/version.hpp"
#include "scene/content_hash.hpp"

namespace slod {
namespace {

using Json = nlohmann::ordered_json;

Json vector_json(const Vector3d& vector)
{
    return {vector.x(), vector.y(), vector.z()};
}

Json conserved_json(const ConservedQuantities& conserved)
{
    return {{"mass", conserved.mass},
            {"momentum", vector_json(conserved.momentum)},
            {"angular_momentum", vector_json(conserved.angular_momentum)},
            {"kinetic_energy", conserved.kinetic_energy}};
}

Json drift_json(const Drift& drift)
{
    return {{"mass", drift.mass},
            {"momentum", drift.momentum},
            {"angular_momentum", drift.angular_momentum},
            {"kinetic_energy", drift.kinetic_energy}};
}

Json losses_json(const Losses& losses)
{
    return {{"mass", losses.mass}, {"momentum", vector_json(losses.momentum)}};
}

Json phases_json(const Plan& plan, const RunSummary& summary)
{
    Json phases = Json::object();
    for (std::size_t phase = 0; phase < phase_count; ++phase)
        if (plan.runs[phase])
            phases[std::string(names(Phase{})[phase])] = {
                {"ms_median", summary.phase_ms[phase].quantile(0.5)},
                {"ms_p99", summary.phase_ms[phase].quantile(0.99)}};
    return phases;
}

Json counts_json(const FrameCounts& events)
{
    Json counts = Json::object();
    for_each_event(events,
                   [&](std::string_view name, std::uint64_t count) { counts[std::string(name)] = count; });
    return counts;
}

Json quantile_json(const ErrorQuantile& quantile)
{
    return {{"value", quantile.value}, {"low", quantile.low}, {"high", quantile.high}};
}

/// Null where nothing is known of it.
Json error_json(const ErrorEstimate& error)
{
    if (error.samples == 0)
        return nullptr;
    return {{"samples", error.samples},
            {"oldest_frame", error.oldest_frame},
            {"newest_frame", error.newest_frame},
            {"median", quantile_json(error.median)},
            {"p90", quantile_json(error.p90)},
            {"p99", quantile_json(error.p99)},
            {"max", error.max},
            {"rms", error.rms}};
}

Json ids_json(std::span<const std::uint64_t> ids)
{
    Json list = Json::array();
    for (const std::uint64_t id : ids)
        list.push_back(id);
    return list;
}

Json alarms_json(const std::vector<Alarm>& alarms)
{
    Json list = Json::array();
    for (const Alarm& alarm : alarms)
        list.push_back({{"name", alarm.name},
                        {"severity", names(alarm.severity)[std::size_t(alarm.severity)]},
                        {"first_frame", alarm.first_frame},
                        {"last_frame", alarm.last_frame},
                        {"occurrences", alarm.occurrences},
                        {"text", alarm.text}});
    return list;
}

} // namespace

std::string report(const ReportedRun& run)
{
    const RunSummary& summary = run.summary;
    const Json json = {
        {"scene", run.scene.title},
        {"version", version()},
        {"initial", run.initial_source},
        {"threads", run.threads},
        {"isa", run.isa},
        {"frames", summary.frames},
        {"time", summary.time},
        {"particles", summary.particles},
        {"clusters", summary.clusters},
        {"state_hash", hash_text(summary.state_hash)},
        {"wall_s", summary.wall_s},
        {"processor_s", summary.processor_s},
        {"ms_per_frame",
         {{"median", summary.frame_ms.quantile(0.5)}, {"p99", summary.frame_ms.quantile(0.99)}}},
        {"phases", phases_json(run.plan, summary)},
        {"drift", drift_json(drift(summary.conserved_start, summary.conserved_end))},
        {"conserved",
         {{"start", conserved_json(summary.conserved_start)},
          {"end", conserved_json(summary.conserved_end)}}},
        {"error", error_json(summary.error)},
        {"alarms", alarms_json(summary.alarms)},
        {"unanswered_force", vector_json(summary.unanswered_force)},
        {"drained", losses_json(summary.drained)},
        {"killed", losses_json(summary.killed)},
        {"quarantined",
         {{"particles", summary.quarantined.particles},
          {"mass", summary.quarantined.mass},
          {"first_ids", ids_json(summary.quarantined.ids())}}},
        {"counts", counts_json(summary.events)},
        {"settings", settings_json(run.scene)},
    };
    return json_text(json, 2) + '\n';
}

} // namespace slod
