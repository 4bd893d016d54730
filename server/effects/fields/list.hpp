#pragma once

#include <cstddef>
#include <string>
#include <tuple>
#include <type_traits>

#include "effects/fields/attractor.hpp"
#include "effects/fields/buoyancy.hpp"
#include "effects/fields/spring.hpp"
#include "effects/fields/vortex.hpp"

namespace slod {

/// Effects of place as a list of their classes.
template <PlaceField... F>
struct FieldList {
    static constexpr std::size_t size = sizeof...(F);
    using Tables = std::tuple<typename F::Table...>;

    /// Calls visit.operator()<F>() for each of them, in order.
    template <class Visitor>
    static void for_each(Visitor&& visit)
    {
        (visit.template operator()<F>(), ...);
    }
};

/// Accelerations that depend on the place: one line for each effect.
using ForceFields = FieldList< //
    Attractor,                 //
    Spring,                    //
    Vortex,                    //
    Buoyancy>;

/// The tables of a scene that set effects of place.
struct FieldSettings {
    ForceFields::Tables forces;

    template <class F>
    const typename F::Table& of() const
    {
        return std::get<typename F::Table>(forces);
    }

    friend bool operator==(const FieldSettings&, const FieldSettings&) = default;
};

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
    ForceFields::for_each(
        [&]<class F> { visit.template operator()<F>(std::get<typename F::Table>(settings.forces)); });
}

template <class Visitor>
void for_each_field_table(const FieldSettings& settings, Visitor&& visit)
{
    ForceFields::for_each(
        [&]<class F> { visit.template operator()<F>(std::get<typename F::Table>(settings.forces)); });
}

} // namespace slod
