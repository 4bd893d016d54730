#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "common/domains_in_use.hpp"

namespace slod::client {
namespace {

// Ports 7410 and 7411 of domain 0, 7660 and 7663 of domain 1 (which are no pair), 26910 to 26913 of domain
// 78, and of nothing 5353 and 47594.
TEST(WireDomains, AreReadFromTheOpenPorts)
{
    std::istringstream sockets("   sl  local_address rem_address   st tx_queue rx_queue\n"
                               "  1: 00000000:1CF2 00000000:0000 07\n"
                               "  2: 00000000:1CF3 00000000:0000 07\n"
                               "  3: 00000000:1DEC 00000000:0000 07\n"
                               "  4: 00000000:1DEF 00000000:0000 07\n"
                               " 17: 0100007F:691E 00000000:0000 07\n"
                               " 18: 0100007F:691F 00000000:0000 07\n"
                               " 19: 0100007F:6920 00000000:0000 07\n"
                               " 20: 0100007F:6921 00000000:0000 07\n"
                               "  5: 00000000:14E9 00000000:0000 07\n"
                               "  6: 0100007F:B9EA 00000000:0000 07\n"
                               "what is this\n");
    EXPECT_EQ(domains_in_use(sockets), (std::map<std::uint32_t, std::uint32_t>{{0, 1}, {78, 2}}));
}

TEST(WireDomains, AreNoneWhereNothingIsKnown)
{
    std::istringstream nothing;
    EXPECT_TRUE(domains_in_use(nothing).empty());
}

} // namespace
} // namespace slod::client
