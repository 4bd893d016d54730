#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

#include <gtest/gtest.h>

#include "app/output_file.hpp"

namespace slod {
namespace {

class OutputFileTest : public testing::Test {
protected:
    OutputFileTest() { std::filesystem::create_directories(folder_); }
    ~OutputFileTest() override { std::filesystem::remove_all(folder_); }

    std::ptrdiff_t files() const
    {
        return std::distance(std::filesystem::directory_iterator(folder_),
                             std::filesystem::directory_iterator());
    }
    static std::string content(const std::filesystem::path& file)
    {
        std::ifstream stream(file);
        return {std::istreambuf_iterator<char>(stream), {}};
    }

    const std::filesystem::path folder_ =
        std::filesystem::path(testing::TempDir()) /
        (std::string("slod-output-") + testing::UnitTest::GetInstance()->current_test_info()->name());
    const std::filesystem::path place_ = folder_ / "report.json";
};

TEST_F(OutputFileTest, AppearsWholeUnderItsNameAndLeavesNothingElse)
{
    const std::string text(100'000, 'x');
    OutputFile(place_).commit(text);
    EXPECT_EQ(content(place_), text);
    EXPECT_EQ(files(), 1);
}

TEST_F(OutputFileTest, TheOldFileStaysUntilTheNewOneIsWhole)
{
    OutputFile(place_).commit("old");
    OutputFile file(place_);
    EXPECT_EQ(content(place_), "old");
    file.commit("new");
    EXPECT_EQ(content(place_), "new");
}

TEST_F(OutputFileTest, LeavesNothingWhenItIsNotCommitted)
{
    {
        const OutputFile file(place_);
        EXPECT_EQ(files(), 1);
    }
    EXPECT_EQ(files(), 0);
}

// A folder that is not there, and a name that is a folder's; permissions would not stop root.
TEST_F(OutputFileTest, APlaceThatCannotBeWrittenIsRefusedByNameAtOnce)
{
    for (const std::filesystem::path& place : {folder_ / "none" / "report.json", folder_}) {
        try {
            const OutputFile file(place);
            FAIL() << place << " was accepted";
        } catch (const std::system_error& error) {
            EXPECT_NE(std::string(error.what()).find(place.string()), std::string::npos) << error.what();
        }
    }
}

} // namespace
} // namespace slod
