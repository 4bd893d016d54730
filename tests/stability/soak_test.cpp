#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "app/regulator.hpp"
#include "core/parallel.hpp"
#include "support/case_rows.hpp"
#include "support/field_tables.hpp"
#include "support/rigid_scenes.hpp"
#include "support/small_scenes.hpp"
#include "support/solids.hpp"

// All that a scene can have, for as many frames as SLOD_SOAK_FRAMES says: to be run by hand with 100,000
// under AddressSanitizer (ASAN_OPTIONS=quarantine_size_mb=8, or what was freed counts as in use) and 5,000
// under ThreadSanitizer.
namespace slod::test {
namespace {

std::uint64_t frame_count()
{
    const char* const asked = std::getenv("SLOD_SOAK_FRAMES");
    return std::max<std::uint64_t>(asked != nullptr ? std::strtoull(asked, nullptr, 10) : 1000, 100);
}

/// Clouds in self-gravity above a floor that moves, a mesh and a ball, among attractors, winds and kicks,
/// with emitters of every shape, and sinks that let nothing live for ever or go far.
SmallScene everything(Motion motion)
{
    SmallScene scene = small_scene("sinks");
    SimulationSettings& settings = scene.settings;
    settings.motion.motion = motion;
    settings.gravity.emplace();
    settings.gravity->strength = 1e-3;
    settings.gravity->direct_below = 150; // walks and sums of all pairs, as clusters come and go
    settings.motion.longest_life = 16;
    settings.background.max_breadth = 1;
    settings.limits.max_particles = 900;
    settings.quadratic_drag = QuadraticDragSettings{0.3};
    AllFields::for_each([&]<class F> { add_element(settings.fields.of<F>(), typename F::Settings{}); });
    settings.fields.of<Attractor>().push_back({.strength = 0.1, .radius = 0.5});
    settings.speed_limit = SpeedLimitSettings{6};
    settings.brownian = BrownianSettings{0.1};
    settings.colliders = small_scene("meshes").settings.colliders;
    // Two balls that touch, between which particles are turned back and forth.
    for (const auto& [name, x] : {std::pair("left", -1.2), std::pair("right", -0.8)}) {
        settings.colliders.push_back(with(sphere({x, 0, 0.4}, 0.2), 1, 0));
        settings.colliders.back().name = name;
    }
    settings.colliders[2].velocity = {0, 0, 0};
    for (EmitterSettings& emitter : settings.emitters) {
        emitter.velocity = {0, 0, 0}; // or it would leave for good
        emitter.particle_mass = 1e-3;
        emitter.rate *= 2;
        if (!emitter.schedule.empty()) {
            emitter.schedule.clear();
            emitter.rate = 400;
        }
    }
    settings.sinks[0].position.z() = -0.5; // below where the jets begin
    settings.regions = {ball_region("spring", {0, 0, 0.4}, 0.6, 2),
                        box_region("plank", {0, 0, 0.6}, {1, 0.3, 0.2}, 6)};
    return scene;
}

/// Bytes of this process that are in memory (proc(5)).
double resident_bytes()
{
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with("VmRSS:"))
            return 1024 * std::stod(line.substr(6));
    return 0;
}

/// Of the line through the points that has the least squares.
double slope(const std::vector<double>& x, const std::vector<double>& y)
{
    double mean_x = 0, mean_y = 0, xy = 0, xx = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        mean_x += x[i] / double(x.size());
        mean_y += y[i] / double(x.size());
    }
    for (std::size_t i = 0; i < x.size(); ++i) {
        xy += (x[i] - mean_x) * (y[i] - mean_y);
        xx += (x[i] - mean_x) * (x[i] - mean_x);
    }
    return xy / xx;
}

/// Regions that go round and come and go, as clients move them, in scenes that have them.
void move_regions(SceneEditor& editor, std::uint64_t frame)
{
    if (editor.find("spring") == nullptr)
        return;
    const double turn = 0.05 * double(frame % 1257); // 20 pi
    RegionOfInterest spring = editor.find("spring")->settings, plank = editor.find("plank")->settings;
    spring.centre = {0.8 * std::cos(turn), 0.8 * std::sin(turn), 0.4};
    plank.half_extent.x() = 0.6 + 0.5 * std::sin(0.3 * turn);
    EXPECT_EQ(editor.change(spring, frame), Problems{});
    EXPECT_EQ(editor.change(plank, frame), Problems{});
    if (frame % 64 == 10) {
        EXPECT_EQ(editor.add(ball_region("guest", {0.5, 0.5, 0.5}, 0.5, 3), {}, 0, frame), Problems{});
    } else if (frame % 64 == 42) {
        EXPECT_EQ(editor.remove("guest", frame), Problems{});
    }
}

