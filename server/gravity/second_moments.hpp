#pragma once

#include "gravity/force_view.hpp"

namespace slod {

/// Fills in the second moments of a view's nodes, bottom up: the nodes must be summed up. O(nodes + bodies).
void sum_up_second_moments(ForceView& view);

} // namespace slod
