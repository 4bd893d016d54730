#include <algorithm>
#include <cmath>
#include <filesystem>
#include <variant>

#include "app/input_log.hpp"
#include "fuzz/inputs.hpp"
#include "scene/gadget2.hpp"
#include "scene/scene.hpp"
#include "support/scratch_folder.hpp"

namespace slod::test {
namespace {

/// Each problem has to name the file, or the override that it is owed to.
Dealt refused(const Problems& problems, const std::string& file)
{
    if (problems.empty())
        return {.wrong = "refused without a problem"};
    for (const std::string& problem : problems)
        if (problem.find(file) == std::string::npos && !problem.starts_with("--set "))
            return {.wrong = "does not name the file: " + problem};
    return {};
}

/// A file with these bytes and this name, in place of the last one.
std::filesystem::path rewritten(const std::string& name, std::string_view bytes)
{
    static const ScratchFolder folder;
    std::filesystem::remove(folder.path() / name); // faster than to write into what is there
    return folder.write(name, bytes);
}

bool is_sound(const Particle& particle)
{
    return particle.position.allFinite() && particle.velocity.allFinite() && particle.mass >= 0 &&
           std::isfinite(particle.mass);
}

} // namespace

Dealt deal_with_scene(std::string_view text, const std::vector<std::string>& overrides)
{
    const auto loaded =
        load_scene({.name = "s.toml", .text = std::string(text), .folder = SLOD_SCENES}, overrides);
    if (const auto* problems = std::get_if<Problems>(&loaded))
        return refused(*problems, "s.toml");
    const std::string said = to_toml(std::get<Scene>(loaded));
    const auto again = load_scene({.name = "again.toml", .text = said, .folder = SLOD_SCENES}, {});
    if (const auto* problems = std::get_if<Problems>(&again))
        return {.taken = true, .wrong = "what the scene says of itself is refused: " + problems->front()};
    if (to_toml(std::get<Scene>(again)) != said)
        return {.taken = true, .wrong = "read back, the scene says something else"};
    return {.taken = true};
}

Dealt deal_with_gadget2(std::string_view bytes)
{
    const auto read = read_gadget2(rewritten("g.gadget2", bytes), {{"halo", 1}, {"disc", 0.5}});
    if (const auto* problems = std::get_if<Problems>(&read))
        return refused(*problems, "g.gadget2");
    const auto& particles = std::get<ParticleSet>(read);
    if (!std::all_of(particles.begin(), particles.end(), is_sound))
        return {.taken = true, .wrong = "a particle is no number"};
    return {.taken = true};
}

Dealt deal_with_input_log(std::string_view text)
{
    const auto read = read_input_log(rewritten("fuzz.log", text));
    if (const auto* problems = std::get_if<Problems>(&read))
        return refused(*problems, "fuzz.log");
    return {.taken = true};
}

} // namespace slod::test
