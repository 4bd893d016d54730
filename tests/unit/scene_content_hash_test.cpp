#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "scene/content_hash.hpp"

namespace slod {
namespace {

// Each change is of one field; the last swaps two particles.
TEST(ContentHash, CoversEveryFieldAndTheOrder)
{
    ParticleSet particles(2);
    for (std::size_t i = 0; i < 2; ++i)
        particles[i] = {
            .position = {1, 2, 3}, .velocity = {4, 5, 6}, .id = i, .mass = 7, .expiry_frame = 8, .kind = 0};
    const std::uint64_t before = content_hash(particles);
    EXPECT_EQ(content_hash(particles), before);

    const std::vector<std::function<void(ParticleSet&)>> changes{
        [](ParticleSet& set) { set[1].position.x() = 9; },
        [](ParticleSet& set) { set[1].position.y() = 9; },
        [](ParticleSet& set) { set[1].position.z() = 9; },
        [](ParticleSet& set) { set[1].velocity.x() = 9; },
        [](ParticleSet& set) { set[1].velocity.y() = 9; },
        [](ParticleSet& set) { set[1].velocity.z() = 9; },
        [](ParticleSet& set) { set[1].id = 9; },
        [](ParticleSet& set) { set[1].mass = 9; },
        [](ParticleSet& set) { set[1].expiry_frame = 9; },
        [](ParticleSet& set) { set[1].kind = 9; },
        [](ParticleSet& set) { std::swap(set[0], set[1]); },
        [](ParticleSet& set) { set.pop_back(); }};
    for (std::size_t change = 0; change < changes.size(); ++change) {
        ParticleSet changed = particles;
        changes[change](changed);
        EXPECT_NE(content_hash(changed), before) << "change " << change;
    }
}

TEST(ContentHash, OfCollidersChangesWithAnyVertexOrTriangle)
{
    const auto hash_of = [](const Mesh& mesh) {
        ColliderSettings collider{.name = "bowl", .shape = ColliderShape::Mesh};
        collider.mesh = std::make_shared<const Mesh>(mesh);
        return content_hash({ColliderSettings{.name = "floor"}, collider});
    };
    const Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
    EXPECT_EQ(hash_of(mesh), hash_of(mesh));
    Mesh moved = mesh, turned = mesh;
    moved.vertices[2].z() = 1e-9;
    turned.triangles[0] = {0, 2, 1};
    EXPECT_NE(hash_of(moved), hash_of(mesh));
    EXPECT_NE(hash_of(turned), hash_of(mesh));
    EXPECT_EQ(content_hash({ColliderSettings{.name = "floor"}}), 0U);
}

TEST(HashText, HasSixteenDigits)
{
    EXPECT_EQ(hash_text(0), "0000000000000000");
    EXPECT_EQ(hash_text(0xfedc'ba98'7654'3210), "fedcba9876543210");
}

} // namespace
} // namespace slod
