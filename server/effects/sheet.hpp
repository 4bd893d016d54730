#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "effects/box_tree.hpp"
#include "effects/mesh.hpp"
#include "effects/solid.hpp"

namespace slod {

/// A surface of triangles that has a thickness: all within half of it of any triangle is solid, on both
/// sides, so that it has no inside for a particle to be lost in, and a side is not mistaken for the other by
/// rounding. Each triangle with what is about it, a plate, is convex by itself.
class Sheet {
public:
    /// Vertices at the same place are one, and triangles without an area are left out.
    Sheet(const Mesh& mesh, double thickness);

    std::uint32_t plate_count() const { return std::uint32_t(triangles_.size()); }
    const Box& bounds() const { return bounds_; }

    /// Calls visit(plate) for each whose box the sweep meets until it returns true; returns whether it did.
    template <class Visit>
    bool any(const Sweep& sweep, const Visit& visit) const
    {
        return tree_.any(sweep, [&](std::uint32_t plate) {
            return sweep.meets(box_of(triangles_[plate])) && visit(plate);
        });
    }

private:
    friend class Plate;

    Box box_of(const Mesh::Triangle& triangle) const;
    std::vector<Box> boxes() const;
    void take_triangles(const Mesh& mesh);
    void find_fans();
    std::span<const std::uint32_t> fan(std::uint32_t vertex) const
    {
        return std::span(fans_).subspan(fan_begin_[vertex], fan_begin_[vertex + 1] - fan_begin_[vertex]);
    }

    double radius_; ///< half the thickness
    std::vector<Vector3d> vertices_;
    std::vector<Mesh::Triangle> triangles_;
    std::vector<Vector3d> normals_;        ///< by triangle, unit vectors
    std::vector<std::uint32_t> fan_begin_; ///< by vertex, and the end
    std::vector<std::uint32_t> fans_;      ///< the triangles at each vertex
    Box bounds_;
    BoxTree tree_;
};

/// One triangle of a sheet, with what is about it.
class Plate final : public Solid {
public:
    Plate(const Sheet& sheet, std::uint32_t index) : sheet_(sheet), index_(index) {}

    Surface surface(const Vector3d& x) const override;
    Box bounds() const override { return sheet_.box_of(triangle()); }
    Cover cover(const Vector3d& x) const override;
    double slack(const Vector3d& x) const override;

private:
    /// The nearest point of the triangle, and what it lies on: `count` vertices span that.
    struct Foot {
        Vector3d point;
        std::array<std::uint32_t, 3> on;
        int count;

        bool has(std::uint32_t vertex) const
        {
            return std::find(on.begin(), on.begin() + count, vertex) != on.begin() + count;
        }
    };

    const Mesh::Triangle& triangle() const { return sheet_.triangles_[index_]; }
    const Vector3d& vertex(std::uint32_t index) const { return sheet_.vertices_[index]; }
    Foot foot(const Vector3d& x) const;
    Foot foot_on_edge(std::uint32_t a, std::uint32_t b, const Vector3d& x) const;
    Vector3d away_from(const Foot& foot, std::uint32_t vertex) const;
    Cover::Limit nearest_neighbour(const Foot& foot, const Vector3d& x) const;

    const Sheet& sheet_;
    std::uint32_t index_;
};

/// Unit vector across a triangle; 0 where that has no area.
Vector3d triangle_normal(const Vector3d& a, const Vector3d& b, const Vector3d& c);

/// That of settings without problems whose mesh is there.
std::unique_ptr<Sheet> make_sheet(const ColliderSettings& settings);

} // namespace slod
