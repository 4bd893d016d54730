#include <array>
#include <cstddef>

#include <gtest/gtest.h>

#include "simd/kernels.hpp"

namespace slod::simd {
namespace {

TEST(KernelTables, AreFoundByTheirNamesSlowestFirst)
{
    const std::array names = {"baseline", "v3", "v4"};
    const auto runnable = runnable_kernels();
    ASSERT_LE(runnable.size(), names.size());
    for (std::size_t i = 0; i < runnable.size(); ++i) {
        EXPECT_STREQ(runnable[i]->name, names[i]);
        EXPECT_EQ(kernels(names[i]), runnable[i]) << names[i];
    }
}

TEST(KernelTables, AutoMeansTheFastest)
{
    EXPECT_EQ(&kernels(), runnable_kernels().back());
    EXPECT_EQ(kernels("auto"), &kernels());
    EXPECT_EQ(kernels(""), &kernels());
}

TEST(KernelTables, UnknownNameFindsNone)
{
    for (const char* name : {"v5", "V3", "base", "avx2"})
        EXPECT_EQ(kernels(name), nullptr) << name;
}

} // namespace
} // namespace slod::simd
