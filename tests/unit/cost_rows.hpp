#pragma once

#include "cost/row.hpp"

namespace slod::cost {

/// A made-up outcome: all of its error is of positions.
inline Row row(const Setting& setting, double ms, double error)
{
    Row made;
    made.setting = made.in_full = setting;
    made.ms_median = ms;
    made.errors.position = error;
    return made;
}

inline Row row(Motion motion, double size, double ms, double error)
{
    return row(Setting{motion, size}, ms, error);
}

} // namespace slod::cost
