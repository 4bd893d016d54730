#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "e2e/server_fixture.hpp"

// O'Brien et al. 2001, sections 5.2 and 6.1, on the real server by the real clock: the trace has what each
// frame took and the sizes it ran with, so that every decision can be checked, however fast the machine is.
namespace slod {
namespace {

/// A line of the trace.
struct Row {
    double wall_s, work_ms, target_ms, particles, clusters, size, breadth, switches;
};

std::vector<Row> rows_of(const std::filesystem::path& trace)
{
    std::ifstream file(trace);
    std::string line;
    std::getline(file, line); // the headings
    std::vector<Row> rows;
    while (std::getline(file, line)) {
        std::istringstream stream(line);
        std::vector<std::string> cells;
        for (std::string cell; std::getline(stream, cell, ',');)
            cells.push_back(cell);
        const auto number = [&cells](std::size_t column) { return std::stod(cells.at(column)); };
        rows.push_back({.wall_s = number(2),
                        .work_ms = number(3) + number(4),
                        .target_ms = number(5),
                        .particles = number(7),
                        .clusters = number(8),
                        .size = number(9),
                        .breadth = number(10),
                        .switches = number(13) + number(14)});
    }
    return rows;
}

class PaperServer : public ServerTest {
protected:
    /// Runs a scene off the wire, at its pace unless `more` says otherwise; a row per frame.
    std::vector<Row> traced(const std::string& scene, const Arguments& more)
    {
        const std::filesystem::path trace = folder_ / "trace.csv";
        Arguments arguments{scene, "--no-dds", "--output-dir", folder_, "--trace", trace};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ServerRun run = run_server(arguments);
        EXPECT_EQ(run.exit_code, 0) << run.output;
        return rows_of(trace);
    }

