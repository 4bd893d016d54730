#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "e2e/server_fixture.hpp"
#include "support/paper_rule.hpp"

// O'Brien et al. 2001, sections 5.2 and 6.1, on the real server by the real clock: the trace has what each
// frame took and the sizes it ran with, so that every decision can be checked, however fast the machine is.
namespace slod {
namespace {

using test::expect_rule;
using Frames = std::vector<test::TracedFrame>;

class PaperServer : public ServerTest {
protected:
    /// Runs a scene off the wire, at its pace unless `more` says otherwise. Throws where that fails.
    Frames traced(const std::string& scene, const Arguments& more)
    {
        const std::filesystem::path trace = folder_ / "trace.csv";
        std::filesystem::remove(trace);
        Arguments arguments{scene, "--no-dds", "--output-dir", folder_, "--trace", trace};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ServerRun run = run_server(arguments);
        const Frames frames = test::traced_frames(trace);
        if (run.exit_code != 0 || frames.empty())
            throw std::runtime_error("the server failed: " + run.output);
        return frames;
    }

    /// The small fountain by the paper's rule: 64 at most in a cluster, at first.
    Frames ruled(int frames, double frame_rate, double work_share, const Arguments& more = {})
    {
        Arguments arguments{"--frames", std::to_string(frames),
                            "--set",    "control.mode=paper",
                            "--set",    "server.frame_rate=" + std::to_string(frame_rate),
                            "--set",    "control.work_share=" + std::to_string(work_share)};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return traced(scene_, arguments);
    }

    /// Runs the input log again; the exit code says whether the outcome was the same.
    int replayed() const { return run_server({"--replay", log_, "--free-run", "--no-dds"}).exit_code; }

    const std::string paper_fountain = SLOD_SCENES "/paper-fountain.toml";
};

double median_work(const Frames& frames)
{
    std::vector<double> works;
    for (const auto& frame : frames)
        works.push_back(frame.work_ms);
    std::sort(works.begin(), works.end());
    return works[works.size() / 2];
}

TEST_F(PaperServer, A55_EachDecisionIsTheRules)
{
    const auto one_more_or_less = [](double size, int direction) {
        return std::clamp(size + direction, 1.0, 256.0);
    };
    const Frames idle = ruled(80, 20, 1), busy = ruled(80, 1000, 0.01); // 50 ms for a frame, and 10 us
    const double usual_ms = median_work(Frames(busy.begin() + 20, busy.end()));
    const Frames between = ruled(200, 100, std::clamp(usual_ms / 10, 0.01, 1.0));
    for (const Frames& frames : {idle, busy, between}) {
        for (std::size_t frame = 0; frame < 3; ++frame)
            EXPECT_EQ(frames.at(frame).size, 64) << "no mean of three frames yet";
        EXPECT_GT(expect_rule(frames, one_more_or_less).all(), 60);
    }
    EXPECT_EQ(replayed(), 0);
    EXPECT_LT(idle.back().size, 64);
    EXPECT_GT(busy.back().size, 64);
    const test::Directions directions = expect_rule(between, one_more_or_less);
    EXPECT_GT(directions.up, 0);
    EXPECT_GT(directions.down, 0);
}

TEST_F(PaperServer, A54_SizesThatFallAreReachedOverManyFrames)
{
    const Frames frames = ruled(100, 25, 1);
    int rising = 0;
    for (std::size_t frame = 20; frame < frames.size(); ++frame) { // the fountain is full
        rising += frames[frame].clusters > frames[frame - 1].clusters;
        EXPECT_LE(frames[frame].switches, std::max(0.2 * frames[frame - 1].clusters, 2.0)) << frame;
    }
    EXPECT_GE(rising, 5);
    EXPECT_GT(frames.back().clusters, 2 * frames.at(20).clusters);
}

// No frame is done within 10 us, be it of a few droplets: each decision is for larger clusters.
TEST_F(PaperServer, A56_WithSeveralRegionsEachDecisionIsThePercentage)
{
    const Frames frames = traced(
        paper_fountain, {"--frames", "60", "--set", "control.mode=paper", "--set", "server.frame_rate=1000",
                         "--set", "control.work_share=0.01", "--set", "control.largest_cluster_size=100000"});
    EXPECT_GT(frames.back().size, 1000);
    const auto percent = [](double size, int direction) { return direction > 0 ? size * 1.1 : size / 1.1; };
    EXPECT_GT(expect_rule(frames, percent).up, 50);
}

TEST_F(PaperServer, A57_TheBreadthDoublesAfterFiveStepsInVainAtTheLargestSize)
{
    const Frames frames = ruled(30, 1000, 0.01, {"--set", "control.largest_cluster_size=66"});
    // Three frames without a decision, two to the largest size, five in vain: frames count from 0 here.
    for (std::size_t frame = 0; frame < 9; ++frame)
        EXPECT_EQ(frames.at(frame).breadth, 1) << frame;
    EXPECT_EQ(frames.at(9).breadth, 2);
    EXPECT_EQ(frames.at(14).breadth, 4);
    EXPECT_EQ(frames.back().breadth, 4);
    EXPECT_EQ(frames.back().size, 66);
}

// Of the encoding: Commands.A58_TheWorkHasTheEncodingInIt.
TEST_F(PaperServer, A58_SizesGoByTheWorkAndNotByThePace)
{
    const Frames frames = ruled(150, 100, 0.5);
    for (const auto& frame : frames)
        EXPECT_NEAR(frame.target_ms, 0.5 * 1000 / 100, 1e-3) << "a share of the period";
    EXPECT_GE(frames.back().wall_s - frames.front().wall_s, 0.95 * 149 * 0.01) << "frames are paced";
    EXPECT_GT(
        expect_rule(frames, [](double size, int direction) { return std::max(size + direction, 1.0); }).all(),
        100);
}

TEST_F(PaperServer, A60_StreamsOfTwoThousandDropletsStartAtZeroFiveAndTenSeconds)
{
    const Frames frames = traced(paper_fountain, {"--frames", "450", "--free-run"});
    double before = 0;
    for (std::size_t stream = 0; stream < 3; ++stream) {
        const double half_a_second_later = frames.at(150 * stream + 14).particles;
        EXPECT_NEAR(half_a_second_later - before, 400, 40) << "stream " << stream;
        before = frames.at(150 * stream + 149).particles;
        EXPECT_NEAR(before, double(2000 * (stream + 1)), 200);
    }
}

TEST_F(PaperServer, A63_NoSizeIsAboveItsBoundAndTheRunRepeats)
{
    const Arguments bounded{"--frames", "150", "--set", "control.largest_cluster_size=30"};
    const Frames held = traced(paper_fountain, bounded);
    EXPECT_EQ(replayed(), 0);
    Arguments unreachable = bounded; // 10 us for a frame
    unreachable.insert(unreachable.end(),
                       {"--set", "server.frame_rate=1000", "--set", "control.work_share=0.01"});
    const Frames pressed = traced(paper_fountain, unreachable);
    EXPECT_EQ(pressed.back().size, 30);
    int in_time = 0;
    for (std::size_t frame = 0; frame < 150; ++frame) {
        EXPECT_GE(held.at(frame).size, 1);
        EXPECT_LE(held[frame].size, 30);
        EXPECT_LE(pressed.at(frame).size, 30);
        in_time += held[frame].work_ms <= held[frame].target_ms;
    }
    RecordProperty("frames_within_their_work", in_time);
    RecordProperty("frames_per_second", std::to_string(149 / (held.back().wall_s - held.front().wall_s)));
}

} // namespace
} // namespace slod
