#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "simd/kernels.hpp"

namespace slod::simd {
namespace {

enum Component : std::size_t { Ax, Ay, Az, Txx, Txy, Txz, Tyy, Tyz, Tzz, Phi, component_count };

constexpr std::array component_names = {"ax",  "ay",  "az",  "txx", "txy",
                                        "txz", "tyy", "tyz", "tzz", "potential"};

template <class Real>
struct Bodies {
    std::vector<Real> x, y, z, mass, q;

    std::size_t count() const { return x.size(); }

    void add(Real x_, Real y_, Real z_, Real mass_, Real q_)
    {
        x.push_back(x_);
        y.push_back(y_);
        z.push_back(z_);
        mass.push_back(mass_);
        q.push_back(q_);
    }

    GravitySources<Real> sources() const
    {
        return {count(), x.data(), y.data(), z.data(), mass.data(), q.data()};
    }

    Bodies padded() const
    {
        Bodies result = *this;
        while (result.count() % tile_width != 0)
            result.add(0, 0, 0, 0, 0);
        return result;
    }
};

/// Bodies in the cube [-1, 1), of mass 1/2 to 3/2; one in four is not softened.
template <class Real>
Bodies<Real> random_bodies(std::size_t count, std::uint64_t seed)
{
    std::mt19937_64 bits(seed);
    const auto uniform = [&] { return static_cast<Real>(static_cast<double>(bits() >> 40) * 0x1p-24); };
    Bodies<Real> bodies;
    for (std::size_t i = 0; i < count; ++i) {
        const Real x = 2 * uniform() - 1;
        const Real y = 2 * uniform() - 1;
        const Real z = 2 * uniform() - 1;
        const Real q = Real(0.01) * uniform();
        bodies.add(x, y, z, uniform() + Real(0.5), i % 4 == 3 ? 0 : q);
    }
    return bodies;
}

/// By component, then by target with the padding.
template <class Real>
using Sums = std::array<std::vector<Real>, component_count>;

enum class Tide { With, Without };

/// What the kernels make of arrays that held `start`. Fails when they write behind the last target.
template <class Real>
Sums<Real> evaluate(const KernelTable& table, const Bodies<Real>& targets, const Bodies<Real>& sources,
                    std::ptrdiff_t self, Tide tide = Tide::With, Real start = 0)
{
    const Bodies<Real> at = targets.padded();
    constexpr Real guard = 77;
    Sums<Real> sums;
    for (std::vector<Real>& sum : sums) {
        sum.assign(at.count(), start);
        sum.push_back(guard);
    }
    GravityTargets<Real> pulled{at.count(),       at.x.data(),      at.y.data(),      at.z.data(),
                                at.q.data(),      sums[Ax].data(),  sums[Ay].data(),  sums[Az].data(),
                                sums[Txx].data(), sums[Txy].data(), sums[Txz].data(), sums[Tyy].data(),
                                sums[Tyz].data(), sums[Tzz].data()};
    const GravityKernels<Real>& kernels = gravity_kernels<Real>(table);
    if (tide == Tide::With) {
        kernels.add_acceleration_and_tide(pulled, sources.sources(), self);
    } else {
        pulled.txx = pulled.txy = pulled.txz = pulled.tyy = pulled.tyz = pulled.tzz = nullptr;
        kernels.add_acceleration(pulled, sources.sources(), self);
    }
    kernels.add_potential({at.count(), at.x.data(), at.y.data(), at.z.data(), at.q.data(), sums[Phi].data()},
                          sources.sources(), self);
    for (std::vector<Real>& sum : sums) {
        EXPECT_EQ(sum.back(), guard);
        sum.pop_back();
    }
    return sums;
}

/// The definition, in long double: each component's sum, and the sum of its terms' magnitudes.
struct Reference {
    std::array<long double, component_count> sum{};
    std::array<long double, component_count> magnitude{};

