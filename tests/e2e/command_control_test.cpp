#include "e2e/command_fixture.hpp"
#include "support/paper_rule.hpp"

// What holds the frame rate, on the real server while somebody reads.
namespace slod {
namespace {

using test::Child;

// The target is between the step and the step with its encoding, so that the two ask for opposite things.
TEST_F(Commands, A58_TheWorkHasTheEncodingInIt)
{
    const std::filesystem::path trace = scratch.path() / "trace.csv";
    Child running(server(
        {"--set", "control.mode=off", "--set", "background.max_cluster_size=2", "--trace", trace.string()}));
    client::Connection connection = connect({.stats = true, .clusters = true});
    ASSERT_TRUE(sees(connection, [&] {
        return connection.complete_frames() > 150 && connection.stats() &&
               connection.stats()->wire.encode_ms > 0;
    })) << running.errors();
    const client::ServerStats& stats = *connection.stats();
    const double share = std::clamp((stats.work_ms + 0.5 * stats.wire.encode_ms) / 10, 0.01, 1.0);
    ASSERT_EQ(control({"set", "control.mode=paper", "control.work_share=" + std::to_string(share)}), 0)
        << answer;
    const std::uint64_t seen = connection.complete_frames();
    ASSERT_TRUE(sees(connection, [&] { return connection.complete_frames() > seen + 100; }));
    ASSERT_EQ(control({"stop"}), 0);
    ASSERT_EQ(running.wait(), 0);

    const auto frames = test::traced_frames(trace);
    std::size_t first = 0;
    while (first < frames.size() && frames[first].target_ms == 0)
        ++first;
    int encoded = 0;
    for (std::size_t frame = first; frame < frames.size(); ++frame)
        encoded += frames[frame].encode_ms > 0;
    EXPECT_GT(encoded, 50);
    const auto one_more_or_less = [](double size, int direction) {
        return std::clamp(size + direction, 1.0, 256.0);
    };
    EXPECT_GT(test::expect_rule(frames, one_more_or_less, first).all(), 50);
}

} // namespace
} // namespace slod
