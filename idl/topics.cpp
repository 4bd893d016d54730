#include "idl/topics.hpp"

namespace slod::wire {

std::string region_partition(std::string_view region)
{
    return "roi/" + std::string(region);
}

} // namespace slod::wire
