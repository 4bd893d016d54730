#include "idl/profile.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <fstream>

namespace slod::wire {

namespace {

constexpr const char* user_configuration = "CYCLONEDDS_URI";

std::string_view from_user()
{
    const char* uri = std::getenv(user_configuration);
    return uri ? std::string_view(uri) : std::string_view();
}

std::string mebibytes(std::uint64_t bytes)
{
    constexpr std::uint64_t tenth_of_mebibyte = (1U << 20) / 10;
    const std::uint64_t tenths = bytes / tenth_of_mebibyte;
    return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " MiB";
}

} // namespace

std::string configuration(Profile profile)
{
    return std::string(from_user().empty() ? built_in_configuration(profile) : from_user());
}

std::string configuration_source(Profile profile)
{
    if (from_user().empty())
        return "profile " + std::string(names(profile)[std::size_t(profile)]);
    return std::string(user_configuration) + " instead of a profile";
}

std::optional<std::uint64_t> receive_buffer_limit()
{
    std::ifstream file("/proc/sys/net/core/rmem_max");
    std::uint64_t bytes = 0;
    if (file >> bytes)
        return bytes;
    return std::nullopt;
}

std::optional<std::string> receive_buffer_warning(std::uint64_t sample_bytes, std::uint64_t limit_bytes)
{
    if (sample_bytes <= limit_bytes)
        return std::nullopt;
    constexpr std::uint64_t smallest_advice = 4U << 20;
    const std::uint64_t advice = std::bit_ceil(std::max(2 * sample_bytes, smallest_advice));
    return "samples of " + mebibytes(sample_bytes) + " do not fit the socket receive buffer of " +
           mebibytes(limit_bytes) + ", so that frames will be lost; on every machine with clients run: " +
           "sudo sysctl -w net.core.rmem_max=" + std::to_string(advice) + ", and restart the clients";
}

std::optional<std::string> receive_buffer_warning(std::uint64_t sample_bytes)
{
    const std::optional<std::uint64_t> limit = receive_buffer_limit();
    return limit ? receive_buffer_warning(sample_bytes, *limit) : std::nullopt;
}

} // namespace slod::wire
