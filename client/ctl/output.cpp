#include "ctl/output.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

namespace slod::ctl {

namespace {

Json json_of(const client::Conserved& conserved)
{
    return {{"mass", conserved.mass},
            {"momentum", conserved.momentum},
            {"angular_momentum", conserved.angular_momentum},
            {"kinetic_energy", conserved.kinetic_energy},
            {"potential_energy", conserved.potential_energy}};
}

Json json_of(const wire::PublisherCounts& counts)
{
    return {{"offered_frames", counts.offered_frames},
            {"published_frames", counts.published_frames},
            {"skipped_frames", counts.skipped_frames},
            {"refused_samples", counts.refused_samples},
            {"published_bytes", counts.published_bytes},
            {"delayed_frames", counts.delayed_frames},
            {"encode_ms", counts.encode_ms}};
}

/// JSON has no infinity: "inf" stands for it.
Json number(double value)
{
    return std::isinf(value) ? Json(value > 0 ? "inf" : "-inf") : Json(value);
}

/// A number with six digits, which is what one reads, and of a long list the beginning and how long it is;
/// everything else as JSON has it, without quotes.
std::string text_of(const Json& value)
{
    constexpr std::size_t shown = 6, long_list = 16;
    if (value.is_array() && value.size() > long_list) {
        std::string text;
        for (std::size_t i = 0; i < shown; ++i)
            text += text_of(value[i]) + ", ";
        return "[" + text + "... " + std::to_string(value.size()) + " in all]";
    }
    if (value.is_array() &&
        std::all_of(value.begin(), value.end(), [](const Json& x) { return x.is_number(); })) {
        std::string text;
        for (const Json& element : value)
            text += (text.empty() ? "" : ",") + text_of(element);
        return text;
    }
    if (value.is_string())
        return value.get<std::string>();
    if (!value.is_number_float())
        return value.dump();
    std::array<char, 32> text;
    std::snprintf(text.data(), text.size(), "%.6g", value.get<double>());
    return text.data();
}

using Fields = std::vector<std::pair<std::string, std::string>>;

void flatten(const std::string& prefix, const Json& object, Fields& fields)
{
    for (const auto& [name, value] : object.items()) {
        const std::string path = prefix.empty() ? name : prefix + "." + name;
        if (value.is_object())
            flatten(path, value, fields);
        else if (std::string text = text_of(value); !text.empty())
            fields.emplace_back(path, std::move(text));
    }
}

Fields fields_of(const Json& object)
{
    Fields fields;
    flatten({}, object, fields);
    return fields;
}

} // namespace

Json json_of(const client::Status& status)
{
    return {{"contact", names(status.contact)[std::size_t(status.contact)]}, {"reason", status.reason}};
}

Json json_of(const client::ServerInfo& server)
{
    return {
        {"session", wire::to_string(server.session)},
        {"scene_title", server.scene_title},
        {"frame", server.frame},
        {"time", server.time},
        {"paused", server.paused},
        {"idle_ms", server.idle_ms},
        {"frame_rate_target_hz", server.frame_rate_target_hz},
        {"frame_rate_hz", server.frame_rate_hz},
        {"real_time_factor", server.real_time_factor},
        {"particles", server.particles},
        {"regions", server.regions},
        {"alarms", server.alarms},
        {"time_step", server.time_step},
        {"units", {{"length_m", server.length_m}, {"mass_kg", server.mass_kg}, {"time_s", server.time_s}}},
        {"version", server.version},
        {"isa", server.isa},
        {"threads", server.threads},
        {"host", server.host},
        {"process", server.process},
        {"started_ns", server.started_ns},
        {"heartbeat", server.heartbeat},
        {"max_sample_bytes", server.max_sample_bytes},
        {"topics", server.topics}};
}

Json json_of(const client::ServerStats& stats)
{
    Json json = {{"frame", stats.frame},
                 {"time", stats.time},
                 {"frame_rate_hz", stats.frame_rate_hz},
                 {"work_ms", stats.work_ms},
                 {"real_time_factor", stats.real_time_factor},
                 {"particles", stats.particles},
                 {"clusters", stats.clusters}};
    for (const auto& [name, ms] : stats.phases_ms)
        json["phases_ms"][name] = ms;
    for (const auto& [name, count] : stats.counts)
        json["counts"][name] = count;
    if (stats.conserved_measured) {
        json["conserved"] = json_of(stats.conserved);
        json["drift"] = json_of(stats.drift);
    }
    const client::Control& control = stats.control;
    json["control"] = {{"mode", control.mode},
                       {"state", control.state},
                       {"target_ms", control.target_ms},
                       {"decisions", control.decisions},
                       {"cluster_size", control.cluster_size},
                       {"breadth", control.breadth},
                       {"opening", control.opening},
                       {"life", control.life}};
    json["wire"] = json_of(stats.wire);
    return json;
}

Json json_of(const client::MeasuredError& error)
{
    const auto quantile = [](const client::Quantile& of) -> Json {
        return {{"value", of.value}, {"low", of.low}, {"high", of.high}};
    };
    return {{"frame", error.frame},
            {"oldest_frame", error.oldest_frame},
            {"newest_frame", error.newest_frame},
            {"samples", error.samples},
            {"median", quantile(error.median)},
            {"p90", quantile(error.p90)},
            {"p99", quantile(error.p99)},
            {"max", error.max},
            {"rms", error.rms},
            {"target", error.target}};
}

Json json_of(const client::EffectInfo& effect)
{
    return {{"frame", effect.frame},
            {"state", effect.state},
            {"acts_on_clusters", effect.acts_on_clusters},
            {"clusters", effect.clusters},
            {"particles", effect.particles},
            {"straddling", effect.straddling},
            {"ms", effect.ms}};
}

Json json_of(const client::StreamMeter::Report& traffic)
{
    return {{"received", traffic.received},
            {"lost", traffic.lost},
            {"bytes", traffic.bytes},
            {"rate_hz", traffic.rate_hz},
            {"bytes_per_s", traffic.bytes_per_s},
            {"longest_gap_ms", traffic.longest_gap_ms},
            {"latency_p50_ms", traffic.latency_p50_ms},
            {"latency_p99_ms", traffic.latency_p99_ms}};
}

Json json_of(const client::RegionInfo& region)
{
    Json json = {{"region", region.region},
                 {"revision", region.revision},
                 {"partition", region.partition},
                 {"shape", region.shape},
                 {"centre", region.centre},
                 {"half_extent", region.half_extent},
                 {"radius", region.radius},
                 {"direction", region.direction},
                 {"up", region.up},
                 {"field_of_view_deg", region.field_of_view_deg},
                 {"aspect", region.aspect},
                 {"near_distance", region.near_distance},
                 {"far_distance", number(region.far_distance)},
                 {"follows", region.follows},
                 {"precedence", region.precedence},
                 {"max_cluster_size", region.max_cluster_size},
                 {"max_breadth", number(region.max_breadth)},
                 {"present_max_cluster_size", region.present_max_cluster_size},
                 {"present_max_breadth", number(region.present_max_breadth)}};
    for (const auto& [name, value] : region.settings)
        json["settings"][name] = value;
    json["owner"] = region.owner == wire::Uuid{} ? "" : wire::to_string(region.owner);
    json["lease_s"] = region.lease_s;
    json["clusters"] = region.clusters;
    json["particles"] = region.particles;
    return json;
}

void print(const Json& object, bool as_json)
{
    if (as_json)
        std::puts(object.dump(-1, ' ', false, Json::error_handler_t::replace).c_str());
    else
        for (const std::string& line : lines_of(object))
            std::puts(line.c_str());
    std::fflush(stdout);
}

std::vector<std::string> lines_of(const Json& object)
{
    const Fields fields = fields_of(object);
    std::size_t width = 0;
    for (const auto& [name, value] : fields)
        width = std::max(width, name.size());
    std::vector<std::string> lines;
    for (const auto& [name, value] : fields)
        lines.push_back(name + std::string(width - name.size() + 2, ' ') + value);
    return lines;
}

void print_table(const std::vector<Json>& rows)
{
    std::vector<std::vector<std::string>> table;
    for (const Json& row : rows) {
        std::vector<std::string> names, cells;
        for (const auto& [name, value] : row.items()) {
            names.push_back(name);
            cells.push_back(text_of(value));
        }
        if (table.empty())
            table.push_back(std::move(names));
        table.push_back(std::move(cells));
    }
    for (const std::vector<std::string>& cells : table) {
        std::string line;
        for (std::size_t column = 0; column < cells.size(); ++column) {
            std::size_t width = 0;
            for (const std::vector<std::string>& other : table)
                width = std::max(width, other[column].size());
            line += cells[column];
            if (column + 1 < cells.size())
                line.append(width - cells[column].size() + 2, ' ');
        }
        print_line(line);
    }
}

void print_line(const std::string& line)
{
    std::puts(line.c_str());
}

std::string one_line(const Json& object)
{
    std::string line;
    for (const auto& [name, value] : fields_of(object))
        line += (line.empty() ? "" : " ") + name + "=" + value;
    return line;
}

void complain(const std::string& sentence)
{
    std::fprintf(stderr, "slodctl: %s\n", sentence.c_str());
}

} // namespace slod::ctl
