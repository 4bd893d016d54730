#include "idl/output_place.hpp"

#include <system_error>
#include <unistd.h>

namespace slod {

namespace {

/// Why no file can be made in a folder.
std::string closed(const std::filesystem::path& folder)
{
    std::error_code ignored;
    if (!std::filesystem::is_directory(folder, ignored))
        return folder.string() + " is no folder; name another place";
    if (::access(folder.c_str(), W_OK | X_OK) != 0)
        return "nothing may be written in the folder " + folder.string() +
               "; change its permissions, or name another place";
    return {};
}

std::filesystem::path folder_of(const std::filesystem::path& place)
{
    return place.has_parent_path() ? place.parent_path() : ".";
}

} // namespace

std::string unwritable_file(const std::filesystem::path& place)
{
    std::error_code ignored;
    if (place.empty())
        return "there is no name; name a file";
    if (std::filesystem::is_directory(place, ignored))
        return place.string() + " is a folder; name a file in it";
    const std::filesystem::path folder = folder_of(place);
    if (!std::filesystem::exists(folder, ignored))
        return "there is no folder " + folder.string() + " for " + place.string() +
               "; make it first, or name a file elsewhere";
    return std::filesystem::is_character_file(place, ignored) ? std::string() : closed(folder);
}

std::string unwritable_folder(const std::filesystem::path& place)
{
    std::error_code ignored;
    std::filesystem::path there = std::filesystem::absolute(place, ignored);
    while (!std::filesystem::exists(there, ignored) && there.has_relative_path())
        there = there.parent_path();
    return closed(there);
}

} // namespace slod
