#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

#include "simd/kernels.hpp"

// Bodies, what the kernels make of them, and the definition they are held against.
namespace slod::simd {

enum Component : std::size_t { Ax, Ay, Az, Txx, Txy, Txz, Tyy, Tyz, Tzz, Phi, component_count };

inline constexpr std::array component_names = {"ax",  "ay",  "az",  "txx", "txy",
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
inline double roundings(std::size_t component)
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

} // namespace slod::simd
