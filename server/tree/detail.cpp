#include "tree/detail.hpp"

#include <algorithm>

#include "core/portable_math.hpp"

namespace slod {
namespace {

/// factor^share, and exactly the factor where the share is 1.
double shared(double factor, double share)
{
    return share == 1 || factor == 1 ? factor : portable_exp(share * portable_log(factor));
}

} // namespace

RegionSettings at_detail(const RegionSettings& region, const Detail& detail)
{
    RegionSettings changed = region;
    const double size = region.max_cluster_size;
    changed.max_cluster_size =
        std::clamp(size * shared(detail.cluster_size, region.control_share),
                   std::min(detail.least_size, size), std::max(detail.most_size, size));
    changed.max_breadth *= shared(detail.breadth, region.control_share);
    return changed;
}

} // namespace slod
