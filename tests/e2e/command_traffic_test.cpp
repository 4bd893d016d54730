#include <algorithm>
#include <fstream>
#include <memory>
#include <set>
#include <signal.h>
#include <stdexcept>
#include <thread>

#include "e2e/command_fixture.hpp"
#include "idl/dds.hpp"
#include "support/case_rows.hpp"

// Clients that are many, slow, silent or gone, and what becomes of their commands and of the server's frames.
namespace slod {
namespace {

using namespace std::chrono_literals;
using client::CommandRequest;
using nlohmann::json;
using test::Child;

// One reader of clusters is killed, one is frozen.
TEST_F(Commands, N21_AClientThatDiesOrStopsDelaysNoFrame)
{
    const Child running(server());
    client::Connection connection = connect({.stats = true});
    const Child killed(slodctl({"watch", "--clusters"}));
    const Child frozen(slodctl({"watch", "--clusters"}));
    ASSERT_TRUE(test::eventually([&] { return !killed.output().empty() && !frozen.output().empty(); }));
    ASSERT_TRUE(sees(connection, [&] { return connection.stats() && connection.stats()->frame > 0; }));
    killed.signal(SIGKILL);
    frozen.signal(SIGSTOP);
    const std::uint64_t frame = connection.stats()->frame;
    const std::uint64_t published = connection.stats()->wire.published_frames;
    EXPECT_TRUE(sees(connection, [&] { return connection.stats()->frame > frame + 200; }));
    EXPECT_GT(connection.stats()->wire.published_frames, published);
    test::expect_at_most("frames delayed by a client", double(connection.stats()->wire.delayed_frames), 0);
    test::expect_at_most("samples refused", double(connection.stats()->wire.refused_samples), 0);
}

// Of the frames of a few removals far more than half are published: a wait for the reader that is frozen
// would take a second of each, a hundred frames. The loop alone skips none unless the machine is overloaded.
TEST_F(Commands, N21_TheRemovalOfARegionDoesNotWaitForAReaderThatStandsStill)
{
    const Child running(server());
    client::Connection connection = connect({.stats = true});
    const Child frozen(slodctl({"watch", "--clusters"}));
    const Child reading(slodctl({"watch", "--clusters"}));
    ASSERT_TRUE(test::eventually([&] { return !frozen.output().empty() && !reading.output().empty(); }));
    for (const char* region : {"a", "b", "c"})
        ASSERT_EQ(control({"roi", "add", region, "--radius", "100"}), 0);
    ASSERT_TRUE(sees(connection,
                     [&] { return connection.stats() && connection.stats()->wire.published_frames > 9; }));
    frozen.signal(SIGSTOP);
    const wire::PublisherCounts before = connection.stats()->wire;
    for (const char* region : {"a", "b", "c"})
        ASSERT_EQ(control({"roi", "remove", region}), 0);
    const std::uint64_t frame = connection.stats()->frame;
    ASSERT_TRUE(sees(connection, [&] { return connection.stats()->frame > frame + 100; }));
    const wire::PublisherCounts& after = connection.stats()->wire;
    test::expect_at_least("share of offered frames that are published",
                          double(after.published_frames - before.published_frames) /
                              double(after.offered_frames - before.offered_frames),
                          0.5);
}

// One command is taken at a time; of those that come together, each once, the others are still there the next
// time.
TEST_F(Commands, WhatIsMoreThanTheMostTakenAtOnceWaitsItsTurn)
{
    constexpr std::uint64_t count = 8;
    const Child running(server({"--set", "wire.max_commands=1"}));
    client::Connection connection = connect({});
    wire::Writer<wire::Command> writer(connection.participant());
    wire::Reader<wire::CommandReply> reader(connection.participant());
    ASSERT_TRUE(sees(connection, [&] { return writer.matched() && reader.matched(); }));
    wire::Command command{};
    wire::set(command.client, wire::new_uuid());
    wire::set(command.kind, "keep_alive");
    std::set<std::uint64_t> answered;
    const auto answers = [&] {
        reader.take_each(100, [&](const wire::CommandReply& reply, const dds_sample_info_t& info) {
            if (info.valid_data && wire::uuid_of(reply.client) == wire::uuid_of(command.client))
                answered.insert(reply.request);
        });
        return answered.size();
    };
    ASSERT_TRUE(test::eventually([&] { // until both ends know each other
        std::this_thread::sleep_for(10ms);
        return writer.write(command) && answers() == 1;
    }));
    while (command.request < count) {
        ++command.request;
        ASSERT_TRUE(writer.write(command));
    }
    EXPECT_TRUE(test::eventually([&] { return answers() == 1 + count; }))
        << answered.size() - 1 << " are answered";
}

// As long as an answer lives, and no longer, the server keeps its instance for the client.
TEST_F(Commands, AnswersToAClientThatIsSilentAreForgotten)
{
    const Child running(server());
    client::Connection connection = connect({});
    wire::Writer<wire::Command> writer(connection.participant());
    wire::Reader<wire::CommandReply> reader(connection.participant());
    wire::Command command{};
    wire::set(command.client, wire::new_uuid());
    command.request = 1;
    wire::set(command.kind, "keep_alive");
    bool answered = false, gone = false;
    const auto look = [&] {
        std::this_thread::sleep_for(10ms);
        reader.take_each(100, [&](const wire::CommandReply& reply, const dds_sample_info_t& info) {
            if (wire::uuid_of(reply.client) != wire::uuid_of(command.client))
                return;
            answered = answered || info.valid_data;
            gone = info.instance_state == DDS_NOT_ALIVE_DISPOSED_INSTANCE_STATE;
        });
    };
    ASSERT_TRUE(test::eventually([&] { // until both ends know each other
        look();
        return writer.write(command) && answered;
    }));
    EXPECT_FALSE(gone);
    EXPECT_TRUE(test::eventually([&] {
        look();
        return gone;
    }));
}

TEST_F(Commands, WithoutAServerNothingIsWrittenAndNoMoreIsTakenThanMayWait)
{
    const client::Connection connection = connect({});
    client::Commander commander(connection.participant());
    while (commander.waiting() < client::Commander::max_waiting)
        commander.send({.kind = "keep_alive"});
    EXPECT_THROW(commander.send({.kind = "keep_alive"}), std::logic_error);
    for (int polls = 0; polls < 3; ++polls)
        commander.poll();
    EXPECT_EQ(commander.waiting(), client::Commander::max_waiting);
    EXPECT_EQ(commander.rewrites(), 0U) << "what was not written at all was not written again";
}

/// One of many who command at once: its next request, one after the other over all kinds that change regions.
CommandRequest next_request(const std::string& own, int index)
{
    const double x = index % 7;
    switch (index % 5) {
    case 0:
        return {.kind = "add_roi", .region = own, .half_extent = {1, 1, 1}, .settings = {{"shape", "box"}}};
    case 1:
        return {.kind = "move_roi", .region = own, .centre = {x, 0, 0}};
    case 2:
        return {.kind = "move_roi", .region = "common", .centre = {0, x, 0}};
    case 3:
        return {.kind = "set_roi",
                .region = own,
                .settings = {{"max_cluster_size", std::to_string(1 + index % 64)}}};
    default:
        return {.kind = "remove_roi", .region = own};
    }
}

/// What the input log says the regions are in the end: by name, the settings as written.
std::map<std::string, json> regions_by_log(const std::filesystem::path& file)
{
    std::map<std::string, json> regions;
    std::ifstream stream(file);
    for (std::string text; std::getline(stream, text);) {
        const json line = json::parse(text);
        const std::string command = line.value("command", "");
        if (command == "remove_region")
            regions.erase(line.at("region"));
        else if (line.contains("region"))
            regions[line.at("region")] = line.at("settings");
    }
    return regions;
}

// A commander has at most max_waiting requests under way, so they come in order; each of the last round but
// one removes its region, and the last adds one again.
TEST_F(Commands, TenThousandFromEightCommandersAreEachAnsweredOnceAndTheStateIsAsTheLogSays)
{
    constexpr int each = 1250, crowd = 8;
    Child running(server());
    client::Connection connection = connect({.regions = true});
    ASSERT_EQ(control({"roi", "add", "common", "--radius", "1"}), 0);
    struct Member {
        std::unique_ptr<client::Commander> commander;
        int sent = 0, answered = 0;
    };
    std::vector<Member> members(crowd);
    for (Member& member : members)
        member.commander = std::make_unique<client::Commander>(connection.participant());
    const auto go_on = [&](Member& member, const std::string& own) {
        client::Commander& commander = *member.commander;
        while (member.sent < each && commander.waiting() < client::Commander::max_waiting)
            commander.send(next_request(own, member.sent++));
        commander.wait(std::stop_token(), 1ms);
        for (const auto& [number, reply] : commander.take_answers()) {
            ++member.answered;
            EXPECT_TRUE(reply.applied()) << own << " " << number << ": " << reply.text;
            EXPECT_GT(reply.applied_frame, 0U);
        }
    };
    ASSERT_TRUE(test::eventually([&] {
        for (std::size_t i = 0; i < members.size(); ++i)
            go_on(members[i], "c" + std::to_string(i));
        return std::all_of(members.begin(), members.end(), [](const Member& member) {
            return member.answered >= each && member.commander->waiting() == 0;
        });
    }));
    for (const Member& member : members)
        EXPECT_EQ(member.answered, each);
    ASSERT_EQ(control({"roi", "set", "common", "max_cluster_size=33"}), 0);
    const std::uint64_t last = answer.at("revision");
    ASSERT_TRUE(sees(connection, [&] {
        const auto common = connection.regions().find("common");
        return common != connection.regions().end() && common->second.revision == last;
    }));
    const client::Connection::Regions told = connection.regions();
    EXPECT_EQ(control({"stop"}), 0);
    EXPECT_EQ(running.wait(), 0);

    const std::map<std::string, json> logged = regions_by_log(log());
    EXPECT_EQ(logged.size() + 1, told.size()) << "and the background, which nobody changed";
    for (const auto& [name, settings] : logged) {
        ASSERT_TRUE(told.contains(name));
        const auto& region = told.at(name);
        const auto centre = [](double value) { return json(value).dump(); };
        const std::string place = "centre=[" + centre(region.centre[0]) + ", " + centre(region.centre[1]) +
                                  ", " + centre(region.centre[2]) + "]";
        EXPECT_NE(std::find(settings.begin(), settings.end(), place), settings.end()) << place << settings;
    }
    EXPECT_EQ(replay(), 0);
}

} // namespace
} // namespace slod
