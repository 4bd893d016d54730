#pragma once

#include <cstdint>
#include <istream>
#include <map>

namespace slod::client {

/// How many participants each DDS domain has on this machine, by their open UDP ports (DDSI-RTPS 2.3, section
/// 9.6.1.1: 7410 + 250 domain + 2 participant for discovery, the next one for data): this program's too, and
/// those that stand still. Empty where /proc does not tell.
std::map<std::uint32_t, std::uint32_t> domains_in_use();

/// The same from the text of /proc/net/udp.
std::map<std::uint32_t, std::uint32_t> domains_in_use(std::istream& sockets);

} // namespace slod::client
