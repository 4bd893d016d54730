#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

#include "core/settings.hpp"
#include "effects/fields/list.hpp"

namespace slod {

inline constexpr std::size_t effect_count = 11 + AllFields::size;

/// Rows of the effects of place, which follow these, in the lists below.
inline constexpr std::size_t first_field_effect = 5;

/// All effects that the program knows, in the order in which they are listed everywhere.
inline constexpr std::array<std::string_view, effect_count> effect_names = [] {
    std::array<std::string_view, effect_count> names{"gravity", "uniform_gravity", "linear_drag",
                                                     "uniform_wind", "quadratic_drag"};
    std::size_t row = first_field_effect;
    AllFields::for_each([&]<class F> { names[row++] = F::name; });
    for (const std::string_view name : {"speed_limit", "brownian", "collider", "emitter", "lifetime", "sink"})
        names[row++] = name;
    return names;
}();

/// The row of an effect, which must be one, in such lists.
constexpr std::size_t effect_row(std::string_view name)
{
    return std::size_t(std::find(effect_names.begin(), effect_names.end(), name) - effect_names.begin());
}

/// Which of a scene's effects run. One that is switched off is as if the scene did not name it, but its
/// settings stay, so that it can be switched on again.
struct EffectSwitches {
    std::array<bool, effect_count> on = all_on(); ///< by effect_row(); lifetime belongs to the emitter

    bool runs(std::string_view effect) const { return on[effect_row(effect)]; }

    friend bool operator==(const EffectSwitches&, const EffectSwitches&) = default;

private:
    static constexpr std::array<bool, effect_count> all_on()
    {
        std::array<bool, effect_count> all{};
        all.fill(true);
        return all;
    }
};

template <class Visitor>
void for_each_field(EffectSwitches& switches, Visitor&& visit)
{
    for (std::size_t row = 0; row < effect_count; ++row)
        if (effect_names[row] != "lifetime")
            visit(Field{effect_names[row], "", "Whether it runs, where the scene has it."}, switches.on[row]);
}

} // namespace slod
