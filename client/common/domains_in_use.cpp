#include "common/domains_in_use.hpp"

#include <charconv>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include "idl/profile.hpp"

namespace slod::client {

namespace {

constexpr std::uint32_t port_base = 7400;
constexpr std::uint32_t ports_per_domain = 250;
constexpr std::uint32_t first_unicast = 10; ///< of a domain's ports

} // namespace

std::map<std::uint32_t, std::uint32_t> domains_in_use()
{
    std::ifstream sockets("/proc/net/udp");
    return domains_in_use(sockets);
}

std::map<std::uint32_t, std::uint32_t> domains_in_use(std::istream& sockets)
{
    std::set<std::uint32_t> ports;
    std::string line;
    std::getline(sockets, line); // the headings
    while (std::getline(sockets, line)) {
        std::string row, local;
        std::istringstream(line) >> row >> local; // "0100007F:1CE8"
        const std::size_t colon = local.find(':');
        std::uint32_t port = 0;
        if (colon != std::string::npos)
            std::from_chars(local.data() + colon + 1, local.data() + local.size(), port, 16);
        ports.insert(port);
    }
    std::map<std::uint32_t, std::uint32_t> participants;
    for (const std::uint32_t port : ports) {
        if (port < port_base)
            continue;
        const std::uint32_t domain = (port - port_base) / ports_per_domain;
        const std::uint32_t place = (port - port_base) % ports_per_domain;
        const bool discovery = place >= first_unicast && place % 2 == 0;
        if (domain <= wire::last_domain && discovery && ports.contains(port + 1))
            ++participants[domain];
    }
    return participants;
}

} // namespace slod::client
