#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "app/scene_editor.hpp"
#include "core/parallel.hpp"
#include "support/case_rows.hpp"
#include "support/rigid_scenes.hpp"
#include "support/small_scenes.hpp"

// A run is resumed from its input log: repeated to any frame, it has every bit of that frame, and goes on as
// the first one did.
namespace slod::test {
namespace {

constexpr std::uint64_t frame_count = 96;

/// What clients and controllers do in such a run, before some of its frames.
void change(SceneEditor& editor, std::uint64_t frame)
{
    const auto expect_done = [&](const Problems& problems) { EXPECT_EQ(problems, Problems{}) << frame; };
    if (frame % 16 == 3)
        expect_done(
            editor.add(ball_region("ball" + std::to_string(frame), {0.1 * double(frame % 7), 0, 0}, 1, 4), {},
                       0, frame));
    if (frame % 16 == 11)
        expect_done(editor.remove("ball" + std::to_string(frame - 8), frame));
    if (frame % 16 > 3 && frame % 16 < 11) {
        RegionOfInterest moved = editor.find("ball" + std::to_string(frame - frame % 16 + 3))->settings;
        moved.centre.x() += 0.05;
        expect_done(editor.change(moved, frame));
    }
    if (frame % 10 == 5)
        editor.set_detail({.cluster_size = 0.5 + 0.1 * double(frame % 9), .dithered = true}, frame);
    if (frame == 40)
        expect_done(editor.set({{"background.max_cluster_size", "12"}}, frame));
    if (frame == 60) // a new plan: all clusters are formed anew
        expect_done(editor.set({{"quadratic_drag.coefficient", "0.1"}}, frame));
    if (frame == 66)
        expect_done(editor.set({{"attractor.0.strength", "0.01"}}, frame));
    if (frame > 66 && frame % 4 == 0) // under the same plan
        expect_done(
            editor.set({{"attractor.0.position", "[0, 0, " + std::to_string(frame % 5) + "]"}}, frame));
}

/// Steps to frame `last`, doing before each what the log says; the hashes of the frames.
std::vector<std::uint64_t> run_on(Simulation& simulation, SceneEditor& editor, std::uint64_t first,
                                  std::uint64_t last, const std::vector<LoggedCommand>& log)
{
    std::vector<std::uint64_t> hashes;
    for (std::uint64_t frame = first; frame <= last; ++frame) {
        for (const LoggedCommand& command : log)
            if (command.frame == frame) {
                EXPECT_EQ(editor.repeat(command), Problems{}) << frame;
            }
        simulation.step({});
        hashes.push_back(simulation.state_hash());
    }
    return hashes;
}

class ResumedRun : public testing::TestWithParam<const char*> {};

TEST_P(ResumedRun, N11_HasEveryBitOfTheFrameItWasStoppedAtAndGoesOnAlike)
{
    const SmallScene scene = small_scene(GetParam());
    std::vector<std::uint64_t> expected;
    std::vector<LoggedCommand> log;
    ThreadTeam(2).run([&] {
        Simulation simulation(scene.settings, scene.initial, {});
        SceneEditor editor(simulation);
        for (std::uint64_t frame = 1; frame <= frame_count; ++frame) {
            change(editor, frame);
            simulation.step({});
            expected.push_back(simulation.state_hash());
        }
        EXPECT_EQ(simulation.problems(), Problems{});
        log = editor.take_log();
    });
    report_value("changes in the log", double(log.size()));
    for (const std::uint64_t stop :
         {std::uint64_t{1}, std::uint64_t{39}, std::uint64_t{60}, std::uint64_t{90}}) {
        ThreadTeam(3).run([&] {
            Simulation simulation(scene.settings, scene.initial, {});
            SceneEditor editor(simulation);
            std::vector<std::uint64_t> hashes = run_on(simulation, editor, 1, stop, log);
            simulation.snapshot({.clusters = true, .conserved = true}); // whoever looks meanwhile
            const auto rest = run_on(simulation, editor, stop + 1, frame_count, log);
            hashes.insert(hashes.end(), rest.begin(), rest.end());
            std::size_t others = 0;
            for (std::size_t i = 0; i < expected.size(); ++i)
                others += hashes[i] == expected[i] ? 0 : 1;
            expect_at_most("frames with other bits", double(others), 0);
        });
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, ResumedRun, testing::Values("flow", "rigid", "obstacles"));

} // namespace
} // namespace slod::test
