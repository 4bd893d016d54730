#include "scene/content_hash.hpp"

#include <array>
#include <bit>
#include <cinttypes>
#include <cstdio>
#include <memory>

#include <xxhash.h>

namespace slod {

std::uint64_t content_hash(const ParticleSet& particles)
{
    const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), &XXH3_freeState);
    XXH3_64bits_reset(state.get());
    for (const Particle& particle : particles) {
        std::array<std::uint64_t, 9> fields{};
        for (int axis = 0; axis < 3; ++axis) {
            fields[std::size_t(axis)] = std::bit_cast<std::uint64_t>(particle.position[axis]);
            fields[std::size_t(axis) + 3] = std::bit_cast<std::uint64_t>(particle.velocity[axis]);
        }
        fields[6] = particle.id;
        fields[7] = std::uint64_t(std::bit_cast<std::uint32_t>(particle.mass)) << 32 | particle.expiry_frame;
        fields[8] = particle.kind;
        XXH3_64bits_update(state.get(), fields.data(), sizeof fields);
    }
    return XXH3_64bits_digest(state.get());
}

std::uint64_t content_hash(const std::vector<ColliderSettings>& colliders)
{
    std::uint64_t hash = 0;
    for (const ColliderSettings& collider : colliders) {
        if (!collider.mesh)
            continue;
        const auto& [vertices, triangles] = *collider.mesh;
        hash = XXH3_64bits_withSeed(vertices.data(), vertices.size() * sizeof vertices.front(), hash);
        hash = XXH3_64bits_withSeed(triangles.data(), triangles.size() * sizeof triangles.front(), hash);
    }
    return hash;
}

std::uint64_t content_hash(std::string_view text)
{
    return XXH3_64bits(text.data(), text.size());
}

std::string hash_text(std::uint64_t hash)
{
    std::array<char, 17> digits;
    std::snprintf(digits.data(), digits.size(), "%016" PRIx64, hash);
    return digits.data();
}

} // namespace slod
