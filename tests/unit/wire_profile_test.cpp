#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "idl/profile.hpp"

namespace slod::wire {
namespace {

/// Sets CYCLONEDDS_URI and puts back what it was.
class UserConfiguration {
public:
    explicit UserConfiguration(const char* value)
    {
        if (const char* now = std::getenv(name))
            before_ = now;
        setenv(name, value, 1);
    }
    ~UserConfiguration() { setenv(name, before_.c_str(), 1); }
    UserConfiguration(const UserConfiguration&) = delete;
    UserConfiguration& operator=(const UserConfiguration&) = delete;

private:
    static constexpr const char* name = "CYCLONEDDS_URI";
    std::string before_;
};

TEST(WireProfile, LoopbackNamesNoOtherInterfaceAndNoMulticast)
{
    const std::string_view xml = built_in_configuration(Profile::Loopback);
    EXPECT_NE(xml.find("<NetworkInterface name=\"lo\""), std::string_view::npos);
    EXPECT_NE(xml.find("<AllowMulticast>false<"), std::string_view::npos);
    EXPECT_EQ(xml.find("<NetworkInterface"), xml.rfind("<NetworkInterface"));
}

TEST(WireProfile, TheTwoProfilesDiffer)
{
    EXPECT_NE(built_in_configuration(Profile::Loopback), built_in_configuration(Profile::Lan));
}

TEST(WireProfile, AUsersConfigurationReplacesTheProfileAndTheLogSaysSo)
{
    const UserConfiguration user("file:///etc/mine.xml");
    EXPECT_EQ(configuration(Profile::Loopback), "file:///etc/mine.xml");
    EXPECT_NE(configuration_source(Profile::Loopback).find("CYCLONEDDS_URI"), std::string::npos);
}

TEST(WireProfile, AnEmptyUsersConfigurationIsNone)
{
    const UserConfiguration user("");
    EXPECT_EQ(configuration(Profile::Lan), built_in_configuration(Profile::Lan));
}

TEST(WireProfile, ASampleThatFitsTheBufferNeedsNoWarning)
{
    EXPECT_FALSE(receive_buffer_warning(1000, 1000).has_value());
}

TEST(WireProfile, ASampleThatDoesNotFitIsWarnedOfWithTheRemedy)
{
    // Twice 5 MiB, and up to the next power of two: 16 MiB.
    const auto warning = receive_buffer_warning(5U << 20, 212'992);
    ASSERT_TRUE(warning.has_value());
    EXPECT_NE(warning->find("sysctl -w net.core.rmem_max=16777216"), std::string::npos) << *warning;
}

} // namespace
} // namespace slod::wire
