#include "cost/row.hpp"

#include <algorithm>

namespace slod::cost {

std::vector<Row> pareto_front(const std::vector<Row>& rows, Motion motion)
{
    std::vector<Row> own;
    for (const Row& row : rows)
        if (row.setting.unclustered() || row.setting.motion == motion)
            own.push_back(row);
    std::stable_sort(own.begin(), own.end(),
                     [](const Row& a, const Row& b) { return a.ms_median < b.ms_median; });
    std::vector<Row> front;
    for (const Row& row : own)
        if (front.empty() || row.errors.largest() < front.back().errors.largest())
            front.push_back(row);
    return front;
}

} // namespace slod::cost
