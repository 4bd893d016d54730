#include "ctl/commands.hpp"
#include "ctl/waiting.hpp"

namespace slod::ctl {

namespace {

/// The part of `all` that has the dotted `name`; null when there is none.
const Json* find(const Json& all, std::string_view name)
{
    const Json* part = &all;
    while (!name.empty()) {
        const std::size_t dot = name.find('.');
        const std::string step(name.substr(0, dot));
        if (!part->is_object() || !part->contains(step))
            return nullptr;
        part = &(*part)[step];
        name.remove_prefix(dot == std::string_view::npos ? name.size() : dot + 1);
    }
    return part;
}

} // namespace

ExitCode run_stats(const CommandLine& line, const std::stop_token& stop)
{
    client::Connection connection(line.server.domain, line.server.profile, {.stats = true});
    const client::Clock::time_point end = deadline(line.server);
    if (!wait_for_server(connection, stop, end))
        return ExitCode::NoServer;
    if (!wait_until(connection, stop, end, [&] { return connection.stats() != nullptr; })) {
        complain(no_news_sentence("no statistics came in time", connection));
        return ExitCode::TimedOut;
    }
    const Json all = json_of(*connection.stats());
    if (line.names.empty()) {
        print(all, line.json);
        return ExitCode::Success;
    }
    Json chosen = Json::object();
    for (const std::string& name : line.names) {
        const Json* const value = find(all, name);
        if (!value) {
            complain("there is no value named " + name + "; slodctl stats prints all of them");
            return ExitCode::NotFound;
        }
        chosen[name] = *value;
    }
    print(chosen, line.json);
    return ExitCode::Success;
}

} // namespace slod::ctl
