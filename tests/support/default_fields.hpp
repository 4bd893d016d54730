#pragma once

#include <cstddef>
#include <string>
#include <type_traits>

#include <gtest/gtest.h>

#include "effects/fields/field_set.hpp"
#include "support/field_tables.hpp"

// Effects of place as every scene may have them: whatever is in their list is tested alike.
namespace slod::test {

/// The settings with an effect of default settings besides what they have.
template <class F>
void add_default(FieldSettings& settings)
{
    for_each_field_table(settings, [&]<class E>(typename E::Table& table) {
        if constexpr (std::is_same_v<E, F>)
            add_element(table, typename F::Settings{});
    });
}

template <class T>
T zero()
{
    if constexpr (std::is_same_v<T, Vector3d>)
        return Vector3d::Zero();
    else
        return T{};
}

/// Without strength: the first of its settings, set to 0, that lets it not act.
template <class F>
typename F::Settings powerless()
{
    for (std::size_t candidate = 0;; ++candidate) {
        typename F::Settings settings;
        std::size_t index = 0;
        for_each_field(settings, [&]<class T>(const Field&, T& value) {
            if (index++ == candidate)
                value = zero<T>();
        });
        if (candidate > index || !F(settings, FieldSource{}).acts())
            return settings;
    }
}

/// Names a typed test after its effect.
struct FieldName {
    template <class F>
    static std::string GetName(int)
    {
        return std::string(F::name);
    }
};

/// The effects of a list, for TYPED_TEST_SUITE.
template <class List>
struct TestTypes;
template <class... F>
struct TestTypes<FieldList<F...>> {
    using Types = testing::Types<F...>;
};

} // namespace slod::test
