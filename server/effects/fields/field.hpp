#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/settings.hpp"
#include "core/vectors.hpp"
#include "simd/kernels.hpp"
#include "tree/box.hpp"

namespace slod {

/// What fields come to at a place: an acceleration, or the air's velocity, and how it changes from there.
struct FieldValue {
    Vector3d value{0, 0, 0};
    Matrix3d gradient = Matrix3d::Zero(); ///< d value_i / d x_j
};

/// What a field may depend on besides its settings.
struct FieldSource {
    std::uint64_t seed = 0; ///< of the scene
    const simd::WaveKernels* waves = &simd::kernels().waves;
};

/// One element of one table of a scene. The class is all that the program knows of the effect, and its line
/// in fields/list.hpp the only place that names it; scene sections, plan, counters and tests follow.
///  - Settings has defaults that act near the origin, in scene units; Table is a std::vector of them for
///    a [[table]] each, or a std::optional for one [table];
///  - problems() says what no field's range can, the key first, beside a frame of `step`;
///  - problems_together(), where there is one: what elements that are sound by themselves cannot be at once,
///    as whole sentences;
///  - acts() is false for an element of no strength, which is dropped;
///  - add() adds value and gradient at a place and time, finite everywhere, 0 outside bounds();
///  - symmetric: the gradient is a symmetric matrix at every place;
///  - uniform(), where there is one: whether it is the same at every place;
///  - clearance(), where there is one: how far a place is from the field's boundary, the nearest surface
///    where it sets in or from which on it is whole; infinite everywhere for an element without. The formula
///    is another beyond, so a cluster that the surface cuts follows that of its centre with all its members;
///  - potential(), where there is one: value is the negative gradient of it;
///  - add_all(), where there is one: as add(), at many places at once, with the same bits.
template <class F>
concept PlaceField = requires(const F& field, const typename F::Settings& settings, const Vector3d& x,
                              FieldValue& sum)
{
    F(settings, FieldSource{});
    typename F::Table;
    std::string_view(F::name);
    std::string_view(F::help);
    bool(F::symmetric);
    Problems(F::problems(settings, 1.0));
    bool(field.acts());
    Box(field.bounds());
    field.add(x, 0.0, sum);
};

template <class F>
concept HasPotential = PlaceField<F> && requires(const F& field, const Vector3d& x)
{
    double(field.potential(x));
};

template <class F>
concept HasBoundary = PlaceField<F> && requires(const F& field, const Vector3d& x)
{
    double(field.clearance(x));
};

/// A field that is cheaper at many places at once: adds to *sums[i] what it is at places[i].
template <class F>
concept SumsMany = PlaceField<F> &&
    requires(const F& field, std::span<const Vector3d> places, std::span<FieldValue* const> sums)
{
    field.add_all(places, 0.0, sums);
};

/// Asks one field at one place after the other: at many of them together where that is cheaper. Sums are
/// complete once it is gone.
template <PlaceField F>
class Asking {
public:
    Asking(const F& field, double time) : field_(field), time_(time) {}
    Asking(const Asking&) = delete;
    Asking& operator=(const Asking&) = delete;
    ~Asking() { flush(); }

    void add(const Vector3d& x, FieldValue& sum)
    {
        if constexpr (!SumsMany<F>) {
            field_.add(x, time_, sum);
        } else {
            places_[count_] = x;
            sums_[count_++] = &sum;
            if (count_ == places_.size())
                flush();
        }
    }

private:
    void flush()
    {
        if constexpr (SumsMany<F>)
            field_.add_all({places_.data(), count_}, time_, {sums_.data(), count_});
        count_ = 0;
    }

    const F& field_;
    double time_;
    std::array<Vector3d, SumsMany<F> ? 64 : 0> places_;
    std::array<FieldValue*, SumsMany<F> ? 64 : 0> sums_;
    std::size_t count_ = 0;
};

/// All space.
inline Box unbounded()
{
    constexpr double far = std::numeric_limits<double>::infinity();
    return {Vector3d::Constant(-far), Vector3d::Constant(far)};
}

/// The elements of a table.
template <class Settings>
std::span<const Settings> elements(const std::vector<Settings>& table)
{
    return table;
}

template <class Settings>
std::span<const Settings> elements(const std::optional<Settings>& table)
{
    return table ? std::span(&*table, 1) : std::span<const Settings>();
}

/// A step from 0 to 1 over `x` from 0 to 1 with a continuous derivative, and the step's integral from 0.
struct SmoothStep {
    double value, slope, integral;

    explicit SmoothStep(double x)
    {
        const double t = x < 0 ? 0 : x > 1 ? 1 : x;
        value = t * t * (3 - 2 * t);
        slope = 6 * t * (1 - t);
        integral = t * t * t * (1 - 0.5 * t) + (x > 1 ? x - 1 : 0);
    }
};

} // namespace slod
