#include "effects/sheet.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include <Eigen/Geometry>

#include "effects/path.hpp"

namespace slod {

Sheet::Sheet(const Mesh& mesh, double thickness)
    : radius_(0.5 * thickness), vertices_(mesh.vertices), tree_({})
{
    take_triangles(mesh);
    find_fans();
    const std::vector<Box> all = boxes();
    tree_ = BoxTree(all);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    bounds_ = {Vector3d::Constant(infinity), Vector3d::Constant(-infinity)};
    for (const Box& box : all) {
        bounds_.lower = bounds_.lower.cwiseMin(box.lower);
        bounds_.upper = bounds_.upper.cwiseMax(box.upper);
    }
}

/// Of vertices at the same place the first one stands for all.
void Sheet::take_triangles(const Mesh& mesh)
{
    const std::vector<std::uint32_t> first_at = first_at_each_place(vertices_);
    for (const Mesh::Triangle& each : mesh.triangles) {
        const Mesh::Triangle triangle{first_at[each[0]], first_at[each[1]], first_at[each[2]]};
        const Vector3d normal =
            triangle_normal(vertices_[triangle[0]], vertices_[triangle[1]], vertices_[triangle[2]]);
        if (normal.isZero(0))
            continue;
        triangles_.push_back(triangle);
        normals_.push_back(normal);
    }
}

void Sheet::find_fans()
{
    fan_begin_.assign(vertices_.size() + 1, 0);
    for (const Mesh::Triangle& triangle : triangles_)
        for (const std::uint32_t vertex : triangle)
            ++fan_begin_[vertex + 1];
    std::partial_sum(fan_begin_.begin(), fan_begin_.end(), fan_begin_.begin());
    fans_.resize(3 * triangles_.size());
    std::vector<std::uint32_t> next(fan_begin_.begin(), fan_begin_.end() - 1);
    for (std::uint32_t i = 0; i < triangles_.size(); ++i)
        for (const std::uint32_t vertex : triangles_[i])
            fans_[next[vertex]++] = i;
}

Box Sheet::box_of(const Mesh::Triangle& triangle) const
{
    const Box box = box_around(vertices_[triangle[0]], vertices_[triangle[1]], radius_);
    const Vector3d& third = vertices_[triangle[2]];
    return {box.lower.cwiseMin((third.array() - radius_).matrix()),
            box.upper.cwiseMax((third.array() + radius_).matrix())};
}

std::vector<Box> Sheet::boxes() const
{
    std::vector<Box> all;
    all.reserve(triangles_.size());
    for (const Mesh::Triangle& triangle : triangles_)
        all.push_back(box_of(triangle));
    return all;
}

/// Where it cannot be told whether the nearest point is on the rim, the face's normal is the better one, as
/// those of faces in one plane are alike.
Surface Plate::surface(const Vector3d& x) const
{
    const Vector3d& normal = sheet_.normals_[index_];
    const Foot nearest = foot(x);
    if (nearest.count == 3) {
        const double height = normal.dot(x - nearest.point);
        return {std::abs(height) - sheet_.radius_, height < 0 ? Vector3d(-normal) : normal};
    }
    const Vector3d away = x - nearest.point;
    const double distance = away.norm();
    const Vector3d across = normal.dot(away) < 0 ? Vector3d(-normal) : normal;
    const bool over_rim = (away - distance * across).norm() <= slack(x) * distance;
    return {distance - sheet_.radius_, over_rim ? across : Vector3d(away / distance)};
}

/// Off all edges that it is not beyond, it is inside. The point of a face is any corner, as only the height
/// above it matters.
Plate::Foot Plate::foot(const Vector3d& x) const
{
    const Mesh::Triangle& corners = triangle();
    const Vector3d& normal = sheet_.normals_[index_];
    Foot nearest{vertex(corners[0]), corners, 3};
    double least = never;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t a = corners[i], b = corners[(i + 1) % 3];
        if ((vertex(b) - vertex(a)).cross(normal).dot(x - vertex(a)) <= 0)
            continue;
        const Foot on_edge = foot_on_edge(std::min(a, b), std::max(a, b), x);
        const double distance = (x - on_edge.point).squaredNorm();
        if (distance < least) {
            least = distance;
            nearest = on_edge;
        }
    }
    return nearest;
}

