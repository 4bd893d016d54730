#pragma once

#include "gravity/force_view.hpp"

namespace slod {

/// Fills in what the nodes of a view are as one body each (mass, centre, q and sizes), bottom up: the bodies,
/// and what the nodes cover, must be there.
void sum_up_nodes(ForceView& view);

} // namespace slod
