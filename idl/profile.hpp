#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace slod::wire {

/// Where the wire reaches: this machine, or the local network.
enum class Profile : std::uint8_t { Loopback, Lan };

constexpr std::array<std::string_view, 2> names(Profile)
{
    return {"loopback", "lan"};
}

/// The highest DDS domain: those beyond have no UDP ports (DDSI-RTPS 2.3, section 9.6.1.1).
inline constexpr std::uint32_t last_domain = 230;

/// Cyclone DDS's configuration for the profile: the text of config/dds/<profile>.xml, compiled in.
std::string_view built_in_configuration(Profile profile);

/// What a participant is configured with: the environment's CYCLONEDDS_URI alone when it is set and not
/// empty, as in any program that uses Cyclone DDS, otherwise the profile.
std::string configuration(Profile profile);

/// For logs and messages: where configuration(profile) comes from.
std::string configuration_source(Profile profile);

/// Largest receive buffer that the kernel grants a socket [bytes]; empty when it does not say.
std::optional<std::uint64_t> receive_buffer_limit();

/// The warning to show when samples of `sample_bytes` cannot arrive reliably through receive buffers of
/// `limit_bytes`, with its remedy; empty when one sample fits. A fragment that does not fit is lost, and the
/// next frame replaces the sample before it can be sent again.
std::optional<std::string> receive_buffer_warning(std::uint64_t sample_bytes, std::uint64_t limit_bytes);

/// The same against this machine's limit.
std::optional<std::string> receive_buffer_warning(std::uint64_t sample_bytes);

} // namespace slod::wire
