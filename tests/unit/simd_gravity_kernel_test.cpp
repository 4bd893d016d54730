#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/case_rows.hpp"
#include "unit/simd_gravity_support.hpp"

namespace slod::simd {
namespace {

/// The largest error of all instruction sets' sums, in what roundings may make of each; what has no terms is
/// to be 0.
template <class Real>
double largest_error(const Bodies<Real>& targets, const Bodies<Real>& sources, std::ptrdiff_t self)
{
    std::vector<Reference> expected;
    for (std::size_t t = 0; t < targets.count(); ++t)
        expected.push_back(reference(targets, t, sources, self));
    double largest = 0;
    for (const KernelTable* table : runnable_kernels()) {
        const Sums<Real> sums = evaluate(*table, targets, sources, self);
        for (std::size_t t = 0; t < targets.count(); ++t) {
            for (std::size_t c = 0; c < component_count; ++c) {
                const long double error = std::abs(sums[c][t] - expected[t].sum[c]);
                const double share =
                    error == 0 ? 0 : double(error / tolerance<Real>(c, expected[t], sources.count()));
                EXPECT_LE(share, 1) << table->name << ", target " << t << ", " << component_names[c] << ": "
                                    << sums[c][t] << " instead of " << expected[t].sum[c];
                largest = std::max(largest, share);
            }
        }
    }
    return largest;
}

/// The first difference in bits, or nothing.
template <class Real>
std::string difference(const Sums<Real>& a, const Sums<Real>& b)
{
    for (std::size_t c = 0; c < component_count; ++c)
        for (std::size_t t = 0; t < a[c].size(); ++t)
            if (std::memcmp(&a[c][t], &b[c][t], sizeof(Real)) != 0)
                return std::string(component_names[c]) + " of target " + std::to_string(t) + ": " +
                       std::to_string(a[c][t]) + " and " + std::to_string(b[c][t]);
    return {};
}

TYPED_TEST_SUITE(GravityKernel, Precisions, PrecisionNames);

// Every number of sources about the length of the queue of pairs, and every padding.
TYPED_TEST(GravityKernel, N23_SumsWhatTheDefinitionSays)
{
    double largest = 0;
    for (std::size_t target_count = 1; target_count <= 65; ++target_count) {
        const auto targets = random_bodies<TypeParam>(target_count, 2 * target_count);
        for (std::size_t source_count = 0; source_count <= 65; ++source_count) {
            const auto sources = random_bodies<TypeParam>(source_count, 2 * source_count + 1);
            largest = std::max(largest, largest_error(targets, sources, no_self));
            ASSERT_LE(largest, 1) << target_count << " targets, " << source_count << " sources";
        }
    }
    test::expect_at_most("largest error, in that of all its roundings", largest, 1);
}

// The places of targets and sources have nothing to do with each other here, so that leaving out a wrong
// pair, or none, changes the sums.
TYPED_TEST(GravityKernel, LeavesOutTheBodyItselfAtEveryOffset)
{
    const auto targets = random_bodies<TypeParam>(37, 1);
    for (const std::size_t source_count : {1U, 7U, 16U, 43U}) {
        const auto sources = random_bodies<TypeParam>(source_count, 2);
        for (std::ptrdiff_t self = -50; self <= 50; ++self)
            ASSERT_LE(largest_error(targets, sources, self), 1) << source_count << " sources, self " << self;
    }
}

// Softened by e = 2, with powers of two all the way: exact.
TYPED_TEST(GravityKernel, CoincidentBodyPullsNowhereButHasATide)
{
    Bodies<TypeParam> targets, sources;
    targets.add(3, 4, 5, 1, 1);
    sources.add(3, 4, 5, 16, 3);
    for (const KernelTable* table : runnable_kernels()) {
        SCOPED_TRACE(table->name);
        const auto sums = evaluate(*table, targets, sources, no_self);
        for (const std::size_t c : {Ax, Ay, Az, Txy, Txz, Tyz})
            EXPECT_EQ(sums[c][0], 0) << component_names[c];
        for (const std::size_t c : {Txx, Tyy, Tzz})
            EXPECT_EQ(sums[c][0], -2) << component_names[c];
        EXPECT_EQ(sums[Phi][0], -8);
    }
}

TYPED_TEST(GravityKernel, CoincidentBodyWithoutSofteningContributesNothing)
{
    auto targets = random_bodies<TypeParam>(5, 1);
    targets.q.assign(5, 0);
    Bodies<TypeParam> sources, sources_elsewhere;
    for (std::size_t i = 0; i < 5; ++i) {
        sources.add(targets.x[i], targets.y[i], targets.z[i], 1, 0);
        if (i != 2)
            sources_elsewhere.add(targets.x[i], targets.y[i], targets.z[i], 1, 0);
    }
    for (const KernelTable* table : runnable_kernels()) {
        SCOPED_TRACE(table->name);
        const auto all = evaluate(*table, targets, sources, no_self);
        const auto others = evaluate(*table, targets, sources_elsewhere, no_self);
        for (std::size_t c = 0; c < component_count; ++c)
            EXPECT_EQ(all[c][2], others[c][2]) << component_names[c];
    }
}

// Leaving a body out by a mass of zero would not do: zero times the inverse of its distance is no number.
TYPED_TEST(GravityKernel, OwnBodyWithoutSofteningContributesNothing)
{
    Bodies<TypeParam> bodies;
    bodies.add(1, 2, 3, 1, 0);
    for (const KernelTable* table : runnable_kernels()) {
        const auto sums = evaluate(*table, bodies, bodies, 0);
        for (std::size_t c = 0; c < component_count; ++c)
            EXPECT_EQ(sums[c][0], 0) << table->name << ' ' << component_names[c];
    }
}

// One rounding, of the whole sum to what was there.
TYPED_TEST(GravityKernel, AddsToWhatIsThere)
{
    const auto targets = random_bodies<TypeParam>(20, 1);
    const auto sources = random_bodies<TypeParam>(30, 2);
    const TypeParam start = 1000;
    for (const KernelTable* table : runnable_kernels()) {
        const auto fresh = evaluate(*table, targets, sources, 3);
        const auto added = evaluate(*table, targets, sources, 3, Tide::With, start);
        for (std::size_t c = 0; c < component_count; ++c)
            for (std::size_t t = 0; t < targets.count(); ++t)
                ASSERT_EQ(added[c][t], start + fresh[c][t]) << table->name << ' ' << component_names[c];
    }
}

TYPED_TEST(GravityKernel, AccelerationHasTheSameBitsWithAndWithoutTheTide)
{
    const auto targets = random_bodies<TypeParam>(40, 1);
    const auto sources = random_bodies<TypeParam>(50, 2);
    for (const KernelTable* table : runnable_kernels()) {
        auto with = evaluate(*table, targets, sources, 5, Tide::With);
        const auto without = evaluate(*table, targets, sources, 5, Tide::Without);
        for (std::size_t c = Txx; c <= Tzz; ++c)
            with[c] = without[c];
        EXPECT_EQ(difference(with, without), "") << table->name;
    }
}

// Places from the size of the cube down to a millionth of it, so that sums mix all magnitudes and every
// rounding tells; the padding is compared too.
TYPED_TEST(GravityKernel, N12_HasTheSameBitsOnEveryInstructionSet)
{
    int others = 0;
    for (std::uint64_t seed = 0; seed < 32; ++seed) {
        SCOPED_TRACE(seed);
        auto targets = random_bodies<TypeParam>(1 + 3 * seed, seed);
        auto sources = random_bodies<TypeParam>(5 * seed, seed + 1000);
        for (std::size_t s = 0; s < sources.count(); s += 3) {
            sources.x[s] *= TypeParam(1e-6);
            sources.y[s] *= TypeParam(1e-3);
        }
        const auto self = static_cast<std::ptrdiff_t>(seed) - 10;
        const auto baseline = evaluate(*kernels("baseline"), targets, sources, self);
        for (const KernelTable* table : runnable_kernels()) {
            const std::string found = difference(baseline, evaluate(*table, targets, sources, self));
            EXPECT_EQ(found, "") << table->name;
            others += found.empty() ? 0 : 1;
        }
    }
    test::expect_at_most("lists of sources with other bits", others, 0);
}

} // namespace
} // namespace slod::simd
