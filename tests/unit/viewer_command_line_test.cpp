#include <array>
#include <filesystem>
#include <fstream>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "support/scratch_folder.hpp"
#include "viewer/camera_file.hpp"
#include "viewer/command_line.hpp"

namespace slod::viewer {
namespace {

std::variant<CommandLine, ExitCode> parsed(const std::vector<std::string>& words)
{
    std::vector<const char*> arguments{"slod-viewer"};
    for (const std::string& word : words)
        arguments.push_back(word.c_str());
    return parse_command_line(int(arguments.size()), arguments.data());
}

class ViewerCommandLine : public testing::Test {
protected:
    const ScratchFolder scratch;
    const std::filesystem::path file = scratch.path() / "camera.txt";
    const view::Camera saved{.look_at = {1, 2, 3}, .distance = 4, .azimuth_deg = 5, .elevation_deg = 6};
};

TEST_F(ViewerCommandLine, ASavedCameraIsReadAtTheStartUnlessAnotherIsNamed)
{
    save_camera(saved, file);
    const auto from_file = parsed({"--camera-file", file.string()});
    ASSERT_TRUE(std::holds_alternative<CommandLine>(from_file));
    EXPECT_EQ(std::get<CommandLine>(from_file).camera, saved);
    const auto named = parsed({"--camera", "distance=9", "--camera-file", file.string()});
    ASSERT_TRUE(std::holds_alternative<CommandLine>(named));
    EXPECT_EQ(std::get<CommandLine>(named).camera->distance, 9);
}

TEST_F(ViewerCommandLine, WithoutEitherTheFirstFrameSetsTheCamera)
{
    const auto line = parsed({"--camera-file", file.string()});
    ASSERT_TRUE(std::holds_alternative<CommandLine>(line));
    EXPECT_FALSE(std::get<CommandLine>(line).camera);
}

TEST_F(ViewerCommandLine, AFileWithoutACameraIsRefusedByItsName)
{
    std::ofstream(file) << "distance=-1";
    testing::internal::CaptureStderr();
    const auto refused = parsed({"--camera-file", file.string()});
    const std::string said = testing::internal::GetCapturedStderr();
    ASSERT_TRUE(std::holds_alternative<ExitCode>(refused));
    EXPECT_EQ(std::get<ExitCode>(refused), ExitCode::Usage);
    EXPECT_NE(said.find(file.string()), std::string::npos) << said;
    EXPECT_NE(said.find("distance"), std::string::npos) << said;
}

TEST_F(ViewerCommandLine, ARangeIsFixedAndTheRestIsAsUsual)
{
    const auto line = parsed({"--camera-file", file.string(), "--range", "-1.5,20", "--size", "320x200"});
    ASSERT_TRUE(std::holds_alternative<CommandLine>(line));
    const auto& [colours, size] =
        std::pair{std::get<CommandLine>(line).colours, std::get<CommandLine>(line).size};
    EXPECT_FALSE(colours.automatic);
    EXPECT_EQ(colours.low, -1.5);
    EXPECT_EQ(colours.high, 20);
    EXPECT_EQ(size, (view::Viewport{.width = 320, .height = 200}));
    EXPECT_TRUE(std::get<CommandLine>(line).outlines);
}

} // namespace
} // namespace slod::viewer
