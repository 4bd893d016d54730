#include <algorithm>
#include <optional>

#include "e2e/command_fixture.hpp"
#include "idl/dds.hpp"

// Commands from end to end: the real server and slodctl, over loopback.
namespace slod {
namespace {

using namespace std::chrono_literals;
using ctl::ExitCode;
using nlohmann::json;
using test::Child;

/// Particles of a region in a frame; none where the frame does not list it.
std::optional<std::uint64_t> particles_in(const client::ClusterFrame& frame, const std::string& region)
{
    for (const client::RegionClusters& each : frame.regions)
        if (each.region == region) {
            std::uint64_t sum = 0;
            for (const std::uint32_t count : each.particles)
                sum += count;
            return sum;
        }
    return {};
}

// Frame by frame: a region about everything takes all stars, far away it has none, grown it has them again,
// removed it leaves them to the background, each from the very frame that the reply names.
TEST_F(Commands, ARegionHasItsStateAndItsMembersFromTheFrameThatTheReplyNames)
{
    Child running(server());
    client::Connection connection = connect({.clusters = true, .regions = true});
    ASSERT_TRUE(sees(connection, [&] { return connection.frame() && connection.knows_all_regions(); }))
        << running.errors();
    ASSERT_EQ(control({"pause"}), 0);
    ASSERT_EQ(control({"step"}), 0); // the frame before may have come too soon after another to be published
    ASSERT_TRUE(sees(connection, [&] {
        return connection.server()->paused && connection.frame()->frame == connection.server()->frame;
    }));
    const std::uint64_t all = *particles_in(*connection.frame(), "background");
    EXPECT_EQ(all, 2000U);

    const auto expect = [&](CommandTest::Words words, std::optional<std::uint64_t> members,
                            double half_extent) {
        SCOPED_TRACE(words[1]);
        const std::uint64_t before = connection.frame()->frame;
        words.insert(words.begin(), "roi");
        ASSERT_EQ(control(words), 0) << answer;
        const std::uint64_t applied = answer.at("applied_frame");
        EXPECT_EQ(applied, before + 1);
        if (members) {
            const std::uint64_t revision = answer.at("revision");
            EXPECT_TRUE(sees(connection, [&] {
                const auto region = connection.regions().find("all");
                return region != connection.regions().end() && region->second.revision == revision;
            }));
            EXPECT_EQ(connection.regions().at("all").half_extent[0], half_extent);
        } else {
            EXPECT_TRUE(sees(connection, [&] { return !connection.regions().contains("all"); }));
        }
        ASSERT_EQ(control({"step"}), 0);
        ASSERT_TRUE(sees(connection, [&] { return connection.frame()->frame == applied; }));
        EXPECT_EQ(particles_in(*connection.frame(), "all"), members);
        EXPECT_EQ(particles_in(*connection.frame(), "background"), all - members.value_or(0));
    };
    expect({"add", "all", "--centre", "0,0,0", "--half-extent", "1e6", "--set", "max_cluster_size=16"}, all,
           1e6);
    expect({"move", "all", "--centre", "-1e7,0,0"}, 0, 1e6);
    expect({"resize", "all", "--half-extent", "2e7,2e7,2e7"}, all, 2e7);
    expect({"remove", "all"}, std::nullopt, 0);
    EXPECT_EQ(control({"stop"}), 0);
    EXPECT_EQ(running.wait(), 0);
    EXPECT_EQ(replay(), 0);
}

TEST_F(Commands, ALateClientSeesEveryRegion)
{
    Child running(server());
    constexpr int count = 200;
    {
        client::Connection connection = connect({});
        client::Commander commander(connection.participant());
        for (int i = 0; i < count; ++i) {
            const std::uint64_t request = commander.send({.kind = "add_roi",
                                                          .region = "r" + std::to_string(i),
                                                          .centre = {double(i), 0, 0},
                                                          .radius = 0.5,
                                                          .settings = {{"shape", "sphere"}}});
            ASSERT_TRUE(test::eventually([&] {
                commander.wait(std::stop_token(), 50ms);
                const auto reply = commander.take_answer(request);
                EXPECT_TRUE(!reply || reply->applied()) << reply->text;
                return reply.has_value();
            }));
        }
    }
    Child list(slodctl({"roi", "list", "--json"}));
    ASSERT_EQ(list.wait(), 0) << list.errors();
    const std::string lines = list.output();
    EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), count + 1);
    Child table(slodctl({"roi", "list"}));
    ASSERT_EQ(table.wait(), 0) << table.errors();
    EXPECT_NE(table.output().find(" present_max_cluster_size "), std::string::npos) << table.output();
    EXPECT_EQ(control({"roi", "show", "r7"}), 0);
    EXPECT_EQ(answer.at("centre"), json({7, 0, 0}));
    EXPECT_EQ(answer.at("shape"), "sphere");
    EXPECT_EQ(answer.at("partition"), "roi/r7");
    EXPECT_EQ(control({"roi", "show", "r100"}), 0);
    EXPECT_EQ(answer.at("partition"), "auto") << "only 64 have partitions of their own";
    EXPECT_EQ(control({"roi", "show", "r200"}), int(ExitCode::NotFound));
    Child lost({SLODCTL, "echo", "clusters", "--region", "r200", "--once", "--timeout", "3", "--domain",
                domain.text()});
    EXPECT_EQ(lost.wait(), int(ExitCode::NotFound)) << lost.errors();
}

