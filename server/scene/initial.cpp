#include <cstdlib>
#include <string>
#include <system_error>

#include "core/number_text.hpp"
#include "scene/gadget2.hpp"
#include "scene/galaxy_model.hpp"
#include "scene/galaxy_pair.hpp"
#include "scene/kinds.hpp"
#include "scene/scene.hpp"
#include "sim/quarantine.hpp"

namespace slod {

namespace {

/// The environment's folder of initial conditions.
constexpr const char* data_folder_variable = "SLOD_DATA_DIR";

/// "60000 particles: 40000 halo, 20000 disc".
std::string census(const ParticleSet& particles, const std::vector<ParticleKind>& kinds)
{
    std::vector<std::size_t> counts(kinds.size());
    for (const Particle& particle : particles)
        ++counts[particle.kind];
    std::string text;
    for (std::size_t row = 0; row < kinds.size(); ++row)
        if (counts[row] > 0)
            text += (text.empty() ? ": " : ", ") + std::to_string(counts[row]) + " " + kinds[row].name;
    return std::to_string(particles.size()) + " particles" + text;
}

/// Where the scene's own file is, or in words why it is not there.
struct Lookup {
    std::filesystem::path file;
    std::string missing;
};

Lookup look_up(const std::string& name)
{
    if (name.empty())
        return {{}, "initial.file names no file"};
    std::filesystem::path file = name;
    if (file.is_relative()) {
        const char* const folder = std::getenv(data_folder_variable);
        if (folder == nullptr || *folder == '\0')
            return {{}, std::string(data_folder_variable) + ", the folder of " + name + ", is not set"};
        file = std::filesystem::path(folder) / file;
    }
    std::error_code error;
    if (std::filesystem::status(file, error).type() == std::filesystem::file_type::not_found)
        return {{}, file.string() + " is not there"};
    return {file, {}};
}

std::variant<InitialParticles, Problems> from_file(const Scene& scene, const std::filesystem::path& file)
{
    const auto& kinds = scene.simulation.kinds;
    auto read = read_gadget2(file, kinds);
    if (auto* const found = std::get_if<Problems>(&read))
        return std::move(*found);
    InitialParticles initial{std::get<ParticleSet>(std::move(read)), {}, file};
    const double range = scene_range(scene.simulation);
    for (const Particle& particle : initial.particles)
        if (!in_range(particle.position, range) || !in_range(particle.velocity, largest_number))
            return Problems{file.string() + ": particle " + std::to_string(particle.id) +
                            " is out of the scene's range, " + number_text(range) + " for places and " +
                            number_text(largest_number) + " for velocities; repair or remove it."};
    initial.source = "GADGET-2 file " + file.string() + ", " + census(initial.particles, kinds) + ".";
    return initial;
}

GalaxyKind galaxy_kind(const std::vector<ParticleKind>& kinds, std::string_view name)
{
    // A component without mass needs no kind.
    const std::uint8_t row = kind_index(kinds, name).value_or(0);
    return {row, kinds.empty() ? 0 : kinds[row].softening};
}

ParticleSet generate(const Scene& scene, InitialModel model)
{
    const auto& kinds = scene.simulation.kinds;
    const double constant = scene.simulation.units.gravitational_constant();
    const GalaxyKinds of_components{galaxy_kind(kinds, "disc"), galaxy_kind(kinds, "bulge"),
                                    galaxy_kind(kinds, "halo")};
    const auto galaxy = [&](std::uint64_t seed) {
        return make_galaxy(scene.galaxy, of_components, constant, seed);
    };

    const std::uint64_t seed = scene.simulation.seed;
    if (model == InitialModel::Galaxy)
        return galaxy(seed);
    if (model == InitialModel::GalaxyPair)
        return on_parabolic_orbit(galaxy(seed), galaxy(seed + 1), scene.encounter, constant);
    return {};
}

InitialParticles generated(const Scene& scene, InitialModel model, const std::string& why)
{
    InitialParticles initial{generate(scene, model), {}, {}};
    if (model == InitialModel::None)
        initial.source = "No particles at the start.";
    else
        initial.source = "Generated " + std::string(names(model)[std::size_t(model)]) + " with seed " +
                         std::to_string(scene.simulation.seed) + ", " +
                         census(initial.particles, scene.simulation.kinds) + why + ".";
    return initial;
}

} // namespace

std::variant<InitialParticles, Problems> load_initial(const Scene& scene, const std::filesystem::path& input)
{
    const InitialModel model = scene.initial.model;
    if (model != InitialModel::Gadget2 && !input.empty())
        return Problems{input.string() + ": the scene's initial.model is " +
                        std::string(names(model)[std::size_t(model)]) +
                        ", which reads no file; set initial.model to gadget2 or name no input."};
    if (model != InitialModel::Gadget2)
        return generated(scene, model, "");
    if (!input.empty())
        return from_file(scene, input);

    const Lookup own = look_up(scene.initial.file);
    if (own.missing.empty())
        return from_file(scene, own.file);
    if (scene.initial.fallback != InitialModel::None)
        return generated(scene, scene.initial.fallback, ", because " + own.missing);
    return Problems{"initial.file = \"" + scene.initial.file + "\": " + own.missing +
                    "; name a file with --input or set " + data_folder_variable + " to its folder."};
}

} // namespace slod
