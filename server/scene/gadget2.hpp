#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string_view>
#include <variant>
#include <vector>

#include "cluster/particles.hpp"
#include "core/settings.hpp"

namespace slod {

/// GADGET-2's six particle types by number, as its manual calls them. A type becomes the scene's kind of the
/// same name.
inline constexpr std::array<std::string_view, 6> gadget2_types{"gas",   "halo",  "disc",
                                                               "bulge", "stars", "bndry"};

/// Most particles that are read from one file.
inline constexpr std::size_t max_gadget2_particles = 100'000'000;

/// Reads a GADGET-2 snapshot or initial condition in SnapFormat 1, little-endian, in one file, single
/// precision (Springel 2005, MNRAS 364, 1105, and the GADGET-2 user guide, section 6): the header and the
/// blocks POS, VEL, ID and, where the header leaves a type's mass open, MASS. What follows is not looked at.
/// Particles keep their ids and order; the file's units are taken for the scene's. Every problem names the
/// file and what to do.
std::variant<ParticleSet, Problems> read_gadget2(const std::filesystem::path& file,
                                                 const std::vector<ParticleKind>& kinds);

} // namespace slod
