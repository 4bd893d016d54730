#include "app/job.hpp"

#include <utility>

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include "app/settings_json.hpp"
#include "idl/version.hpp"
#include "scene/content_hash.hpp"
#include "sim/plan.hpp"

namespace slod {
namespace {

/// Loads the header's scene as its settings and the command line's placement say, and its particles from
/// `input`, if that is not empty. Problems name the scene's file as `scene_name`.
std::variant<Job, Problems> load(const std::string& scene_name, const std::filesystem::path& input,
                                 InputLogHeader origin, const CommandLine& line)
{
    std::vector<std::string> overrides = origin.settings;
    overrides.insert(overrides.end(), line.placement.begin(), line.placement.end());
    auto scene =
        load_scene({.name = scene_name, .text = origin.scene_text, .folder = origin.folder}, overrides);
    if (auto* found = std::get_if<Problems>(&scene))
        return std::move(*found);
    auto initial = load_initial(std::get<Scene>(scene), input);
    if (auto* found = std::get_if<Problems>(&initial))
        return std::move(*found);
    return Job{.scene = std::get<Scene>(std::move(scene)),
               .initial = std::get<InitialParticles>(std::move(initial)),
               .origin = std::move(origin),
               .commands = {},
               .expected = {},
               .frames = line.frames};
}

std::variant<Job, Problems> load_new(const CommandLine& line)
{
    auto read = read_scene_text(line.scene);
    if (auto* found = std::get_if<Problems>(&read))
        return std::move(*found);
    auto& scene = std::get<SceneText>(read);
    auto loaded = load(scene.name, line.input,
                       {.version = std::string(version()),
                        .scene_name = line.scene.filename(),
                        .scene_text = std::move(scene.text),
                        .settings = line.settings,
                        .input = {},
                        .initial_source = {},
                        .initial_hash = 0,
                        .folder = std::filesystem::absolute(line.scene).parent_path(),
                        .surfaces_hash = 0},
                       line);
    if (auto* job = std::get_if<Job>(&loaded)) {
        if (!job->initial.file.empty())
            job->origin.input = std::filesystem::absolute(job->initial.file);
        job->origin.initial_source = job->initial.source;
        job->origin.initial_hash = content_hash(job->initial.particles);
        job->origin.surfaces_hash = content_hash(job->scene.simulation.colliders);
    }
    return loaded;
}

/// What keeps a log from being run again.
Problems problems(const std::filesystem::path& file, const InputLog& log)
{
    Problems found;
    if (!log.end)
        found.push_back(file.string() +
                        ": the log has no end; its run was cut short, so there is no outcome to "
                        "compare with");
    else if (log.end->frames == 0)
        found.push_back(file.string() +
                        ": the run was stopped before its first frame; there is nothing to repeat");
    return found;
}

std::variant<Job, Problems> load_replay(const CommandLine& line)
{
    auto read = read_input_log(line.replay);
    if (auto* found = std::get_if<Problems>(&read))
        return std::move(*found);
    const InputLog& log = std::get<InputLog>(read);
    if (Problems found = problems(line.replay, log); !found.empty())
        return found;

    auto loaded = load(log.header.scene_name, log.header.input, log.header, line);
    if (auto* job = std::get_if<Job>(&loaded)) {
        if (content_hash(job->initial.particles) != log.header.initial_hash)
            return Problems{line.replay.string() +
                            ": the particles at the start are not the recorded ones: now " +
                            job->initial.source + ", then " + log.header.initial_source};
        if (content_hash(job->scene.simulation.colliders) != log.header.surfaces_hash)
            return Problems{line.replay.string() +
                            ": the files of its colliders have changed since; get the recorded ones"};
        job->origin.version = version();
        job->commands = log.commands;
        job->expected = log.end;
        job->frames = log.end->frames;
    }
    return loaded;
}

std::string place_text(const Vector3d& x)
{
    return fmt::format("[{:.4g}, {:.4g}, {:.4g}]", x.x(), x.y(), x.z());
}

/// What was read for colliders that are surfaces in files, in the files' own coordinates.
std::vector<std::string> surface_texts(const std::vector<ColliderSettings>& colliders)
{
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < colliders.size(); ++i) {
        if (colliders[i].mesh == nullptr)
            continue;
        const Mesh& mesh = *colliders[i].mesh;
        Vector3d lower = mesh.vertices.front(), upper = lower;
        for (const Vector3d& vertex : mesh.vertices) {
            lower = lower.cwiseMin(vertex);
            upper = upper.cwiseMax(vertex);
        }
        const std::size_t rim = rim_edges(mesh);
        texts.push_back(fmt::format("collider.{}: {} has {} triangles from {} to {}, {}", i,
                                    colliders[i].file, mesh.triangles.size(), place_text(lower),
                                    place_text(upper),
                                    rim == 0 ? "closed" : fmt::format("open along {} edges", rim)));
    }
    return texts;
}

} // namespace

std::variant<Job, Problems> load_job(const CommandLine& line)
{
    return line.replay.empty() ? load_new(line) : load_replay(line);
}

std::string soundness(const Job& job)
{
    std::string text =
        fmt::format("{} is sound: \"{}\", {} particles at the start. {}", job.origin.scene_name,
                    job.scene.title, job.initial.particles.size(), job.initial.source);
    for (const std::string& surface : surface_texts(job.scene.simulation.colliders))
        text += "\n" + surface;
    return text;
}

std::string plan_text(const Job& job)
{
    return explain(compile_plan(job.scene.simulation, job.initial.particles), job.scene.simulation);
}

void log_job(const Job& job)
{
    spdlog::info("scene file={} title=\"{}\" particles={} initial=\"{}\" version={}", job.origin.scene_name,
                 job.scene.title, job.initial.particles.size(), job.initial.source, version());
    for (const std::string& record : settings_records(job.scene))
        spdlog::info(record);
    for (const std::string& surface : surface_texts(job.scene.simulation.colliders))
        spdlog::info(surface);
}

} // namespace slod