/// Such a scene under way, with what clients and a controller do to it.
class Soaked {
public:
    explicit Soaked(const SmallScene& scene)
        : simulation_(scene.settings, scene.initial, {}), editor_(simulation_)
    {
        loop_.control.mode = ControlMode::Smooth;
        loop_.server.frame_rate = 100;
    }

    /// The controller is told a millisecond for every 20 clusters, and a frame may take 8, so that all
    /// machines do the same.
    void step(std::uint64_t frame)
    {
        move_regions(editor_, frame);
        regulator_.set(loop_, editor_, simulation_);
        regulator_.apply(editor_, frame);
        const Snapshot& now =
            simulation_.step({.clusters = frame % 4 == 0, .conserved = frame % 8 == 0, .error_pairs = 4000});
        add_events(events_, now.counts);
        regulator_.add(now, double(now.counts.clusters) / 20, simulation_.take_error_samples());
        editor_.take_log();
        editor_.take_news();
    }

    Problems problems() const { return simulation_.problems(); }
    const FrameCounts& events() const { return events_; }
    std::uint64_t decisions() const { return regulator_.report().decisions; }

private:
    Simulation simulation_;
    SceneEditor editor_;
    Regulator regulator_{true};
    LoopSettings loop_;
    FrameCounts events_;
};

// In the second half the memory may still grow by what the allocator leaves in pieces, a twentieth; one
// particle's row lost in each of 100,000 frames would be more.
TEST(Soak, N20_EverythingAtOnceStaysSoundAndTakesNoMoreMemory)
{
    const std::uint64_t frames = frame_count();
    for (const Motion motion : {Motion::Flow, Motion::Rigid})
        ASSERT_EQ(problems(everything(motion).settings), Problems{});
    std::vector<double> at, megabytes;
    FrameCounts all;
    std::size_t unsound = 0;
    std::uint64_t decisions = 0;
    ThreadTeam(3).run([&] {
        Soaked flow(everything(Motion::Flow)), rigid(everything(Motion::Rigid)),
            close(small_scene("encounters"));
        for (std::uint64_t frame = 1; frame <= frames; ++frame) {
            for (Soaked* run : {&flow, &rigid, &close}) {
                run->step(frame);
                if (frame % (frames / 50) != 0)
                    continue;
                const Problems found = run->problems();
                EXPECT_EQ(found, Problems{}) << "frame " << frame;
                unsound += found.empty() ? 0 : 1;
            }
            if (frame % (frames / 50) == 0) {
                at.push_back(double(frame));
                megabytes.push_back(resident_bytes() / 1e6);
            }
        }
        decisions = std::min(flow.decisions(), rigid.decisions());
        add_events(all, flow.events());
        add_events(all, rigid.events());
        add_events(all, close.events());
    });
    for_each_event(all, [](std::string_view name, std::uint64_t count) { EXPECT_GT(count, 0U) << name; });
    report_value("frames", double(frames));
    expect_at_most("frames with problems", double(unsound), 0);
    expect_at_least("decisions of each controller", double(decisions), 1);
    const std::size_t half = at.size() / 2;
    const std::vector<double> late_at(at.begin() + std::ptrdiff_t(half), at.end()),
        late_memory(megabytes.begin() + std::ptrdiff_t(half), megabytes.end());
    const double growth = slope(late_at, late_memory) * (late_at.back() - late_at.front());
    report_value("growth of the memory over the second half, MB", growth);
    expect_at_most("growth of the memory over the second half, of its size", growth / late_memory.front(),
                   0.05);
    report_picture({.title = "Memory in use",
                    .x_axis = "frame",
                    .y_axis = "MB",
                    .curves = {{"resident", at, megabytes}}});
}

} // namespace
} // namespace slod::test
