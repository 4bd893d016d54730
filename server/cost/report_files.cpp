#include "cost/report_files.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <sstream>

#include <nlohmann/json.hpp>

#include "cost/answer.hpp"
#include "idl/gnuplot.hpp"

namespace slod::cost {
namespace {

using Json = nlohmann::ordered_json;

constexpr double smallest_drawn = 1e-3; ///< the unclustered run has no error, which no logarithm shows

Json json_of(const Row& row)
{
    return {{"motion", row.setting.unclustered()
                           ? "unclustered"
                           : names(row.setting.motion)[std::size_t(row.setting.motion)]},
            {"max_cluster_size", row.setting.max_cluster_size},
            {"ms_median", row.ms_median},
            {"ms_p10", row.ms_p10},
            {"ms_p90", row.ms_p90},
            {"clusters", row.clusters},
            {"error", row.errors.largest()},
            {"error_position", row.errors.position},
            {"error_velocity", row.errors.velocity},
            {"error_density_coarse", row.errors.coarse},
            {"error_density_fine", row.errors.fine},
            {"median_displacement", row.median_displacement},
            {"r10", row.r10},
            {"r50", row.r50},
            {"r90", row.r90},
            {"momentum_drift", row.momentum_drift},
            {"energy_change", row.energy_change}};
}

} // namespace

std::string csv_text(const Sweep& sweep)
{
    std::ostringstream text;
    for (const Row& row : sweep.rows) {
        const Json json = json_of(row);
        if (&row == &sweep.rows.front()) {
            for (const auto& [key, value] : json.items())
                text << (key == "motion" ? "" : ",") << key;
            text << '\n';
        }
        for (const auto& [key, value] : json.items()) {
            text << (key == "motion" ? "" : ",");
            value.is_string() ? text << value.get<std::string>() : text << value;
        }
        text << '\n';
    }
    return text.str();
}

std::string json_text(const Sweep& sweep, const Circumstances& circumstances)
{
    Json rows = Json::array();
    for (const Row& row : sweep.rows)
        rows.push_back(json_of(row));
    const Floor& floor = sweep.floor;
    return Json{{"scene", circumstances.scene},
                {"version", circumstances.version},
                {"machine", circumstances.machine},
                {"threads", circumstances.threads},
                {"particles", circumstances.particles},
                {"frames", circumstances.frames},
                {"noise_floor",
                 {{"position", floor.position},
                  {"velocity", floor.velocity},
                  {"density_coarse", floor.coarse},
                  {"density_fine", floor.fine},
                  {"rms_radius", floor.rms_radius},
                  {"of", floor.resampled ? "bootstrap samples" : "other seeds"}}},
                {"rows", rows}}
               .dump(2) +
           '\n';
}

std::string table_text(const Sweep& sweep)
{
    std::string text =
        "setting          ms   p10-p90       clusters  error  position velocity density  r50    displaced\n";
    for (const Row& row : sweep.rows) {
        std::array<char, 200> line{};
        std::snprintf(line.data(), line.size(),
                      "%-12s %7.2f %6.2f-%-7.2f %8llu  %6.2f %7.2f %8.2f %8.2f %7.3f %8.4f\n",
                      row.setting.name().c_str(), row.ms_median, row.ms_p10, row.ms_p90,
                      static_cast<unsigned long long>(row.clusters), row.errors.largest(),
                      row.errors.position, row.errors.velocity, std::max(row.errors.coarse, row.errors.fine),
                      row.r50, row.median_displacement);
        text += line.data();
    }
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
                       << row.setting.max_cluster_size << '\n';
        script << "END\n$front_" << name << " << END\n";
        for (const Row& row : pareto_front(sweep.rows, motion))
            script << row.ms_median << ' ' << std::max(row.errors.largest(), smallest_drawn) << '\n';
        script << "END\n";
        const std::string colour = std::to_string(drawn.size() + 1);
        drawn.push_back("$" + name + " using 1:2:3 with labels point pt 7 lc " + colour +
                        " offset 1,0.6 notitle, $front_" + name + " using 1:2 with lines lw 2 lc " + colour +
                        " title '" + name + "'");
    }
    script << "set logscale xy\nset grid\nset xlabel 'milliseconds per frame'\n"
           << "set ylabel 'error, in noise floors'\n"
           << "set title \"" << circumstances.particles << " particles, " << circumstances.frames
           << " frames, " << circumstances.threads << " threads; labels: largest cluster size\"\n";
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
