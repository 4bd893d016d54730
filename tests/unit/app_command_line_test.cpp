#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "app/command_line.hpp"

namespace slod {
namespace {

std::variant<CommandLine, ExitCode> parse(std::vector<const char*> arguments)
{
    arguments.insert(arguments.begin(), "slod-server");
    return parse_command_line(int(arguments.size()), arguments.data());
}

CommandLine accepted(const std::vector<const char*>& arguments)
{
    const auto parsed = parse(arguments);
    EXPECT_TRUE(std::holds_alternative<CommandLine>(parsed));
    return std::holds_alternative<CommandLine>(parsed) ? std::get<CommandLine>(parsed) : CommandLine{};
}

TEST(CommandLine, SettingsKeepTheirOrderAndDoNotSwallowTheScene)
{
    const CommandLine line =
        accepted({"--set", "a.b=1", "--set", "a.c=[1, 2]", "scene.toml", "--frames", "3"});
    EXPECT_EQ(line.settings, (std::vector<std::string>{"a.b=1", "a.c=[1, 2]"}));
    EXPECT_EQ(line.scene, "scene.toml");
    EXPECT_EQ(line.frames, 3U);
}

// What decides where the run happens must not get into the log of what is simulated.
TEST(CommandLine, ShorthandsAreSettingsOfTheirOwnKind)
{
    const CommandLine line = accepted({"scene.toml", "--threads", "3", "--domain", "7", "--no-dds"});
    EXPECT_TRUE(line.settings.empty());
    EXPECT_EQ(line.placement,
              (std::vector<std::string>{"server.threads=3", "wire.domain=7", "wire.enabled=false"}));
}

TEST(CommandLine, WrongUsageIsRefused)
{
    const std::vector<std::vector<const char*>> wrong{{},
                                                      {"scene.toml", "--unknown"},
                                                      {"scene.toml", "--frames", "0"},
                                                      {"scene.toml", "--frames", "-1"},
                                                      {"scene.toml", "--frames", "many"},
                                                      {"scene.toml", "second.toml"},
                                                      {"scene.toml", "--threads", "-1"},
                                                      {"scene.toml", "--frames", "99999999999999999999"},
                                                      {"scene.toml", "--replay", "input.log"},
                                                      {"--replay", "input.log", "--set", "a.b=1"},
                                                      {"--replay", "input.log", "--frames", "3"}};
    for (const auto& arguments : wrong) {
        const auto parsed = parse(arguments);
        const auto* code = std::get_if<ExitCode>(&parsed);
        EXPECT_TRUE(code && *code == ExitCode::Usage) << testing::PrintToString(arguments);
    }
}

TEST(CommandLine, APlaceThatCannotBeWrittenIsWrongUsageWithTheRemedy)
{
    for (const char* option : {"--report", "--picture", "--trace"}) {
        testing::internal::CaptureStderr();
        const auto parsed = parse({"scene.toml", option, "/no/folder/file"});
        const std::string said = testing::internal::GetCapturedStderr();
        const auto* code = std::get_if<ExitCode>(&parsed);
        EXPECT_TRUE(code && *code == ExitCode::Usage) << option;
        EXPECT_TRUE(said.starts_with(std::string(option) + ": there is no folder /no/folder for "
                                                           "/no/folder/file; make it first, or name a file "
                                                           "elsewhere\n"))
            << said;
    }
}

TEST(CommandLine, AskingForHelpIsNoMistake)
{
    for (const char* question : {"--help", "--version"}) {
        const auto parsed = parse({question});
        const auto* code = std::get_if<ExitCode>(&parsed);
        EXPECT_TRUE(code && *code == ExitCode::Success) << question;
    }
    EXPECT_TRUE(accepted({"--keys"}).keys);
}

} // namespace
} // namespace slod