    void add(Component component, long double term)
    {
        sum[component] += term;
        magnitude[component] += std::abs(term);
    }
};

template <class Real>
Reference reference(const Bodies<Real>& targets, std::size_t t, const Bodies<Real>& sources,
                    std::ptrdiff_t self)
{
    Reference result;
    for (std::size_t s = 0; s < sources.count(); ++s) {
        if (self != no_self && static_cast<std::ptrdiff_t>(s) == static_cast<std::ptrdiff_t>(t) + self)
            continue;
        const auto exact = [](Real value) { return static_cast<long double>(value); };
        const std::array d = {exact(sources.x[s]) - exact(targets.x[t]),
                              exact(sources.y[s]) - exact(targets.y[t]),
                              exact(sources.z[s]) - exact(targets.z[t])};
        const long double square =
            d[0] * d[0] + d[1] * d[1] + d[2] * d[2] + exact(targets.q[t]) + exact(sources.q[s]);
        if (square == 0)
            continue;
        const long double r = std::sqrt(square);
        const long double pull = exact(sources.mass[s]) / (square * r);
        for (std::size_t i = 0; i < 3; ++i)
            result.add(static_cast<Component>(Ax + i), pull * d[i]);
        std::size_t component = Txx;
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = i; j < 3; ++j) {
                const auto entry = static_cast<Component>(component++);
                result.add(entry, 3 * pull * d[i] * d[j] / square);
                if (i == j)
                    result.add(entry, -pull);
            }
        }
        result.add(Phi, -exact(sources.mass[s]) / r);
    }
    return result;
}

template <class Real>
constexpr Real rounding = std::numeric_limits<Real>::epsilon() / 2;

/// How many roundings a term goes through, to first order, before it is summed; half a step stays spare for
/// the higher orders. d has 1, r^2 at most 2 + 1 + 3, 1 / r^2 7, its root 7/2 + 1, m / r 5.5; m / r^3 5.5 + 7
/// + 1, times d 15.5; d / r^2 9, hence m d d / r^5 25.5, its triple 26.5, less m / r^3 27.5.
double roundings(std::size_t component)
{
    if (component == Phi)
        return 6;
    return component <= Az ? 16 : 28;
}

/// Summing n terms rounds each at most n times more, relative to the terms' magnitudes. The reference's own
/// error is 2^-11 of this in double.
template <class Real>
long double tolerance(std::size_t component, const Reference& expected, std::size_t source_count)
{
    return (roundings(component) + static_cast<double>(source_count)) * rounding<Real> *
           expected.magnitude[component];
}