/// From the vertex with the lower number to the other, so that all triangles at an edge find the same bits.
Plate::Foot Plate::foot_on_edge(std::uint32_t a, std::uint32_t b, const Vector3d& x) const
{
    const Vector3d edge = vertex(b) - vertex(a);
    const double share = edge.dot(x - vertex(a)) / edge.squaredNorm();
    if (share <= 0)
        return {vertex(a), {a}, 1};
    if (share >= 1)
        return {vertex(b), {b}, 1};
    return {vertex(a) + share * edge, {a, b}, 2};
}

/// Unit vector from the foot towards a vertex; across the edge, if it is on one.
Vector3d Plate::away_from(const Foot& foot, std::uint32_t to) const
{
    Vector3d way = vertex(to) - foot.point;
    if (foot.count == 2) {
        const Vector3d edge = (vertex(foot.on[1]) - vertex(foot.on[0])).normalized();
        way -= edge.dot(way) * edge;
    }
    return way.normalized();
}

/// The direction in which another triangle at the same edge or vertex comes nearest to `x`, and how much
/// nearer.
Cover::Limit Plate::nearest_neighbour(const Foot& foot, const Vector3d& x) const
{
    Cover::Limit nearest{{0, 0, 0}, 0};
    for (const std::uint32_t other : sheet_.fan(foot.on[0])) {
        const Mesh::Triangle& corners = sheet_.triangles_[other];
        if (other == index_ ||
            (foot.count == 2 && std::find(corners.begin(), corners.end(), foot.on[1]) == corners.end()))
            continue;
        for (const std::uint32_t corner : corners) {
            if (foot.has(corner))
                continue;
            const Vector3d towards = away_from(foot, corner);
            const double height = towards.dot(x - foot.point);
            if (height > nearest.height)
                nearest = {towards, height};
        }
    }
    return nearest;
}

/// From a face, nothing is nearer. Else it is covered as far as the neighbour is nearer, and as its own
/// nearest point stays on the edge or vertex, or does not leave it by more than contacts are told apart.
Cover Plate::cover(const Vector3d& x) const
{
    Cover cover;
    const Foot nearest = foot(x);
    if (nearest.count == 3)
        return cover;
    const Cover::Limit neighbour = nearest_neighbour(nearest, x);
    if (neighbour.height <= contact_tolerance(x))
        return cover;
    const double tolerance = contact_tolerance(x);
    const auto add = [&](const Vector3d& inward, double height) {
        cover.limits[std::size_t(cover.count++)] = {inward, std::max(height, 0.0) + tolerance};
    };
    cover.limits[std::size_t(cover.count++)] = neighbour;
    const Vector3d away = x - nearest.point;
    for (const std::uint32_t corner : triangle()) {
        if (nearest.has(corner))
            continue;
        const Vector3d inward = -away_from(nearest, corner);
        add(inward, inward.dot(away));
    }
    if (nearest.count == 2) {
        const Vector3d edge = (vertex(nearest.on[1]) - vertex(nearest.on[0])).normalized();
        add(edge, edge.dot(x - vertex(nearest.on[0])));
        add(-edge, edge.dot(vertex(nearest.on[1]) - x));
    }
    return cover;
}

double Plate::slack(const Vector3d& x) const
{
    return 4 * contact_tolerance(x) / sheet_.radius_;
}

Vector3d triangle_normal(const Vector3d& a, const Vector3d& b, const Vector3d& c)
{
    return (b - a).cross(c - a).stableNormalized();
}

} // namespace slod
