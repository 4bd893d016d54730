#include "ctl/declarations.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <CLI/CLI.hpp>

#include "arguments/parsing.hpp"

namespace slod::ctl {

namespace {

using Vector = std::array<double, 3>;
using client::CommandRequest;

/// "x,y,z", or one number for all three.
std::optional<Vector> vector_of(const std::string& text)
{
    std::vector<double> numbers;
    const char* place = text.data();
    const char* const end = place + text.size();
    for (bool more = true; more;) {
        const auto [next, error] = std::from_chars(place, end, numbers.emplace_back());
        if (error != std::errc() || numbers.size() > 3)
            return {};
        more = next != end && *next == ',';
        if (next != end && !more)
            return {};
        place = next + (more ? 1 : 0);
    }
    if (numbers.size() == 1)
        return Vector{numbers[0], numbers[0], numbers[0]};
    return numbers.size() == 3 ? std::optional(Vector{numbers[0], numbers[1], numbers[2]}) : std::nullopt;
}

CLI::Option* add_vector(CLI::App& app, const std::string& name, Vector& target, const std::string& help)
{
    const auto take = [name, &target](const std::string& text) {
        const auto vector = vector_of(text);
        if (!vector)
            throw CLI::ValidationError(name, text + " is no place or size; write x,y,z");
        target = *vector;
    };
    return app.add_option_function<std::string>(name, take, help)->option_text("X,Y,Z");
}

CLI::Option* add_half_extent(CLI::App& app, CommandRequest& request, const std::string& help)
{
    return add_vector(app, "--half-extent", request.half_extent, help)->check([](const std::string& text) {
        const auto vector = vector_of(text);
        const bool fits =
            !vector || std::all_of(vector->begin(), vector->end(), [](double x) { return x > 0; });
        return fits ? std::string() : text + " leaves nothing; write three numbers above 0, or one for all";
    });
}

CLI::Option* add_settings(CLI::App& app, const std::string& name, CommandRequest& request,
                          const std::string& help)
{
    const auto take = [name, &request](const std::vector<std::string>& texts) {
        for (const std::string& text : texts) {
            const std::size_t equals = text.find('=');
            if (equals == std::string::npos || equals == 0)
                throw CLI::ValidationError(name, text + " is no setting; write key=value");
            request.settings.emplace_back(text.substr(0, equals), text.substr(equals + 1));
        }
    };
    return app.add_option_function<std::vector<std::string>>(name, take, help);
}

CLI::Option* add_radius(CLI::App& app, CommandRequest& request)
{
    const auto take = [&request](const std::string& text) {
        const auto number = text.find(',') == std::string::npos ? vector_of(text) : std::nullopt;
        if (!number || !(number->front() > 0))
            throw CLI::ValidationError("--radius", '"' + text + "\" is no number above 0");
        request.radius = number->front();
    };
    return app.add_option_function<std::string>("--radius", take, "Radius of a sphere")->option_text("R");
}

CLI::App* action(CLI::App& app, CommandLine& line, const std::string& name, const std::string& help,
                 const std::string& kind)
{
    CLI::App* const sub = app.add_subcommand(name, help);
    sub->callback([&line, kind] { line.request.kind = kind; });
    return sub;
}

/// An action on one region.
CLI::App* region_action(CLI::App& app, CommandLine& line, const std::string& name, const std::string& help,
                        const std::string& kind)
{
    CLI::App* const sub = action(app, line, name, help, kind);
    sub->add_option("NAME", line.request.region, "Name of the region")->required();
    return sub;
}

/// An action on a region that is there.
CLI::App* change_action(CLI::App& app, CommandLine& line, const std::string& name, const std::string& help,
                        const std::string& kind)
{
    CLI::App* const sub = region_action(app, line, name, help, kind);
    sub->add_option("--if-revision", line.request.if_revision,
                    "Refuse unless the region is at this revision: nobody else changed it")
        ->check(at_least_one())
        ->option_text("N");
    return sub;
}

/// The settings of the server that hold what "fps 30", "error 0.01", both in either order, or "off" ask for.
std::vector<std::pair<std::string, std::string>> target_settings(const std::vector<std::string>& words)
{
    if (words.size() == 1 && words.front() == "off")
        return {{"control.mode", "off"}};
    std::vector<std::pair<std::string, std::string>> settings;
    const auto sets = [&](std::string_view key) {
        return std::any_of(settings.begin(), settings.end(),
                           [key](const auto& setting) { return setting.first == key; });
    };
    for (std::size_t word = 0; word < words.size(); word += 2) {
        const bool rate = words[word] == "fps";
        const std::string key = rate ? "server.frame_rate" : "control.target_error";
        if ((!rate && words[word] != "error") || word + 1 == words.size() || sets(key))
            throw CLI::ValidationError("TARGET", "write fps N, error E, both, or off");
        settings.emplace_back(key, words[word + 1]);
    }
    const bool error_first = words.front() == "error";
    settings.emplace_back("control.priority", error_first ? "error" : "frame_rate");
    settings.emplace_back("control.mode", sets("control.target_error") ? "error" : "smooth");
    return settings;
}

/// Whether a setting is given whose key starts so.
bool sets(const CommandRequest& request, std::string_view start)
{
    return std::any_of(request.settings.begin(), request.settings.end(),
                       [start](const auto& setting) { return setting.first.starts_with(start); });
}

void declare_add(CLI::App& app, CommandLine& line)
{
    CommandRequest& request = line.request;
    CLI::App& add = *region_action(app, line, "add", "Add a region.", "add_roi");
    CLI::Option* const centre =
        add_vector(add, "--centre", request.centre, "Centre of a box or a sphere, the eye of a frustum");
    CLI::Option* const half_extent =
        add_half_extent(add, request, "Half the sides of a box, which it makes it, or one number for all");
    CLI::Option* const radius = add_radius(add, request)->excludes(half_extent);
    add_settings(add, "--set", request, "A setting as in [[region]] of a scene; may be repeated")
        ->type_size(1)
        ->allow_extra_args(false)
        ->option_text("KEY=VALUE");
    add.add_option("--lease", request.lease_s,
                   "Remove it after so many seconds: nobody can renew it from here")
        ->check(between(0.0, 1e6))
        ->option_text("SECONDS");
    add.callback([&request, centre, half_extent, radius] {
        request.kind = "add_roi";
        const bool sized = half_extent->count() > 0 || radius->count() > 0;
        if (!sized && !sets(request, "shape")) {
            if (centre->count() > 0)
                throw CLI::RequiredError("with --centre one of --half-extent, --radius and --set shape=...");
            if (!sets(request, "least_") && !sets(request, "most_"))
                throw CLI::RequiredError(
                    "one of --half-extent, --radius, --set shape=... and a range such as "
                    "--set least_speed=1, or for all of the scene "
                    "--set shape=everywhere,");
        }
        if (half_extent->count() > 0)
            request.settings.insert(request.settings.begin(), {"shape", "box"});
        if (radius->count() > 0)
            request.settings.insert(request.settings.begin(), {"shape", "sphere"});
    });
}

} // namespace

void declare_simple(CLI::App& app, CommandLine& line)
{
    app.parse_complete_callback([&app, &line] { line.request.kind = app.get_name(); });
}

void declare_step(CLI::App& app, CommandLine& line)
{
    line.request.frames = 1;
    app.add_option("N", line.request.frames, "Frames to run")
        ->check(between<std::uint32_t>(1, std::numeric_limits<std::uint32_t>::max()))
        ->option_text("[1]");
    declare_simple(app, line);
}

void declare_set(CLI::App& app, CommandLine& line)
{
    add_settings(
        app, "SETTING", line.request,
        "table.key=value as in a scene file, of what may change while it runs: effects, background, control, "
        "alarms, meter, server.frame_rate")
        ->required();
    declare_simple(app, line);
}

void declare_target(CLI::App& app, CommandLine& line)
{
    const auto take = [&line](const std::vector<std::string>& words) {
        line.request.settings = target_settings(words);
    };
    app.add_option_function<std::vector<std::string>>(
           "TARGET", take,
           "fps N: hold N frames a second; error E: hold a median error of accelerations of E (0.01 is 1 %), "
           "whatever a frame takes; both: where they cannot both be had the first one is; or off")
        ->required()
        ->expected(1, 4);
    app.parse_complete_callback([&line] { line.request.kind = "set"; });
}

void declare_effect(CLI::App& app, CommandLine& line)
{
    action(app, line, "list", "Print all effects, one line each: their state and their work in a frame.", "");
    CLI::App* const set =
        action(app, line, "set", "Change settings of effects; one that the scene has not comes.", "set");
    add_settings(
        *set, "SETTING", line.request,
        "effect.key=value as in a scene file; of several, effect.0.key=value for the first, and the number "
        "after the last adds one")
        ->required();
    const auto switching = [&](const std::string& name, const std::string& help, const std::string& value) {
        CLI::App* const sub = action(app, line, name, help, "set");
        const auto take = [&line, value](const std::string& effect) {
            line.request.settings.emplace_back("effects." + effect, value);
        };
        sub->add_option_function<std::string>("NAME", take, "Name of the effect")->required();
    };
    switching("enable", "Let an effect of the scene run again.", "true");
    switching("disable", "Switch an effect off: its settings stay.", "false");
}

void declare_roi(CLI::App& app, CommandLine& line)
{
    CommandRequest& request = line.request;
    action(app, line, "list", "Print all regions, one line each, in the order of their names.", "");
    region_action(app, line, "show", "Print one region.", "");
    declare_add(app, line);
    CLI::App* const move = change_action(app, line, "move", "Give a region another centre.", "move_roi");
    add_vector(*move, "--centre", request.centre, "Its new centre, or eye")->required();
    CLI::App* const resize =
        change_action(app, line, "resize", "Give a box or a sphere another size.", "resize_roi");
    CLI::App* const size = resize->add_option_group("size");
    add_half_extent(*size, request, "Half the sides of a box, or one number for all");
    add_radius(*size, request);
    size->require_option(1);
    CLI::App* const set = change_action(app, line, "set", "Change settings of a region.", "set_roi");
    add_settings(*set, "SETTING", request, "key=value as in [[region]] of a scene file")->required();
    change_action(app, line, "remove", "Remove a region; its clusters go to the others.", "remove_roi");
}

} // namespace slod::ctl