TEST_F(Commands, TheRegionOfAClientThatIsGoneEndsWithItsLease)
{
    Child running(server());
    ASSERT_EQ(control({"roi", "add", "lent", "--radius", "1", "--lease", "0.5"}), 0);
    client::Connection connection = connect({.regions = true});
    EXPECT_TRUE(sees(connection, [&] {
        return connection.knows_all_regions() && !connection.regions().contains("lent");
    }));
    EXPECT_EQ(control({"roi", "move", "lent", "--centre", "1,2,3"}), int(ExitCode::NotFound));
    EXPECT_EQ(control({"stop"}), 0);
    EXPECT_EQ(running.wait(), 0);
    EXPECT_EQ(replay(), 0) << "the removal is in the log";
}

TEST_F(Commands, AViewMovesTheFrustumThatFollowsIt)
{
    const Child running(server());
    ASSERT_EQ(control({"roi", "add", "seen", "--set", "shape=frustum", "--set", "follows=a desk", "--set",
                       "view_share=0.5"}),
              0)
        << answer;
    client::Connection connection = connect({.regions = true});
    wire::Writer<wire::View> writer(connection.participant());
    wire::View view{};
    wire::set(view.client, wire::new_uuid());
    wire::set(view.client_name, "a desk");
    view.eye = {1, 2, 3};
    view.look_at = {1, 2, 0};
    view.up = {0, 1, 0};
    view.field_of_view_deg = 50;
    view.width_px = 300;
    view.height_px = 200;
    EXPECT_TRUE(writer.write(view));
    EXPECT_TRUE(sees(connection, [&] {
        const auto seen = connection.regions().find("seen");
        return seen != connection.regions().end() && seen->second.centre == std::array<double, 3>{1, 2, 3};
    }));
    const client::RegionInfo& seen = connection.regions().at("seen");
    EXPECT_EQ(seen.field_of_view_deg, 25);
    EXPECT_EQ(seen.aspect, 1.5);
    EXPECT_EQ(seen.direction, (std::array<double, 3>{0, 0, -3}));
}