/// False when a sum of some instruction set is not the definition's.
template <class Real>
bool agree_with_definition(const Bodies<Real>& targets, const Bodies<Real>& sources, std::ptrdiff_t self)
{
    std::vector<Reference> expected;
    for (std::size_t t = 0; t < targets.count(); ++t)
        expected.push_back(reference(targets, t, sources, self));
    for (const KernelTable* table : runnable_kernels()) {
        const Sums<Real> sums = evaluate(*table, targets, sources, self);
        for (std::size_t t = 0; t < targets.count(); ++t) {
            for (std::size_t c = 0; c < component_count; ++c) {
                const long double error = std::abs(sums[c][t] - expected[t].sum[c]);
                if (error <= tolerance<Real>(c, expected[t], sources.count()))
                    continue;
                ADD_FAILURE() << table->name << ", target " << t << ", " << component_names[c] << ": "
                              << sums[c][t] << " instead of " << expected[t].sum[c];
                return false;
            }
        }
    }
    return true;
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

template <class Real>
class GravityKernel : public testing::Test {};

struct PrecisionNames {
    template <class Real>
    static std::string GetName(int)
    {
        return std::is_same_v<Real, float> ? "Float" : "Double";
    }
};

using Precisions = testing::Types<float, double>;
TYPED_TEST_SUITE(GravityKernel, Precisions, PrecisionNames);

// Every number of sources about the length of the queue of pairs, and every padding.
TYPED_TEST(GravityKernel, SumsWhatTheDefinitionSays)
{
    for (std::size_t target_count = 1; target_count <= 65; ++target_count) {
        const auto targets = random_bodies<TypeParam>(target_count, 2 * target_count);
        for (std::size_t source_count = 0; source_count <= 65; ++source_count) {
            const auto sources = random_bodies<TypeParam>(source_count, 2 * source_count + 1);
            ASSERT_TRUE(agree_with_definition(targets, sources, no_self))
                << target_count << " targets, " << source_count << " sources";
        }
    }
}

// The places of targets and sources have nothing to do with each other here, so that leaving out a wrong
// pair, or none, changes the sums.
TYPED_TEST(GravityKernel, LeavesOutTheBodyItselfAtEveryOffset)
{
    const auto targets = random_bodies<TypeParam>(37, 1);
    for (const std::size_t source_count : {1U, 7U, 16U, 43U}) {
        const auto sources = random_bodies<TypeParam>(source_count, 2);
        for (std::ptrdiff_t self = -50; self <= 50; ++self)
            ASSERT_TRUE(agree_with_definition(targets, sources, self))
                << source_count << " sources, self " << self;
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
TYPED_TEST(GravityKernel, HasTheSameBitsOnEveryInstructionSet)
{
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
        for (const KernelTable* table : runnable_kernels())
            ASSERT_EQ(difference(baseline, evaluate(*table, targets, sources, self)), "") << table->name;
    }
}

constexpr double step = 0x1p-13;

/// How far a central difference over 2 steps may be from the tide. Any third derivative of a softened pair's
/// acceleration is at most 4! m / r^5, which makes the truncation at most 4 step^2 sum m / r^5; r is at least
/// 1/2 here, and 1 % covers its change over a step. Both accelerations' rounding is divided by 2 steps.
long double slope_tolerance(const Bodies<double>& targets, std::size_t t, const Bodies<double>& sources,
                            std::size_t acceleration, std::size_t tide)
{
    long double curvature = 0;
    for (std::size_t s = 0; s < sources.count(); ++s) {
        const double distance =
            std::hypot(sources.x[s] - targets.x[t], sources.y[s] - targets.y[t], sources.z[s] - targets.z[t]);
        const double square = distance * distance + sources.q[s] + targets.q[t];
        curvature += sources.mass[s] / (square * square * std::sqrt(square));
    }
    const Reference exact = reference(targets, t, sources, no_self);
    const long double rounded = tolerance<double>(acceleration, exact, sources.count()) / step;
    return 1.01L * (4 * step * step * curvature + rounded) + tolerance<double>(tide, exact, sources.count());
}

// The step and the places are short binary fractions: moving a target rounds nothing.
TEST(GravityTide, IsTheDerivativeOfTheAcceleration)
{
    constexpr std::array<std::array<Component, 3>, 3> entry = {
        {{Txx, Txy, Txz}, {Txy, Tyy, Tyz}, {Txz, Tyz, Tzz}}};
    const auto targets = random_bodies<double>(16, 1);
    auto sources = random_bodies<double>(50, 2);
    for (double& x : sources.x)
        x += x < 0 ? -1.5 : 1.5;
    const auto tide = evaluate(kernels(), targets, sources, no_self);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        auto ahead = targets, behind = targets;
        const auto moved = std::array{&Bodies<double>::x, &Bodies<double>::y, &Bodies<double>::z}[axis];
        for (std::size_t t = 0; t < targets.count(); ++t) {
            (ahead.*moved)[t] += step;
            (behind.*moved)[t] -= step;
        }
        const auto more = evaluate(kernels(), ahead, sources, no_self);
        const auto less = evaluate(kernels(), behind, sources, no_self);
        for (std::size_t t = 0; t < targets.count(); ++t) {
            for (std::size_t i = 0; i < 3; ++i) {
                const double slope = (more[Ax + i][t] - less[Ax + i][t]) / (2 * step);
                EXPECT_LE(std::abs(slope - tide[entry[i][axis]][t]),
                          slope_tolerance(targets, t, sources, Ax + i, entry[i][axis]))
                    << component_names[entry[i][axis]] << " of target " << t;
            }
        }
    }
}

// The exact trace is zero; what is left is the three entries' rounding.
TYPED_TEST(GravityKernel, TideHasNoTraceWithoutSoftening)
{
    auto targets = random_bodies<TypeParam>(16, 1);
    auto sources = random_bodies<TypeParam>(60, 2);
    targets.q.assign(targets.count(), 0);
    sources.q.assign(sources.count(), 0);
    for (const KernelTable* table : runnable_kernels()) {
        const auto sums = evaluate(*table, targets, sources, no_self);
        for (std::size_t t = 0; t < targets.count(); ++t) {
            const Reference exact = reference(targets, t, sources, no_self);
            long double trace = 0, bound = 0;
            for (const std::size_t c : {Txx, Tyy, Tzz}) {
                trace += sums[c][t];
                bound += tolerance<TypeParam>(c, exact, sources.count());
            }
            EXPECT_LE(std::abs(trace), bound) << table->name << ", target " << t;
        }
    }
}

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
