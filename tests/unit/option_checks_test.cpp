#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "idl/option_checks.hpp"
#include "support/scratch_folder.hpp"

namespace slod {
namespace {

/// What a validator says of a text; empty when it takes it.
std::string said(const CLI::Validator& validator, std::string text)
{
    return validator(text);
}

TEST(OptionChecks, ANumberThatIsNotTakenIsToldWhichAre)
{
    EXPECT_EQ(said(between(1, 64), "64"), "");
    EXPECT_EQ(said(between(1, 64), "65"), "65 is no whole number from 1 to 64");
    EXPECT_EQ(said(between(1, 64), "1.5"), "1.5 is no whole number from 1 to 64");
    EXPECT_EQ(said(between(0.0, 1.0), "1.5"), "1.5 is no number from 0 to 1");
    EXPECT_EQ(said(between(0.0, 1.0), "0.5 m"), "0.5 m is no number from 0 to 1");
    EXPECT_EQ(said(at_least_zero<std::uint32_t>(), "-1"), "-1 is no whole number of at least 0");
    EXPECT_EQ(said(at_least_one(), "99999999999999999999"),
              "99999999999999999999 is no whole number from 1 to 18446744073709551615");
}

TEST(OptionChecks, AFileNeedsAFolderThatIsThere)
{
    const ScratchFolder scratch;
    const std::filesystem::path& folder = scratch.path();
    write_file(folder / "old", "");
    EXPECT_EQ(unwritable_file(folder / "new"), "");
    EXPECT_EQ(unwritable_file(folder / "old"), "") << "it is replaced";
    EXPECT_EQ(unwritable_file("new"), "") << "in the current folder";
    EXPECT_EQ(unwritable_file("/dev/null"), "");
    EXPECT_EQ(unwritable_file(folder), folder.string() + " is a folder; name a file in it");
    EXPECT_EQ(unwritable_file(folder / "none" / "new"), "there is no folder " + (folder / "none").string() +
                                                            " for " + (folder / "none" / "new").string() +
                                                            "; make it first, or name a file elsewhere");
    EXPECT_EQ(unwritable_file(folder / "old" / "new"),
              (folder / "old").string() + " is no folder; name another place");
    EXPECT_FALSE(std::filesystem::exists(folder / "new")) << "asking makes nothing";
}

TEST(OptionChecks, APicturesNameSaysThatItIsPng)
{
    const ScratchFolder scratch;
    const auto complaint = [check = writable_png()](std::string place) { return check(place); };
    for (const char* name : {"a.png", "a.PNG"})
        EXPECT_EQ(complaint(scratch.path() / name), "");
    EXPECT_EQ(complaint("/dev/null"), "");
    for (const std::string name : {"a.jpg", "a", "png"})
        EXPECT_EQ(complaint(name), name + " is no name of a PNG picture; let it end with .png");
    EXPECT_NE(complaint(scratch.path() / "none" / "a.jpg").find("there is no folder"), std::string::npos);
}

TEST(OptionChecks, AFolderMayBeMadeWhereAFolderIs)
{
    const ScratchFolder scratch;
    const std::filesystem::path& folder = scratch.path();
    write_file(folder / "file", "");
    EXPECT_EQ(unwritable_folder(folder), "");
    EXPECT_EQ(unwritable_folder(folder / "new" / "newer"), "");
    EXPECT_EQ(unwritable_folder("new"), "") << "in the current folder";
    EXPECT_EQ(unwritable_folder(folder / "file" / "new"),
              (folder / "file").string() + " is no folder; name another place");
}

} // namespace
} // namespace slod
