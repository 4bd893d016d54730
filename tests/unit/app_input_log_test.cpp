#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <sys/resource.h>
#include <sys/stat.h>
#include <vector>

#include <gtest/gtest.h>

#include "app/input_log.hpp"
#include "app/outputs.hpp"
#include "support/scratch_folder.hpp"

namespace slod {
namespace {

class InputLogTest : public testing::Test {
protected:
    InputLog read() const
    {
        const auto log = read_input_log(file_);
        if (const auto* found = std::get_if<Problems>(&log)) {
            ADD_FAILURE() << found->front();
            return {};
        }
        return std::get<InputLog>(log);
    }

    /// What reading says is wrong, in one string.
    std::string problem() const
    {
        const auto log = read_input_log(file_);
        const auto* found = std::get_if<Problems>(&log);
        return found ? found->front() : std::string();
    }

    const ScratchFolder scratch_;
    const std::filesystem::path folder_ = scratch_.path() / "made";
    const std::filesystem::path file_ = folder_ / "input.log";
    const InputLogHeader header_{.version = "1.2.3",
                                 .scene_name = "a.toml",
                                 .scene_text = "title = \"quotes, \\ and\nlines\"\n",
                                 .settings = {"time.step=0.5", "title=\"b\""},
                                 .input = "/data/a b.gadget2",
                                 .initial_source = "a file",
                                 .initial_hash = 0x00ff'0000'0000'0001,
                                 .folder = "/scenes",
                                 .surfaces_hash = 0x1234'5678'9abc'def0};
    const LoggedCommand change_{.frame = 3,
                                .kind = InputKind::ChangeRegion,
                                .region = "core",
                                .settings = {{"centre", "[1.0, 2.0, 3.0]"}, {"follows", "\"a=b\""}}};
};

TEST_F(InputLogTest, AnOlderOneIsKept)
{
    for (int run = 1; run <= 3; ++run) {
        InputLogHeader header = header_;
        header.input = "run " + std::to_string(run);
        InputLogWriter(folder_, header).finish({.frames = 1, .state_hash = 1});
    }
    EXPECT_EQ(read().header.input, "run 3");
    for (const auto& [name, input] : {std::pair("input-1.log", "run 1"), std::pair("input-2.log", "run 2")}) {
        const auto log = read_input_log(folder_ / name);
        ASSERT_TRUE(std::holds_alternative<InputLog>(log)) << name;
        EXPECT_EQ(std::get<InputLog>(log).header.input, input);
    }
}

TEST_F(InputLogTest, AFolderThatCannotBeMadeIsNamedWithTheRemedy)
{
    write_file(scratch_.path() / "file", "");
    try {
        InputLogWriter(scratch_.path() / "file" / "made", header_);
        FAIL() << "no error";
    } catch (const std::runtime_error& error) {
        EXPECT_EQ(error.what(),
                  "cannot make " + (scratch_.path() / "file" / "made").string() +
                      " for the input log: Not a directory; name a folder that can be written to");
    }
}

TEST_F(InputLogTest, WhatWasWrittenIsReadBack)
{
    InputLogWriter writer(folder_, header_);
    writer.record(change_);
    writer.record({.frame = 4, .kind = InputKind::RemoveRegion, .region = "core", .settings = {}});
    writer.finish({.frames = 12, .state_hash = 0xfedc'ba98'7654'3210});

    const InputLog log = read();
    EXPECT_EQ(log.header.version, header_.version);
    EXPECT_EQ(log.header.scene_name, header_.scene_name);
    EXPECT_EQ(log.header.scene_text, header_.scene_text);
    EXPECT_EQ(log.header.settings, header_.settings);
    EXPECT_EQ(log.header.input, header_.input);
    EXPECT_EQ(log.header.initial_source, header_.initial_source);
    EXPECT_EQ(log.header.initial_hash, header_.initial_hash);
    EXPECT_EQ(log.header.folder, header_.folder);
    EXPECT_EQ(log.header.surfaces_hash, header_.surfaces_hash);
    ASSERT_EQ(log.commands.size(), 2U);
    EXPECT_EQ(log.commands[0], change_);
    EXPECT_EQ(log.commands[1].kind, InputKind::RemoveRegion);
    EXPECT_EQ(log.commands[1].region, "core");
    ASSERT_TRUE(log.end);
    EXPECT_EQ(log.end->frames, 12U);
    EXPECT_EQ(log.end->state_hash, 0xfedc'ba98'7654'3210);
}

// The writer is not even closed: each line is in the file when record() returns.
// A name and a setting as a command line may have them: any bytes.
TEST_F(InputLogTest, WhatIsNoTextIsReplaced)
{
    InputLogHeader header = header_;
    header.input = "/data/bad\xff.gadget2";
    header.settings = {"title=\xff"};
    InputLogWriter(folder_, header).finish({.frames = 1, .state_hash = 2});
    EXPECT_EQ(read().header.input, "/data/bad\xef\xbf\xbd.gadget2");
    EXPECT_EQ(read().header.settings.front(), "title=\xef\xbf\xbd");
}

// Nobody writes into the pipe: opened, it would be waited on for ever.
TEST_F(InputLogTest, WhatIsNoRegularFileIsNotOpened)
{
    std::filesystem::create_directories(folder_);
    ASSERT_EQ(mkfifo(file_.c_str(), 0600), 0);
    EXPECT_EQ(problem(), file_.string() + ": there is no such regular file; name an input log");
}

TEST_F(InputLogTest, ALogThatWasCutShortIsReadWithoutAnEnd)
{
    InputLogWriter writer(folder_, header_);
    writer.record(change_);
    const InputLog log = read();
    EXPECT_EQ(log.commands.size(), 1U);
    EXPECT_FALSE(log.end);
}

TEST_F(InputLogTest, ABadLineIsNamedByFileAndNumber)
{
    for (const char* line :
         {"not json", "{}", R"({"frames":1,"state_hash":"12"})",
          R"({"frames":1,"state_hash":"xyzxyzxyzxyzxyzx"})", R"({"frame":4,"command":2})",
          R"({"frame":4,"command":"dance"})", R"({"frame":2,"command":"remove_region","region":"a"})",
          R"({"frame":4,"command":"change_settings","settings":["no value"]})"}) {
        SCOPED_TRACE(line);
        InputLogWriter(folder_, header_).record(change_);
        std::ofstream(file_, std::ios::app) << line << '\n';
        EXPECT_EQ(problem().find(file_.string() + ":3: "), 0U) << problem();
        EXPECT_EQ(problem().find("json.exception"), std::string::npos) << problem();
    }
}

TEST_F(InputLogTest, NothingMayFollowTheEnd)
{
    InputLogWriter writer(folder_, header_);
    writer.finish({.frames = 1, .state_hash = 1});
    writer.record(change_);
    EXPECT_EQ(problem().find(file_.string() + ":3: "), 0U) << problem();
}

// The last two differ from a log only in the name or the version of their format.
TEST_F(InputLogTest, AnotherKindOfFileIsNoLog)
{
    InputLogWriter(folder_, header_).finish({.frames = 1, .state_hash = 1});
    const std::string log = file_content(file_);
    const auto replaced = [&](const std::string& part, const std::string& by) {
        return std::string(log).replace(log.find(part), part.size(), by);
    };
    const std::vector<std::pair<std::string, std::string>> others{
        {"", "is empty; name one"},
        {"title = \"a scene\"\n", ":1: this is no input log; name the input.log"},
        {"3\n", ":1: this is no input log; name the input.log"},
        {replaced("slod-input-log", "another-log"), ":1: this is no input log; name the input.log"},
        {replaced("\"format_version\":2", "\"format_version\":1"),
         "format version 1, and this server reads 2"}};
    for (const auto& [text, says] : others) {
        write_file(file_, text);
        EXPECT_NE(problem().find(says), std::string::npos) << problem();
    }
}

/// Lets no file of this process grow beyond `bytes`, as a full disk would not.
class FullDisk {
public:
    explicit FullDisk(std::uintmax_t bytes)
    {
        ::getrlimit(RLIMIT_FSIZE, &before_);
        rlimit limit = before_;
        limit.rlim_cur = bytes;
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FullDisk()
    {
        ::setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }
    FullDisk(const FullDisk&) = delete;
    FullDisk& operator=(const FullDisk&) = delete;

private:
    void (*handler_)(int) = std::signal(SIGXFSZ, SIG_IGN);
    rlimit before_{};
};

TEST_F(InputLogTest, EndsWhereItCannotBeWrittenAndTheRunGoesOn)
{
    CommandLine line;
    line.output_folder = folder_;
    Outputs outputs(line, header_);
    outputs.record(change_);
    {
        const FullDisk disk(std::filesystem::file_size(file_));
        EXPECT_NO_THROW(outputs.record(change_));
    }
    EXPECT_NO_THROW(outputs.record(change_));
    const InputLog log = read();
    EXPECT_EQ(log.commands, std::vector{change_});
    EXPECT_FALSE(log.end);
}

} // namespace
} // namespace slod