TEST_F(Commands, SlodctlsExitCodeSaysWhatBecameOfACommand)
{
    EXPECT_EQ(Child({SLODCTL, "pause", "--domain", domain.text(), "--timeout", "0.2"}).wait(),
              int(ExitCode::NoServer));
    const Child running(server());
    EXPECT_EQ(control({"roi", "add", "a", "--half-extent", "1,2,3"}), int(ExitCode::Success));
    EXPECT_EQ(control({"roi", "add", "a", "--radius", "1"}), int(ExitCode::InvalidArgument));
    EXPECT_EQ(answer.at("result"), "region_exists");
    EXPECT_EQ(control({"roi", "set", "a", "lunch=1"}), int(ExitCode::InvalidArgument));
    EXPECT_EQ(answer.at("field"), "lunch");
    for (const char* nothing : {"0", "-1", "", "nan", "1,1,1"})
        EXPECT_EQ(control({"roi", "add", "b", "--radius", nothing}), int(ExitCode::Usage)) << nothing;
    for (const char* nothing : {"0", "1,0,1", "-1"})
        EXPECT_EQ(control({"roi", "add", "b", "--half-extent", nothing}), int(ExitCode::Usage)) << nothing;
    EXPECT_EQ(control({"roi", "set", "a", "lunch"}), int(ExitCode::Usage));
    EXPECT_EQ(control({"roi", "move", "a", "--centre", "1,2"}), int(ExitCode::Usage));
    EXPECT_EQ(control({"roi", "move", "a", "--centre", "1,2,3", "--if-revision", "12345"}),
              int(ExitCode::InvalidArgument));
    EXPECT_EQ(answer.at("result"), "stale_revision");
    EXPECT_EQ(control({"roi", "remove", "b"}), int(ExitCode::NotFound));
    EXPECT_EQ(control({"roi", "remove", "background"}), int(ExitCode::NotPermitted));
    EXPECT_EQ(control({"roi", "resize", "a"}), int(ExitCode::Usage));
    EXPECT_EQ(control({"roi", "add", "c"}), int(ExitCode::Usage));
    EXPECT_EQ(control({"roi", "add", "c", "--centre", "1,2,3"}), int(ExitCode::Usage));
    EXPECT_EQ(control({"roi", "add", "c", "--set", "max_cluster_size=4"}), int(ExitCode::Usage));
    EXPECT_EQ(control({"roi", "add", "c", "--set", "shape=everywhere"}), int(ExitCode::Success));
    EXPECT_EQ(control({"roi"}), int(ExitCode::Usage));
    EXPECT_EQ(control({"set", "gravity.strength=0.5", "gravity.closure=false"}), int(ExitCode::Success));
    EXPECT_EQ(control({"set", "time.step=1"}), int(ExitCode::InvalidArgument));
    EXPECT_EQ(control({"set", "gravity.strength=" + std::string(5000, '1')}), int(ExitCode::Usage))
        << "no message has room for it";
}

TEST_F(Commands, AServerThatTakesNoCommandsPermitsNone)
{
    const Child running(server({"--set", "wire.commands=false"}));
    client::Connection connection = connect({});
    ASSERT_TRUE(sees(connection, [&] { return connection.server() != nullptr; }));
    EXPECT_EQ(control({"pause"}), int(ExitCode::NotPermitted));
}

// Commands come all the time and a frame takes long, so some are there when the last one is done.
TEST_F(Commands, NothingIsInForceFromAFrameThatNeverRuns)
{
    constexpr std::uint64_t frames = 100;
    Child running(server({"--frames", std::to_string(frames), "--set", "galaxy.particles=20000"}));
    client::Connection connection = connect({});
    client::Commander commander(connection.participant());
    ASSERT_TRUE(sees(connection, [&] { return commander.connected(); })) << running.errors();
    std::uint64_t newest = 0;
    const auto go_on = [&] {
        while (commander.connected() && commander.waiting() < client::Commander::max_waiting)
            commander.send({.kind = "keep_alive"});
        commander.wait(std::stop_token(), 1ms);
        for (const auto& [number, reply] : commander.take_answers())
            newest = std::max(newest, reply.applied_frame);
        return !commander.connected();
    };
    ASSERT_TRUE(test::eventually(go_on)) << "the server did not end";
    EXPECT_EQ(running.wait(), 0);
    EXPECT_GT(newest, 1U);
    EXPECT_LE(newest, frames);
}

TEST_F(Commands, AReplayHasWhatWasChangedBeforeThePauseThatWasTheEnd)
{
    Child running(server());
    ASSERT_EQ(control({"stats"}), 0) << "a run without a frame cannot be repeated";
    ASSERT_EQ(control({"pause"}), 0);
    ASSERT_EQ(control({"roi", "add", "late", "--radius", "1"}), 0);
    ASSERT_EQ(control({"stop"}), 0);
    EXPECT_EQ(running.wait(), 0);
    EXPECT_EQ(replay(), 0);
}

} // namespace
} // namespace slod
