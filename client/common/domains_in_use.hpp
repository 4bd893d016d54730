#pragma once

#include <cstdint>
#include <istream>
#include <set>

namespace slod::client {

/// DDS domains that programs on this machine take part in, by their open UDP ports (DDSI-RTPS 2.3, section
/// 9.6.1.1: 7410 + 250 domain + 2 participant for discovery, the next one for data). Empty where /proc does
/// not tell.
std::set<std::uint32_t> domains_in_use();

/// The same from the text of /proc/net/udp.
std::set<std::uint32_t> domains_in_use(std::istream& sockets);

} // namespace slod::client
