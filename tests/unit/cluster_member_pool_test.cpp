#include <map>
#include <vector>

#include <gtest/gtest.h>

#include "cluster/member_pool.hpp"
#include "core/random.hpp"

namespace slod {
namespace {

const MemberPool::Columns everything{.mass = true, .kind = true, .expiry = true};

TEST(MemberPool, SlabsHaveRoomAndWasteAtMostAnEighth)
{
    MemberPool pool(everything);
    for (std::uint32_t rows = 1; rows <= MemberPool::largest_slab; rows += 1 + rows / 7) {
        const Slab slab = pool.allocate(rows);
        EXPECT_GE(slab.capacity, rows);
        EXPECT_LE(slab.capacity, rows + rows / 8) << "rows " << rows;
        pool.retire(slab, 0);
        pool.recycle(1);
    }
    EXPECT_EQ(pool.allocate(MemberPool::largest_slab).capacity, MemberPool::largest_slab);
}

TEST(MemberPool, ASlabLiesWithinOneChunk)
{
    MemberPool pool({});
    for (int i = 0; i < 40; ++i) {
        const Slab slab = pool.allocate(100'000);
        EXPECT_EQ(slab.first / MemberPool::chunk_rows,
                  (slab.first + slab.capacity - 1) / MemberPool::chunk_rows);
        pool.ids(slab)[0] = pool.ids(slab)[slab.capacity - 1] = 1; // there, as the sanitizers see
    }
}

/// Every row of a slab says whose it is.
void sign(MemberPool& pool, const Slab& slab, std::uint64_t owner)
{
    for (std::uint32_t row = 0; row < slab.capacity; ++row) {
        pool.offsets(slab)[row].position = Vector3f::Constant(float(owner));
        pool.ids(slab)[row] = owner;
        pool.masses(slab)[row] = float(owner);
        pool.kinds(slab)[row] = std::uint8_t(owner);
        pool.expiries(slab)[row] = std::uint32_t(owner);
    }
}

bool signed_by(const MemberPool& pool, const Slab& slab, std::uint64_t owner)
{
    for (std::uint32_t row = 0; row < slab.capacity; ++row)
        if (pool.offsets(slab)[row].position.z() != float(owner) || pool.ids(slab)[row] != owner ||
            pool.masses(slab)[row] != float(owner) || pool.kinds(slab)[row] != std::uint8_t(owner) ||
            pool.expiries(slab)[row] != std::uint32_t(owner))
            return false;
    return true;
}

// Random slabs come and go over frames. Rows of slabs in use, and of slabs retired since the last frame,
// stay as their owner wrote them.
TEST(MemberPool, RowsInUseNeverOverlap)
{
    MemberPool pool(everything);
    Random random(1, 0, 0);
    std::map<std::uint64_t, Slab> in_use, retired;
    std::uint64_t owner = 0;
    for (std::uint64_t frame = 1; frame <= 60; ++frame) {
        pool.recycle(frame);
        retired.clear();
        for (int i = 0; i < 60; ++i) {
            const Slab slab = pool.allocate(1 + random.bits() % (i == 0 ? 5000 : 80));
            sign(pool, slab, ++owner);
            in_use[owner] = slab;
        }
        while (in_use.size() > 200) {
            const auto gone = std::next(in_use.begin(), random.bits() % 200);
            pool.retire(gone->second, frame);
            retired.insert(*gone);
            in_use.erase(gone);
        }
        for (const auto& slabs : {in_use, retired})
            for (const auto& [name, slab] : slabs)
                ASSERT_TRUE(signed_by(pool, slab, name)) << "frame " << frame << " owner " << name;
    }
}

TEST(MemberPool, ARetiredSlabComesBackOnlyAfterItsFrame)
{
    MemberPool pool({});
    const Slab slab = pool.allocate(40);
    pool.retire(slab, 7);
    pool.recycle(7);
    EXPECT_NE(pool.allocate(40).first, slab.first);
    pool.recycle(8);
    EXPECT_EQ(pool.allocate(40).first, slab.first);
}

TEST(MemberPool, MemoryDoesNotGrowWhileAsMuchIsRetiredAsTaken)
{
    MemberPool pool({});
    std::uint32_t highest = 0;
    for (std::uint64_t frame = 1; frame <= 1000; ++frame) {
        pool.recycle(frame);
        for (std::uint32_t rows = 1; rows <= 64; rows += 7) {
            const Slab slab = pool.allocate(rows);
            highest = std::max(highest, slab.first + slab.capacity);
            pool.retire(slab, frame);
        }
    }
    EXPECT_LE(highest, 1000U);
}

TEST(MemberPool, AbsentColumnsAreNull)
{
    MemberPool pool({.mass = false, .kind = true, .expiry = false});
    const Slab slab = pool.allocate(3);
    EXPECT_EQ(pool.masses(slab), nullptr);
    EXPECT_NE(pool.kinds(slab), nullptr);
    EXPECT_EQ(pool.expiries(slab), nullptr);
}

TEST(MemberPool, RowsStayInPlaceWhileThePoolGrows)
{
    MemberPool pool({});
    const Slab slab = pool.allocate(5);
    const std::uint64_t* ids = pool.ids(slab);
    for (int i = 0; i < 4; ++i)
        pool.allocate(MemberPool::largest_slab);
    EXPECT_EQ(pool.ids(slab), ids);
}

} // namespace
} // namespace slod
