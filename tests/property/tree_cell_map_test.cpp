#include <map>
#include <vector>

#include <gtest/gtest.h>

#include "core/random.hpp"
#include "support/case_rows.hpp"
#include "tree/cell_map.hpp"

namespace slod {
namespace {

constexpr int seeds = 64;

Cell random_cell(Random& random, std::uint32_t reach)
{
    const auto coordinate = [&] { return std::int32_t(random.bits() % (2 * reach)) - std::int32_t(reach); };
    const std::int32_t x = coordinate();
    const std::int32_t y = coordinate();
    return {x, y, coordinate()};
}

void expect_same(const CellMap& found, const std::map<Cell, NodeId>& expected)
{
    ASSERT_EQ(found.size(), expected.size());
    std::map<Cell, NodeId> visited;
    found.for_each([&](const Cell& cell, NodeId root) { visited[cell] = root; });
    ASSERT_EQ(visited, expected);
    for (const auto& [cell, root] : expected)
        ASSERT_EQ(found.find(cell), root);
}

// Few different cells in a table that is up to half full: probes run into one another, and erasing has to
// close gaps in them. What is not there is asked for as well.
TEST(CellMap, AgreesWithAnOrderedMapUnderRandomOperations)
{
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed, 0, 0);
        CellMap cells;
        std::map<Cell, NodeId> reference;
        const std::uint32_t reach = 1 + random.bits() % 6;
        for (std::uint32_t step = 0; step < 2000; ++step) {
            const Cell cell = random_cell(random, reach);
            const auto known = reference.find(cell);
            ASSERT_EQ(cells.find(cell), known == reference.end() ? NodeId{} : known->second);
            if (known == reference.end()) {
                cells.insert(cell, NodeId{step});
                reference[cell] = NodeId{step};
            } else if (random.bits() % 4 != 0) {
                cells.erase(cell);
                reference.erase(known);
            }
            if (step % 250 == 0)
                expect_same(cells, reference);
        }
        expect_same(cells, reference);
        while (!reference.empty()) {
            cells.erase(reference.begin()->first);
            reference.erase(reference.begin());
            if (reference.size() % 16 == 0)
                expect_same(cells, reference);
        }
    }
}

TEST(CellMap, N18_HoldsCellsAtTheRimOfTheGrid)
{
    CellMap cells;
    constexpr std::int32_t rim = 1 << 30;
    std::uint32_t node = 0;
    std::vector<Cell> corners;
    for (const std::int32_t x : {-rim, -1, 0, rim})
        for (const std::int32_t y : {-rim, -1, 0, rim})
            for (const std::int32_t z : {-rim, -1, 0, rim})
                corners.push_back({x, y, z});
    for (const Cell& corner : corners)
        cells.insert(corner, NodeId{node++});
    std::uint32_t found = 0;
    for (std::uint32_t i = 0; i < node; ++i)
        found += cells.find(corners[i]) == NodeId{i} ? 1 : 0;
    test::expect_at_least("cells found again", found, node);
}

} // namespace
} // namespace slod
