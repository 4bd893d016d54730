#include "effects/mesh.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace slod {

std::vector<std::uint32_t> first_at_each_place(const std::vector<Vector3d>& vertices)
{
    const auto place = [&](std::uint32_t index) {
        const Vector3d& x = vertices[index];
        return std::tuple(x.x(), x.y(), x.z());
    };
    std::vector<std::uint32_t> order(vertices.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return std::tuple(place(a), a) < std::tuple(place(b), b);
    });
    std::vector<std::uint32_t> first_at(order.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        first_at[order[i]] =
            i > 0 && place(order[i]) == place(order[i - 1]) ? first_at[order[i - 1]] : order[i];
    return first_at;
}

} // namespace slod
