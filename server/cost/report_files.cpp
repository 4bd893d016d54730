#include "cost/report_files.hpp"

#include <algorithm>
#include <sstream>

#include <nlohmann/json.hpp>

#include "core/formatted.hpp"
#include "core/number_text.hpp"
#include "idl/gnuplot.hpp"

namespace slod::cost {
namespace {

using Json = nlohmann::ordered_json;

constexpr double smallest_drawn = 1e-3; ///< the unclustered run has no error, which no logarithm shows

std::string motion_name(const Row& row)
{
    return row.setting.unclustered()
               ? "unclustered"
               : std::string(names(row.setting.motion)[std::size_t(row.setting.motion)]);
}

Json json_of(const Row& row)
{
    const Setting& full = row.in_full;
    Json json = {
        {"motion", motion_name(row)},
        {"max_cluster_size", full.max_cluster_size},
        {"clock", full.clock ? Json(*full.clock) : Json()},
        {"opening", full.opening ? Json(*full.opening) : Json()},
        {"steps", full.steps},
        {"precision", full.precision ? Json(names(*full.precision)[std::size_t(*full.precision)]) : Json()},
        {"error", row.errors.largest()}};
    for (const DistanceMember& member : distance_members)
        json[std::string("error_") + member.name] = row.errors.*member.value;
    for_each_number(row, [&](const std::string& name, double number) { json[name] = number; });
    return json;
}

/// A cell of a table with commas between; empty for what is not known.
std::string cell(const Json& value)
{
    const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
    return text == "null" ? "" : text;
}

} // namespace

std::string csv_text(const Sweep& sweep)
{
    std::string head, lines;
    for (const Row& row : sweep.rows) {
        head.clear();
        std::string line;
        const Json json = json_of(row);
        for (const auto& [key, value] : json.items()) {
            head += (head.empty() ? "" : ",") + key;
            line += (line.empty() ? "" : ",") + cell(value);
        }
        lines += line + '\n';
    }
    return head + '\n' + lines;
}

std::string json_text(const Sweep& sweep, const Circumstances& circumstances)
{
    Json rows = Json::array();
    for (const Row& row : sweep.rows)
        rows.push_back(json_of(row));
    Json floor;
    for_each_number(sweep.floor, [&](const std::string& name, const auto& number) { floor[name] = number; });
    floor["of"] = sweep.floor.resampled ? "bootstrap samples" : "other seeds";
    return Json{{"scene", circumstances.scene},
                {"version", circumstances.version},
                {"machine", circumstances.machine},
                {"threads", circumstances.threads},
                {"particles", circumstances.particles},
                {"frames", circumstances.frames},
                {"reference_steps", reference_steps},
                {"opening", circumstances.opening},
                {"noise_floor", floor},
                {"rows", rows}}
               .dump(2) +
           '\n';
}

std::string table_text(const Sweep& sweep)
{
    std::size_t width = 0;
    for (const Row& row : sweep.rows)
        width = std::max(width, row.setting.name().size());
    const int pad = int(width) + 1;
    std::string text =
        formatted("%-*s %8s %-15s %8s %6s %8s %8s %8s %9s %6s %9s\n", pad, "setting", "ms", "p10-p90",
                  "clusters", "error", "position", "velocity", "density", "force", "r50", "displaced");
    for (const Row& row : sweep.rows)
        text += formatted("%-*s %8.3f %7.3f-%-7.3f %8.0f %6.2f %8.2f %8.2f %8.2f %9.2e %6.3f %9.4f\n", pad,
                          row.setting.name().c_str(), row.ms_median, row.ms_p10, row.ms_p90, row.clusters,
                          row.errors.largest(), row.errors.position, row.errors.velocity,
                          std::max(row.errors.coarse, row.errors.fine), row.force.median, row.r50,
                          row.median_displacement);
    return text;
}

std::string plot_script(const Sweep& sweep, const Circumstances& circumstances,
                        const std::filesystem::path& picture)
{
    std::ostringstream script;
    std::vector<std::string> drawn;
    for (const Motion motion : {Motion::Flow, Motion::Stream, Motion::Rigid}) {
        const auto own = [&](const Row& row) {
            return !row.setting.unclustered() && row.setting.motion == motion;
        };
        if (std::none_of(sweep.rows.begin(), sweep.rows.end(), own))
            continue;
        const std::string name(names(motion)[std::size_t(motion)]);
        script << "$" << name << " << END\n";
        for (const Row& row : sweep.rows)
            if (own(row))
                script << row.ms_median << ' ' << std::max(row.errors.largest(), smallest_drawn) << ' '
                       << (row.setting == Setting{motion, row.setting.max_cluster_size}
                               ? number_text(row.setting.max_cluster_size)
                               : "\"\"")
                       << '\n';
        script << "END\n$front_" << name << " << END\n";
        for (const Row& row : pareto_front(sweep.rows, motion))
            script << row.ms_median << ' ' << std::max(row.errors.largest(), smallest_drawn) << '\n';
        script << "END\n";
        const std::string colour = std::to_string(drawn.size() + 1);
        drawn.push_back("$" + name + " using 1:2:3 with labels point pt 7 lc " + colour +
                        " offset 1,0.6 notitle, $front_" + name + " using 1:2 with lines lw 2 lc " + colour +
                        " title '" + name + "'");
    }
    script << "set logscale xy\nset grid\nset key bottom left\nset xlabel 'milliseconds per frame'\n"
           << "set ylabel 'error, in noise floors'\n"
           << "set title \"" << circumstances.particles << " particles, " << circumstances.frames
           << " frames, " << circumstances.threads
           << " threads; labels: largest cluster size, all else as in the scene\"\n";
    for (const char* const terminal : {"png", "svg"}) {
        script << "set terminal " << (std::string(terminal) == "png" ? "pngcairo" : "svg")
               << " size 900,600\nset output " << gnuplot_quoted(picture.string() + "." + terminal)
               << "\nplot ";
        for (const std::string& curve : drawn)
            script << curve << ", ";
        script << "1 dashtype 2 lc 'gray' title 'as another seed'\n";
    }
    return script.str();
}

} // namespace slod::cost
