// Pictures per second of the viewer, drawn without a screen: clusters as points and as ellipsoids.

#include <chrono>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "view/scene_bounds.hpp"
#include "viewer/offscreen.hpp"
#include "viewer/scene_painter.hpp"

namespace {

using namespace slod;

constexpr view::Viewport picture{.width = 1280, .height = 720};
constexpr std::chrono::seconds round_length(3);
constexpr float pictures_per_turn = 200;

/// Clusters that fill a ball of radius 1 evenly, as the cells of a partition do: each with the standard
/// deviation of a cube of its share of the volume, stretched along one axis by up to two.
client::ClusterFrame made_up_ball(std::size_t count)
{
    std::mt19937_64 bits(1);
    std::uniform_real_distribution<float> uniform(0, 1);
    std::normal_distribution<float> normal;
    client::RegionClusters clusters;
    const float side = std::cbrt(4.18879F / float(count));
    for (std::size_t i = 0; i < count; ++i) {
        const Eigen::Vector3f place =
            std::cbrt(uniform(bits)) * Eigen::Vector3f(normal(bits), normal(bits), normal(bits)).normalized();
        const Eigen::Vector3f axis = Eigen::Vector3f(normal(bits), normal(bits), normal(bits)).normalized();
        const float variance = side * side / 12;
        const float stretch = variance * (std::pow(4.0F, uniform(bits)) - 1);
        clusters.position.insert(clusters.position.end(), {place.x(), place.y(), place.z()});
        clusters.velocity.insert(clusters.velocity.end(), {-place.y(), place.x(), 0});
        clusters.mass.push_back(1);
        clusters.particles.push_back(64);
        clusters.covariance.insert(clusters.covariance.end(),
                                   {variance + stretch * axis.x() * axis.x(), stretch * axis.x() * axis.y(),
                                    stretch * axis.x() * axis.z(), variance + stretch * axis.y() * axis.y(),
                                    stretch * axis.y() * axis.z(), variance + stretch * axis.z() * axis.z()});
        clusters.formation.push_back(i);
    }
    client::ClusterFrame frame;
    frame.regions.push_back(std::move(clusters));
    return frame;
}

/// One row: turns the camera about the ball, and draws as often as the time allows.
nlohmann::ordered_json measure(viewer::ScenePainter& painter, std::size_t count, bool shapes)
{
    using Clock = std::chrono::steady_clock;
    const client::ClusterFrame frame = made_up_ball(count);
    viewer::Look look;
    look.camera = view::fitted(look.camera, {0, 0, 0}, 1);
    look.detail.shapes = shapes;
    const viewer::Target target(picture.width, picture.height, GL_RGBA8);
    const auto draw = [&] {
        look.camera.azimuth_deg += 360 / pictures_per_turn;
        painter.paint(&frame, look, picture, {}, target.framebuffer());
        glFinish();
    };
    draw();
    int pictures = 0;
    const auto start = Clock::now();
    std::chrono::duration<double> spent{};
    for (; spent < round_length; spent = Clock::now() - start, ++pictures)
        draw();
    const double rate = pictures / spent.count();
    std::printf("%-10s %8zu %8zu %10zu %8.1f\n", shapes ? "ellipsoids" : "points", count,
                painter.splats().points.size(), painter.splats().ellipses.size(), rate);
    return {
        {"drawn_as", shapes ? "ellipsoids" : "points"}, {"clusters", count}, {"pictures_per_second", rate}};
}

} // namespace

int main(int argc, char** argv)
{
    CLI::App app("Measures how many pictures of 1280x720 the viewer draws a second, without a screen.");
    bool as_json = false;
    app.add_flag("--json", as_json, "Print the rates as one JSON object on the last line, too.");
    CLI11_PARSE(app, argc, argv);

    const viewer::OffscreenContext context;
    const std::string renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    std::printf("%s\n%-10s %8s %8s %10s %8s\n", renderer.c_str(), "drawn as", "clusters", "points",
                "ellipses", "1/s");
    viewer::ScenePainter painter;
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    rows.push_back(measure(painter, 200'000, false));
    rows.push_back(measure(painter, 50'000, true));
    if (as_json) {
        const nlohmann::ordered_json report = {{"benchmark", "viewer"},
                                               {"renderer", renderer},
                                               {"width", picture.width},
                                               {"height", picture.height},
                                               {"rates", rows}};
        std::printf("%s\n", report.dump().c_str());
    }
}
