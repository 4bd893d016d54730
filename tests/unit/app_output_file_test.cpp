#include <filesystem>
#include <iterator>
#include <string>
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
