#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "cluster/particles.hpp"
#include "core/random.hpp"
#include "core/settings.hpp"

/// Point masses to measure forces between. Their ids are 1, 2, 3, ... in their order.
namespace slod::cost {

/// `count` particles at rest, of mass 1 in all, where `place` puts them, each with a random sequence of its
/// own.
ParticleSet cloud(std::size_t count, std::uint64_t seed, const std::function<Vector3d(Random&)>& place);

/// Such clouds: a Plummer sphere of scale length 1 cut at 20, which gravity codes are compared by; two clumps
/// of dispersion 0.02, one on the origin and one at (10.1, 9.9, 10), so that their centre of mass is far from
/// both; a disc of surface density exp(-R) and thickness 0.05; and a homogeneous unit box.
struct CloudModel {
    std::string_view name;
    Vector3d (*place)(Random&);
};
std::span<const CloudModel> cloud_models();

/// The model of this name; null when there is none.
const CloudModel* cloud_model(std::string_view name);

/// Most bodies of a text file.
inline constexpr std::size_t max_text_bodies = 100'000'000;

/// Reads bodies from a GADGET-2 file (SnapFormat 1), or from a text file of a line "x y z mass" for each,
/// separated by blanks or commas; lines that are empty or begin with # are passed over. A problem names the
/// file, the line and what to do.
std::variant<ParticleSet, Problems> read_bodies(const std::filesystem::path& file);

/// The bodies of a model, 100,000 of seed 1 unless asked for otherwise; or those of the file of that name,
/// where it is a problem to ask for a number or a seed.
std::variant<ParticleSet, Problems> bodies_of(const std::string& model_or_file,
                                              std::optional<std::size_t> count,
                                              std::optional<std::uint64_t> seed);

} // namespace slod::cost
