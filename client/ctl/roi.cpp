#include "ctl/commands.hpp"
#include "ctl/waiting.hpp"

namespace slod::ctl {

namespace {

/// What one line of the list says of a region.
Json summary_of(const client::RegionInfo& region)
{
    const Json all = json_of(region);
    Json summary;
    for (const char* name : {"region", "revision", "shape", "centre", "precedence", "max_cluster_size",
                             "present_max_cluster_size", "clusters", "particles"})
        summary[name] = all.at(name);
    return summary;
}

ExitCode print_all(const client::Connection& connection, bool as_json)
{
    std::vector<Json> rows;
    for (const auto& [name, region] : connection.regions()) {
        if (as_json)
            print(json_of(region), true);
        else
            rows.push_back(summary_of(region));
    }
    print_table(rows);
    return ExitCode::Success;
}

ExitCode print_one(const client::Connection& connection, const std::string& name, bool as_json)
{
    const auto found = connection.regions().find(name);
    if (found == connection.regions().end()) {
        complain(client::no_region_sentence(name));
        return ExitCode::NotFound;
    }
    print(json_of(found->second), as_json);
    return ExitCode::Success;
}

ExitCode look(const CommandLine& line, const std::stop_token& stop)
{
    client::Connection connection(line.server.domain, line.server.profile, {.regions = true});
    const client::Clock::time_point end = deadline(line.server);
    if (!wait_for_server(connection, stop, end))
        return ExitCode::NoServer;
    const std::string& name = line.request.region;
    const auto known = [&] {
        return connection.knows_all_regions() || (!name.empty() && connection.regions().contains(name));
    };
    if (!wait_until(connection, stop, end, known)) {
        complain(client::late_regions_sentence());
        return ExitCode::TimedOut;
    }
    return name.empty() ? print_all(connection, line.json) : print_one(connection, name, line.json);
}

} // namespace

ExitCode run_roi(const CommandLine& line, const std::stop_token& stop)
{
    return line.request.kind.empty() ? look(line, stop) : run_steering(line, stop);
}

} // namespace slod::ctl
