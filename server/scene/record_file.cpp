#include "scene/record_file.hpp"

#include <bit>

namespace slod {

namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::uint64_t marker_bytes = sizeof(std::uint32_t);

} // namespace

RecordFile::RecordFile(const std::filesystem::path& file)
{
    std::error_code error;
    const auto status = std::filesystem::status(file, error);
    if (status.type() == std::filesystem::file_type::not_found)
        throw UnusableFile("there is no such file; check its name.");
    if (status.type() == std::filesystem::file_type::directory)
        throw UnusableFile("this is a folder; name a file in it.");
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
        throw UnusableFile(
            "this is a pipe or a device; name a regular file."); // opening a pipe may last for ever
    size_ = std::filesystem::file_size(file, error);
    stream_.open(file, std::ios::binary);
    if (error || !stream_)
        throw UnusableFile("the file cannot be read; check its permissions.");
}

std::uint32_t RecordFile::next_length(const std::string& block, std::uint64_t expected)
{
    if (size_ - position_ < marker_bytes)
        throw UnusableFile("truncated before the " + block +
                           " block: " + std::to_string(expected + 2 * marker_bytes) + " bytes expected, " +
                           std::to_string(size_ - position_) + " found; get the whole file.");
    std::uint32_t length = 0;
    read_bytes(&length, sizeof length);
    stream_.seekg(-std::streamoff(sizeof length), std::ios::cur);
    position_ -= sizeof length;
    return length;
}

void RecordFile::check_next(const std::string& block, std::uint64_t expected)
{
    const std::uint64_t length = next_length(block, expected);
    if (length != expected)
        throw UnusableFile(
            "the " + block + " block is said to have " + std::to_string(length) + " bytes where " +
            std::to_string(expected) +
            " are expected; write the file in SnapFormat 1 with the blocks POS, VEL, ID and MASS in "
            "single precision.");
    if (size_ - position_ < expected + 2 * marker_bytes)
        throw UnusableFile("truncated in the " + block +
                           " block: " + std::to_string(expected + 2 * marker_bytes) + " bytes expected, " +
                           std::to_string(size_ - position_) + " found; get the whole file.");
}

void RecordFile::read_next(const std::string& block, void* memory, std::size_t bytes)
{
    std::uint32_t opening = 0, closing = 0;
    read_bytes(&opening, sizeof opening);
    read_bytes(memory, bytes);
    read_bytes(&closing, sizeof closing);
    if (opening != closing)
        throw UnusableFile("the record markers around the " + block + " block disagree, " +
                           std::to_string(opening) + " before and " + std::to_string(closing) +
                           " after it; the file is damaged, get it anew.");
}

void RecordFile::read_bytes(void* memory, std::size_t bytes)
{
    if (!stream_.read(static_cast<char*>(memory), std::streamsize(bytes)))
        throw UnusableFile("reading failed at byte " + std::to_string(position_) + "; check the disk.");
    position_ += bytes;
}

} // namespace slod
