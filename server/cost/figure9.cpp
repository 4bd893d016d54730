#include "cost/figure9.hpp"

#include <algorithm>
#include <sstream>

#include "core/formatted.hpp"
#include "idl/gnuplot.hpp"
#include "sim/simulation.hpp"

namespace slod::cost {
namespace {

double times_as_fast(const FountainView& view, const std::vector<FountainView>& views)
{
    return views.front().ms / view.ms;
}

/// Half the side of a square that holds all droplets, about (x, z) of its middle.
struct Frame {
    double x, z, half_side;
};

Frame frame_around(const std::vector<FountainView>& views)
{
    double least_x = 1e30, most_x = -1e30, least_z = 1e30, most_z = -1e30;
    for (const FountainView& view : views)
        for (const Vector3d& place : view.droplets) {
            least_x = std::min(least_x, place.x());
            most_x = std::max(most_x, place.x());
            least_z = std::min(least_z, place.z());
            most_z = std::max(most_z, place.z());
        }
    return {0.5 * (least_x + most_x), 0.5 * (least_z + most_z),
            0.55 * std::max(most_x - least_x, most_z - least_z)};
}

} // namespace

std::vector<FountainView> view_fountain(const SimulationSettings& scene, double simulated_s,
                                        const Clock& clock)
{
    const int frames = std::max(3, int(simulated_s / (scene.time.step * scene.units.time_s) + 0.5));
    std::vector<FountainView> views;
    for (const Setting& setting : {Setting{.max_cluster_size = 1}, Setting{Motion::Flow, figure9_size},
                                   Setting{Motion::Rigid, figure9_size}}) {
        SimulationSettings settings = with_setting(scene, setting);
        if (setting.unclustered())
            settings.regions.clear();
        Simulation simulation(settings, {}, {.isa = "auto", .tick = {}});
        const int full = frames - frames / 3;
        double began = clock();
        for (int frame = 0; frame < frames; ++frame) {
            if (frame == full)
                began = clock();
            simulation.step({});
        }
        views.push_back({setting, (clock() - began) / (frames - full), positions(simulation.particles())});
    }
    return views;
}

std::string text(const std::vector<FountainView>& views)
{
    std::string lines = formatted("Figure 9, the fountain of %zu droplets\n", views.front().droplets.size());
    for (const FountainView& view : views)
        lines += formatted("  %-12s %8.3f ms a frame, %.2f times as fast", view.setting.name().c_str(),
                           view.ms, times_as_fast(view, views)) +
                 (view.setting.unclustered() ? "\n" : formatted(", the paper's %g\n", figure9_factor));
    return lines;
}

nlohmann::ordered_json json_of(const std::vector<FountainView>& views)
{
    nlohmann::ordered_json json = {{"paper", figure9_factor}, {"runs", nlohmann::ordered_json::array()}};
    for (const FountainView& view : views)
        json["runs"].push_back({{"setting", view.setting.name()},
                                {"droplets", view.droplets.size()},
                                {"ms", view.ms},
                                {"speed_up", times_as_fast(view, views)}});
    return json;
}

std::string side_by_side_script(const std::vector<FountainView>& views, const std::filesystem::path& picture)
{
    std::ostringstream script;
    for (std::size_t i = 0; i < views.size(); ++i) {
        script << "$view" << i << " << END\n";
        for (const Vector3d& place : views[i].droplets)
            script << place.x() << ' ' << place.z() << '\n';
        script << "END\n";
    }
    const Frame frame = frame_around(views);
    script << "set terminal " << (picture.extension() == ".svg" ? "svg" : "pngcairo") << " size "
           << 450 * views.size() << ",500\nset output " << gnuplot_quoted(picture.string())
           << "\nset multiplot layout 1," << views.size() << "\nset size square\nunset tics\nunset key\n"
           << "set xrange [" << frame.x - frame.half_side << ':' << frame.x + frame.half_side
           << "]\nset yrange [" << frame.z - frame.half_side << ':' << frame.z + frame.half_side << "]\n";
    for (std::size_t i = 0; i < views.size(); ++i)
        script << "set title "
               << gnuplot_quoted(
                      formatted("%s, %.3f ms a frame", views[i].setting.name().c_str(), views[i].ms))
               << "\nplot $view" << i << " using 1:2 with dots lc 'black'\n";
    script << "unset multiplot\n";
    return script.str();
}

} // namespace slod::cost