    /// The small fountain by the paper's rule: 64 at most in a cluster, at first.
    std::vector<Row> ruled(int frames, double frame_rate, double work_share, const Arguments& more = {})
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

/// 1 where the mean of the three frames that end with `frame` is above the target, -1 where it is below, and
/// 0 where the trace's four decimals do not say.
int rule(const std::vector<Row>& rows, std::size_t frame)
{
    const double mean = (rows[frame - 2].work_ms + rows[frame - 1].work_ms + rows[frame].work_ms) / 3;
    const double excess = mean - rows[frame].target_ms;
    return std::abs(excess) < 3e-4 ? 0 : excess > 0 ? 1 : -1;
}

/// Checks each size against `next(size, direction)`; how many the trace could say.
template <class Next>
std::size_t expect_rule(const std::vector<Row>& rows, const Next& next)
{
    std::size_t checked = 0;
    for (std::size_t frame = 2; frame + 1 < rows.size(); ++frame) {
        const int direction = rule(rows, frame);
        if (direction == 0)
            continue;
        ++checked;
        EXPECT_NEAR(rows[frame + 1].size, next(rows[frame].size, direction), 2e-4 * rows[frame].size)
            << "after frame " << frame + 1;
    }
    return checked;
}

TEST_F(PaperServer, A52_A53_A55_EachDecisionIsTheRules)
{
    const auto one_more_or_less = [](double size, int direction) {
        return std::clamp(size + direction, 1.0, 256.0);
    };
    const auto idle = ruled(80, 20, 1), busy = ruled(80, 1000, 0.01); // 50 ms for a frame, and 10 us
    EXPECT_LT(idle.back().size, 64);
    EXPECT_GT(busy.back().size, 64);
    const double usual_ms = busy.at(40).work_ms; // for a target that it is now above, now below
    const auto between = ruled(80, 100, std::clamp(usual_ms / 10, 0.01, 1.0));
    for (const auto& rows : {idle, busy, between}) {
        ASSERT_EQ(rows.size(), 80U);
        for (std::size_t frame = 0; frame < 3; ++frame)
            EXPECT_EQ(rows[frame].size, 64) << "no mean of three frames yet";
        EXPECT_GT(expect_rule(rows, one_more_or_less), 60U);
    }
    EXPECT_EQ(replayed(), 0);
}

TEST_F(PaperServer, A54_SizesThatFallAreReachedOverManyFrames)
{
    const auto rows = ruled(100, 25, 1);
    int rising = 0;
    for (std::size_t frame = 20; frame < rows.size(); ++frame) { // the fountain is full
        rising += rows[frame].clusters > rows[frame - 1].clusters;
        EXPECT_LE(rows[frame].switches, std::max(0.2 * rows[frame - 1].clusters, 2.0)) << frame;
    }
    EXPECT_GE(rising, 5);
    EXPECT_GT(rows.back().clusters, 2 * rows[20].clusters);
}

TEST_F(PaperServer, A56_WithSeveralRegionsEachDecisionIsThePercentage)
{
    const auto rows = traced(paper_fountain, {"--frames", "100", "--set", "control.mode=paper", "--set",
                                              "server.frame_rate=1000", "--set", "control.work_share=0.01"});
    EXPECT_GT(rows.back().size, 8);
    const auto percent = [](double size, int direction) {
        return std::min(direction > 0 ? size * 1.1 : size / 1.1, 256.0);
    };
    EXPECT_GT(expect_rule(rows, percent), 20U);
}

TEST_F(PaperServer, A57_TheBreadthDoublesAfterFiveStepsInVainAtTheLargestSize)
{
    const auto rows = ruled(30, 1000, 0.01, {"--set", "control.largest_cluster_size=66"});
    // Three frames without a decision, two to the largest size, five in vain: frames count from 0 here.
    for (std::size_t frame = 0; frame < 9; ++frame)
        EXPECT_EQ(rows.at(frame).breadth, 1) << frame;
    EXPECT_EQ(rows.at(9).breadth, 2);
    EXPECT_EQ(rows.at(14).breadth, 4);
    EXPECT_EQ(rows.back().breadth, 4);
    EXPECT_EQ(rows.back().size, 66);
}

TEST_F(PaperServer, A58_TheWorkIsHeldAndNotThePace)
{
    const auto rows = ruled(150, 100, 0.5);
    for (const Row& row : rows)
        EXPECT_NEAR(row.target_ms, 0.5 * 1000 / 100, 1e-3) << "a share of the period";
    // Paced frames end 10 ms apart and are never early for long, but sizes go by what they work.
    EXPECT_GE(rows.back().wall_s - rows.front().wall_s, 0.95 * 149 * 0.01);
    EXPECT_GT(expect_rule(rows, [](double size, int direction) { return std::max(size + direction, 1.0); }),
              100U);
}

TEST_F(PaperServer, A60_A61_StreamsOfTwoThousandDropletsStartAtZeroFiveAndTenSeconds)
{
    const auto rows = traced(paper_fountain, {"--frames", "450", "--free-run"});
    ASSERT_EQ(rows.size(), 450U);
    for (std::size_t streams = 1; streams <= 3; ++streams)
        EXPECT_NEAR(rows[150 * streams - 1].particles, double(2000 * streams), 200);
}

TEST_F(PaperServer, A62_A63_TheFountainRunsWithSizesWithinTheirBoundsAndRepeats)
{
    const Arguments bounded{"--frames", "150", "--set", "control.largest_cluster_size=30"};
    const auto rows = traced(paper_fountain, bounded);
    EXPECT_EQ(replayed(), 0);
    Arguments unreachable = bounded; // 10 us for a frame
    unreachable.insert(unreachable.end(),
                       {"--set", "server.frame_rate=1000", "--set", "control.work_share=0.01"});
    const auto pressed = traced(paper_fountain, unreachable);
    EXPECT_EQ(pressed.back().size, 30);
    int held = 0;
    for (std::size_t frame = 0; frame < 150; ++frame) {
        EXPECT_GE(rows.at(frame).size, 1);
        EXPECT_LE(rows[frame].size, 30);
        EXPECT_LE(pressed.at(frame).size, 30);
        held += rows[frame].work_ms <= rows[frame].target_ms;
    }
    RecordProperty("frames_within_their_work", held);
    RecordProperty("frames_per_second", std::to_string(149 / (rows.back().wall_s - rows.front().wall_s)));
}

} // namespace
} // namespace slod
