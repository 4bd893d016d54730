#include "app/output_file.hpp"

#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <string>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace slod {
namespace {

bool write_all(int descriptor, std::string_view content)
{
    while (!content.empty()) {
        const ssize_t written = ::write(descriptor, content.data(), content.size());
        if (written < 0 && errno == EINTR)
            continue;
        if (written < 0)
            return false;
        content.remove_prefix(std::size_t(written));
    }
    return true;
}

/// Makes a rename last. A folder that cannot be synced (some network file systems) is no failure.
void sync_folder(const std::filesystem::path& folder)
{
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0)
        return;
    ::fsync(descriptor);
    ::close(descriptor);
}

/// Where symlinks lead from `place`, whether or not anything is there.
std::filesystem::path end_of_links(std::filesystem::path place)
{
    constexpr int most_links = 40; // as in the kernel
    std::error_code ignored;
    for (int link = 0; link < most_links && std::filesystem::is_symlink(place, ignored); ++link)
        place = place.parent_path() / std::filesystem::read_symlink(place);
    return place;
}

} // namespace

OutputFile::OutputFile(std::filesystem::path place) : place_(std::move(place))
{
    std::error_code error;
    const auto status = std::filesystem::status(place_, error);
    if (std::filesystem::is_character_file(status)) {
        descriptor_ = ::open(place_.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC);
        if (descriptor_ < 0)
            fail("cannot write");
        return;
    }
    if (std::filesystem::is_directory(status))
        throw std::system_error(EISDIR, std::generic_category(), "cannot write " + place_.string());
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
        throw std::system_error(EINVAL, std::generic_category(),
                                "cannot write " + place_.string() + ", which is no regular file");
    if (error == std::errc::too_many_symbolic_link_levels)
        throw std::system_error(error, "cannot write " + place_.string());
    place_ = end_of_links(place_);
    std::string name = place_.string() + ".XXXXXX";
    descriptor_ = ::mkostemp(name.data(), O_CLOEXEC);
    if (descriptor_ < 0)
        fail("cannot write");
    temporary_ = name;
}

OutputFile::~OutputFile()
{
    if (descriptor_ < 0)
        return;
    ::close(descriptor_);
    if (!temporary_.empty())
        ::unlink(temporary_.c_str());
}

void OutputFile::commit(std::string_view content)
{
    constexpr mode_t readable_by_all = 0644;
    if (!write_all(descriptor_, content))
        fail("cannot write");
    if (temporary_.empty())
        return;
    if (::fchmod(descriptor_, readable_by_all) != 0 || ::fsync(descriptor_) != 0 ||
        ::rename(temporary_.c_str(), place_.c_str()) != 0)
        fail("cannot write");
    ::close(std::exchange(descriptor_, -1));
    sync_folder(place_.has_parent_path() ? place_.parent_path() : ".");
}

void OutputFile::fail(const char* what) const
{
    const int error = errno;
    throw std::system_error(error, std::generic_category(), std::string(what) + " " + place_.string());
}

} // namespace slod
