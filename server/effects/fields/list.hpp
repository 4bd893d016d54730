#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "effects/fields/attractor.hpp"
#include "effects/fields/buoyancy.hpp"
#include "effects/fields/spring.hpp"
#include "effects/fields/turbulence.hpp"
#include "effects/fields/vortex.hpp"
#include "effects/fields/wind.hpp"

namespace slod {

/// Effects of place as a list of their classes.
template <PlaceField... F>
struct FieldList {
    static constexpr std::size_t size = sizeof...(F);
    using Tables = std::tuple<typename F::Table...>;

    /// Calls visit.operator()<F>() for each of them, in order.
    template <class Visitor>
    static constexpr void for_each(Visitor&& visit)
    {
        (visit.template operator()<F>(), ...);
    }
};

/// Elements of one effect of place in one scene.
inline constexpr std::size_t max_fields = 256;

/// Accelerations that depend on the place: one line for each effect.
using ForceFields = FieldList< //
    Attractor,                 //
    Spring,                    //
    Vortex,                    //
    Buoyancy>;

/// Winds, which act through the drag.
using AirFields = FieldList< //
    Wind,                    //
    Turbulence>;

template <class First, class Second>
struct Joined;
template <class... F, class... G>
struct Joined<FieldList<F...>, FieldList<G...>> {
    using Type = FieldList<F..., G...>;
};

using AllFields = Joined<ForceFields, AirFields>::Type;

/// The tables of a scene that set effects of place.
struct FieldSettings {
    AllFields::Tables tables;

    template <class F>
    typename F::Table& of()
    {
        return std::get<typename F::Table>(tables);
    }
    template <class F>
    const typename F::Table& of() const
    {
        return std::get<typename F::Table>(tables);
    }

    friend bool operator==(const FieldSettings&, const FieldSettings&) = default;
};

/// What the clusters that the boundary of an effect cuts are counted as: "wind_straddling".
template <HasBoundary F>
inline constexpr auto straddling_letters = [] {
    constexpr std::string_view ending = "_straddling";
    std::array<char, F::name.size() + ending.size()> joined{};
    std::copy(ending.begin(), ending.end(), std::copy(F::name.begin(), F::name.end(), joined.begin()));
    return joined;
}();

template <HasBoundary F>
constexpr std::string_view straddling_name()
{
    return {straddling_letters<F>.data(), straddling_letters<F>.size()};
}

/// The key of the i-th element of an effect's table: "attractor.0", or that of its only one.
template <PlaceField F>
std::string key_of(std::size_t i)
{
    constexpr bool several = std::is_same_v<typename F::Table, std::vector<typename F::Settings>>;
    return std::string(F::name) + (several ? "." + std::to_string(i) : "");
}

/// Calls visit.operator()<F>(table) for each effect of place and its table.
template <class Visitor>
void for_each_field_table(FieldSettings& settings, Visitor&& visit)
{
    AllFields::for_each([&]<class F> { visit.template operator()<F>(settings.of<F>()); });
}

template <class Visitor>
void for_each_field_table(const FieldSettings& settings, Visitor&& visit)
{
    AllFields::for_each([&]<class F> { visit.template operator()<F>(settings.of<F>()); });
}

} // namespace slod
