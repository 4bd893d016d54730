#include <filesystem>
#include <iterator>
#include <string>
#include <sys/stat.h>
#include <system_error>

#include <gtest/gtest.h>

#include "app/output_file.hpp"
#include "support/scratch_folder.hpp"

namespace slod {
namespace {

class OutputFileTest : public testing::Test {
protected:
    std::ptrdiff_t files() const
    {
        return std::distance(std::filesystem::directory_iterator(scratch_.path()),
                             std::filesystem::directory_iterator());
    }

    const ScratchFolder scratch_;
    const std::filesystem::path place_ = scratch_.path() / "report.json";
};

TEST_F(OutputFileTest, AppearsWholeUnderItsNameAndLeavesNothingElse)
{
    const std::string text(100'000, 'x');
    OutputFile(place_).commit(text);
    EXPECT_EQ(file_content(place_), text);
    EXPECT_EQ(files(), 1);
}

TEST_F(OutputFileTest, TheOldFileStaysUntilTheNewOneIsWhole)
{
    OutputFile(place_).commit("old");
    OutputFile file(place_);
    EXPECT_EQ(file_content(place_), "old");
    file.commit("new");
    EXPECT_EQ(file_content(place_), "new");
}

TEST_F(OutputFileTest, LeavesNothingWhenItIsNotCommitted)
{
    {
        const OutputFile file(place_);
        EXPECT_EQ(files(), 1);
    }
    EXPECT_EQ(files(), 0);
}

// To a file, through two links, and to a place where nothing is yet.
TEST_F(OutputFileTest, ASymlinkStaysAndWhatItLeadsToIsReplaced)
{
    const std::filesystem::path folder = scratch_.path() / "folder";
    const std::filesystem::path target = folder / "target.json";
    std::filesystem::create_directory(folder);
    std::filesystem::create_symlink("target.json", folder / "link");
    std::filesystem::create_symlink(folder / "link", place_);
    for (const std::string text : {"first", "second"}) {
        OutputFile(place_).commit(text);
        EXPECT_TRUE(std::filesystem::is_symlink(place_));
        EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
        EXPECT_EQ(file_content(target), text);
    }
    EXPECT_EQ(files(), 2) << "link and folder";
}

// Through a link beside which nothing shall be left either.
TEST_F(OutputFileTest, ACharacterDeviceIsWrittenToAsItStands)
{
    std::filesystem::create_symlink("/dev/null", place_);
    OutputFile(place_).commit("text");
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
    EXPECT_TRUE(std::filesystem::is_symlink(place_));
    EXPECT_EQ(files(), 1);
}

TEST_F(OutputFileTest, APipeIsRefusedAndStays)
{
    ASSERT_EQ(mkfifo(place_.c_str(), 0600), 0);
    EXPECT_THROW(OutputFile{place_}, std::system_error);
    EXPECT_TRUE(std::filesystem::is_fifo(place_));
}

TEST_F(OutputFileTest, LinksInACircleAreRefused)
{
    std::filesystem::create_symlink(place_, scratch_.path() / "other");
    std::filesystem::create_symlink(scratch_.path() / "other", place_);
    EXPECT_THROW(OutputFile{place_}, std::system_error);
}

// A folder that is not there, and a name that is a folder's; permissions would not stop root.
TEST_F(OutputFileTest, APlaceThatCannotBeWrittenIsRefusedByNameAtOnce)
{
    for (const std::filesystem::path& place : {scratch_.path() / "none" / "report.json", scratch_.path()}) {
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
