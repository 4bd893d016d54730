#include "effects/mesh.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

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

std::size_t rim_edges(const Mesh& mesh)
{
    const std::vector<std::uint32_t> first_at = first_at_each_place(mesh.vertices);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const Mesh::Triangle& triangle : mesh.triangles)
        for (std::size_t corner = 0; corner < 3; ++corner)
            edges.push_back(std::minmax({first_at[triangle[corner]], first_at[triangle[(corner + 1) % 3]]}));
    std::sort(edges.begin(), edges.end());
    std::size_t alone = 0;
    for (auto edge = edges.begin(); edge != edges.end();) {
        const auto next = std::find_if(edge, edges.end(), [&](const auto& other) { return other != *edge; });
        alone += next - edge == 1 ? 1 : 0;
        edge = next;
    }
    return alone;
}

} // namespace slod
