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

void divide_all(std::vector<DivisionKey>& keys, std::uint32_t parts)
{
    std::vector<DivisionKey> spare(keys.size());
    divide(keys, spare, parts);
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
    divide_all(keys, 37);
    std::vector<std::uint32_t> found = indices(keys);
    std::sort(found.begin(), found.end());
    for (std::uint32_t i = 0; i < 1000; ++i)
        EXPECT_EQ(found[i], i);
}

// Across the longest side first: in a column of 1 x 1 x 10 every part of 4 is a slice of it.
TEST(Divide, SplitsAcrossTheLongestSide)
{
    std::vector<DivisionKey> keys = random_keys(1000, 2);
    divide_all(keys, 4);
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
    divide_all(keys, 11);
    divide_all(reversed, 11);
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
    divide_all(keys, 4);
    for (std::uint32_t i = 0; i < 64; ++i)
        EXPECT_EQ(keys[i].index / 16, i / 16);
}

/// Of the keys along the axis across which they are split, as a sort has them.
std::set<std::uint32_t> lower_half(std::vector<DivisionKey> keys, std::size_t axis)
{
    std::sort(keys.begin(), keys.end(), [axis](const DivisionKey& a, const DivisionKey& b) {
        return a.x[axis] != b.x[axis] ? a.x[axis] < b.x[axis] : a.index < b.index;
    });
    const std::vector<std::uint32_t> order = indices(keys);
    return {order.begin(), order.begin() + std::ptrdiff_t(order.size() / 2)};
}

// Uniform places, most of them in one place, in two, on both sides of 0, and with one so far out that all
// others are near each other beside it.
TEST(Divide, HalvesAsASortDoesAndKeepsTheOrderOfEachHalf)
{
    for (std::uint32_t kind = 0; kind < 5; ++kind) {
        std::vector<DivisionKey> keys = random_keys(3000, kind);
        for (DivisionKey& key : keys) {
            float& height = key.x[2];
            if (kind == 1)
                height = height < 9 ? 3 : height;
            else if (kind == 2)
                height = height < 7 ? -0.0F : 5;
            else if (kind == 3)
                height -= 5;
            else if (kind == 4 && key.index == 7)
                height = 1e30F;
        }
        const std::set<std::uint32_t> expected = lower_half(keys, 2);
        divide_all(keys, 2);
        const std::vector<std::uint32_t> found = indices(keys);
        const auto middle = found.begin() + std::ptrdiff_t(part_begin(3000, 2, 1));
        EXPECT_EQ(std::set<std::uint32_t>(found.begin(), middle), expected) << "kind " << kind;
        EXPECT_TRUE(std::is_sorted(found.begin(), middle)) << "kind " << kind;
        EXPECT_TRUE(std::is_sorted(middle, found.end())) << "kind " << kind;
    }
}

} // namespace
} // namespace slod
