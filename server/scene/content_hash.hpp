#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "cluster/particles.hpp"
#include "effects/collider_settings.hpp"

namespace slod {

/// Hash of particles as delivered: XXH3 over every field, in order.
std::uint64_t content_hash(const ParticleSet& particles);

/// Hash of what colliders have from files; 0 where that is nothing.
std::uint64_t content_hash(const std::vector<ColliderSettings>& colliders);

std::uint64_t content_hash(std::string_view text);

/// A 64-bit hash as 16 hexadecimal digits, as in logs and reports.
std::string hash_text(std::uint64_t hash);

} // namespace slod
