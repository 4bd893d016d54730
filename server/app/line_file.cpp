#include "app/line_file.hpp"

#include <cerrno>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace slod {

LineFile::LineFile(std::filesystem::path place)
    : place_(std::move(place)), file_(std::fopen(place_.c_str(), "we"))
{
    check(file_ != nullptr);
}

void LineFile::add(const std::string& line)
{
    check(std::fputs((line + '\n').c_str(), file_.get()) >= 0);
}

void LineFile::flush()
{
    check(std::fflush(file_.get()) == 0);
}

void LineFile::sync()
{
    flush();
    check(::fsync(fileno(file_.get())) == 0);
}

void LineFile::check(bool done) const
{
    if (!done)
        throw std::system_error(errno, std::generic_category(), "cannot write " + place_.string());
}

} // namespace slod
