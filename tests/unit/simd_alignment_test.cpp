#include <algorithm>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "support/case_rows.hpp"
#include "unit/simd_gravity_support.hpp"

// Where arrays begin in memory, and which lane a target is in, is nothing to its sums.
namespace slod::simd {
namespace {

constexpr std::size_t alignment = 64; ///< bytes, of the widest register

/// Copies of arrays, each beginning a number of elements of its own behind a multiple of `alignment`.
template <class Real>
class Shifted {
public:
    explicit Shifted(std::size_t shift) : shift_(shift) {}

    Real* copy(const std::vector<Real>& from)
    {
        constexpr std::size_t lanes = alignment / sizeof(Real);
        std::vector<Real>& room = rooms_.emplace_back(from.size() + 2 * lanes);
        const auto address = reinterpret_cast<std::uintptr_t>(room.data());
        const std::size_t aligned = (alignment - address % alignment) % alignment / sizeof(Real);
        Real* const begin = room.data() + aligned + (shift_ * rooms_.size()) % lanes;
        std::copy(from.begin(), from.end(), begin);
        return begin;
    }

private:
    std::size_t shift_;
    std::vector<std::vector<Real>> rooms_;
};

/// As evaluate(), but every array is shifted.
template <class Real>
Sums<Real> evaluate_shifted(const KernelTable& table, const Bodies<Real>& targets,
                            const Bodies<Real>& sources, std::size_t shift)
{
    const Bodies<Real> at = targets.padded();
    Shifted<Real> memory(shift);
    Real *const x = memory.copy(at.x), *const y = memory.copy(at.y), *const z = memory.copy(at.z),
                *const q = memory.copy(at.q);
    std::array<Real*, component_count> sum{};
    for (Real*& component : sum)
        component = memory.copy(std::vector<Real>(at.count(), 0));
    const GravitySources<Real> from{sources.count(),           memory.copy(sources.x),
                                    memory.copy(sources.y),    memory.copy(sources.z),
                                    memory.copy(sources.mass), memory.copy(sources.q)};
    const GravityKernels<Real>& kernels = gravity_kernels<Real>(table);
    kernels.add_acceleration_and_tide({at.count(), x, y, z, q, sum[Ax], sum[Ay], sum[Az], sum[Txx], sum[Txy],
                                       sum[Txz], sum[Tyy], sum[Tyz], sum[Tzz]},
                                      from, no_self);
    kernels.add_potential({at.count(), x, y, z, q, sum[Phi]}, from, no_self);
    Sums<Real> result;
    for (std::size_t c = 0; c < component_count; ++c)
        result[c].assign(sum[c], sum[c] + at.count());
    return result;
}

/// Sums whose bits differ, target i of `a` being order[i] of `b`.
template <class Real>
std::size_t differing(const Sums<Real>& a, const Sums<Real>& b, const std::vector<std::size_t>& order)
{
    std::size_t count = 0;
    for (std::size_t c = 0; c < component_count; ++c)
        for (std::size_t t = 0; t < order.size(); ++t)
            count += std::memcmp(&a[c][t], &b[c][order[t]], sizeof(Real)) == 0 ? 0 : 1;
    return count;
}

template <class Real>
class GravityKernelArrays : public testing::Test {};

TYPED_TEST_SUITE(GravityKernelArrays, Precisions, PrecisionNames);

TYPED_TEST(GravityKernelArrays, N24_MayBeginAnywhere)
{
    const auto targets = random_bodies<TypeParam>(37, 1);
    const auto sources = random_bodies<TypeParam>(43, 2);
    std::vector<std::size_t> same(targets.count());
    std::iota(same.begin(), same.end(), std::size_t{0});
    for (const KernelTable* table : runnable_kernels()) {
        const auto expected = evaluate(*table, targets, sources, no_self);
        for (std::size_t shift = 0; shift < alignment / sizeof(TypeParam); ++shift)
            test::expect_at_most(
                "sums with other bits",
                double(differing(evaluate_shifted(*table, targets, sources, shift), expected, same)), 0);
    }
}

TYPED_TEST(GravityKernelArrays, N24_MayHaveTheirTargetsInAnyOrder)
{
    const auto targets = random_bodies<TypeParam>(48, 3);
    const auto sources = random_bodies<TypeParam>(43, 4);
    for (const KernelTable* table : runnable_kernels()) {
        const auto expected = evaluate(*table, targets, sources, no_self);
        for (const std::size_t stride : {5U, 7U, 11U, 13U, 47U}) { // none divides 48
            std::vector<std::size_t> order;
            Bodies<TypeParam> other;
            for (std::size_t t = 0; t < targets.count(); ++t) {
                const std::size_t i = (t * stride + 1) % targets.count();
                order.push_back(i);
                other.add(targets.x[i], targets.y[i], targets.z[i], targets.mass[i], targets.q[i]);
            }
            test::expect_at_most(
                "sums with other bits",
                double(differing(evaluate(*table, other, sources, no_self), expected, order)), 0);
        }
    }
}

} // namespace
} // namespace slod::simd
