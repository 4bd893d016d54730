#include <algorithm>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "core/random.hpp"
#include "tree/divide.hpp"

namespace slod {
namespace {

std::vector<DivisionKey> random_keys(std::uint32_t count, std::uint64_t seed)
{
    std::vector<DivisionKey> keys(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        Random random(seed, 0, i);
        keys[i] = {{float(random.uniform()), float(random.uniform()), float(10 * random.uniform())}, i};
    }
    return keys;
}

std::vector<std::uint32_t> indices(const std::vector<DivisionKey>& keys)
{
    std::vector<std::uint32_t> result;
    for (const DivisionKey& key : keys)
        result.push_back(key.index);
    return result;
}

TEST(Divide, PartsAreBalancedAndNoneIsAboveItsShareRoundedUp)
{
    for (std::uint32_t count = 1; count < 200; ++count) {
        for (std::uint32_t parts = 1; parts <= count; ++parts) {
            EXPECT_EQ(part_begin(count, parts, 0), 0U);
            for (std::uint32_t part = 0; part < parts; ++part) {
                const std::uint32_t begin = part_begin(count, parts, part);
                const std::uint32_t end = part + 1 == parts ? count : part_begin(count, parts, part + 1);
                ASSERT_GT(end, begin) << count << " in " << parts;
                ASSERT_LE(end - begin, (count + parts - 1) / parts) << count << " in " << parts;
            }
        }
    }
}

TEST(Divide, KeepsEveryKeyOnce)
{
    std::vector<DivisionKey> keys = random_keys(1000, 1);
    divide(keys, 37);
    std::vector<std::uint32_t> found = indices(keys);
    std::sort(found.begin(), found.end());
    for (std::uint32_t i = 0; i < 1000; ++i)
        EXPECT_EQ(found[i], i);
}

// Across the longest side first: in a column of 1 x 1 x 10 every part of 4 is a slice of it.
TEST(Divide, SplitsAcrossTheLongestSide)
{
    std::vector<DivisionKey> keys = random_keys(1000, 2);
    divide(keys, 4);
    float below = -1;
    for (std::uint32_t part = 0; part < 4; ++part) {
        const auto begin = keys.begin() + part_begin(1000, 4, part);
        const auto end = begin + 250;
        const auto by_height = [](const DivisionKey& a, const DivisionKey& b) { return a.x[2] < b.x[2]; };
        EXPECT_LT(below, std::min_element(begin, end, by_height)->x[2]) << "part " << part;
        below = std::max_element(begin, end, by_height)->x[2];
    }
}

TEST(Divide, DependsOnThePlacesAndIndicesOnlyNotOnTheirOrder)
{
    std::vector<DivisionKey> keys = random_keys(500, 3);
    std::vector<DivisionKey> reversed(keys.rbegin(), keys.rend());
    divide(keys, 11);
    divide(reversed, 11);
    for (std::uint32_t part = 0; part < 11; ++part) {
        const auto members = [part](const std::vector<DivisionKey>& from) {
            const std::uint32_t end = part == 10 ? 500 : part_begin(500, 11, part + 1);
            const std::vector<std::uint32_t> all = indices(from);
            return std::set<std::uint32_t>(all.begin() + part_begin(500, 11, part), all.begin() + end);
        };
        EXPECT_EQ(members(keys), members(reversed)) << "part " << part;
    }
}

TEST(Divide, CoincidentPointsAreDividedByIndex)
{
    std::vector<DivisionKey> keys(64);
    for (std::uint32_t i = 0; i < 64; ++i)
        keys[i] = {{1, 2, 3}, 63 - i};
    divide(keys, 4);
    for (std::uint32_t i = 0; i < 64; ++i)
        EXPECT_EQ(keys[i].index / 16, i / 16);
}

} // namespace
} // namespace slod
