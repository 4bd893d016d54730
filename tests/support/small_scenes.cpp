#include "support/small_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>
#include <stdexcept>

#include "core/parallel.hpp"
#include "sim/simulation.hpp"
#include "support/field_tables.hpp"
#include "support/meshes.hpp"
#include "support/random_draws.hpp"
#include "support/solids.hpp"

namespace slod::test {
namespace {

SmallScene clouds(const std::string& name, Motion motion, double max_cluster_size, std::uint32_t count)
{
    SmallScene scene{name, quiet_settings(), {}};
    scene.settings.motion.motion = motion;
    scene.settings.motion.longest_life = 16;
    scene.settings.background.max_cluster_size = max_cluster_size;
    scene.settings.background.pool_factor = 2;
    scene.settings.gravity.emplace();
    add_cloud(scene.initial, {.count = count, .centre = {-1.5, 0.3, 0}, .velocity = {0.5, 0, 0}}, 1);
    add_cloud(scene.initial, {.count = count, .centre = {1.5, -0.3, 0}, .velocity = {-0.5, 0, 0}}, 2);
    return scene;
}

void add_fields(SimulationSettings& settings)
{
    settings.uniform_gravity = UniformGravitySettings{{0, 0, -9.81}};
    settings.linear_drag = LinearDragSettings{0.2};
    settings.uniform_wind = UniformWindSettings{{1, 0.3, 0}};
}

/// Three jets, one of them leaning and late, and one that throws more in a frame than fits a cluster.
void add_jets(SimulationSettings& settings)
{
    for (const char* name : {"upright", "leaning", "crowded"})
        settings.emitters.push_back(jet(name));
    settings.emitters[1].position = {1, 0, 0};
    settings.emitters[1].direction = {0.3, 0.1, 1};
    settings.emitters[1].start = 0.1;
    settings.emitters[2].position = {-1, 0, 0};
    settings.emitters[2].rate = 1600;
}

SmallScene fountain(const std::string& name, Motion motion)
{
    SmallScene scene{name, quiet_settings(), {}};
    scene.settings.motion.motion = motion;
    scene.settings.background.max_cluster_size = 16;
    scene.settings.background.max_breadth = 0.4;
    add_fields(scene.settings);
    add_jets(scene.settings);
    return scene;
}

/// The rigid fountain, fine where its jets begin and along a plank across them that overlaps that.
SmallScene fountain_of_regions()
{
    SmallScene scene = fountain("regions", Motion::Rigid);
    const RegionOfInterest spring{.name = "spring",
                                  .shape = Shape::Sphere,
                                  .centre = {0, 0, 0.4},
                                  .radius = 0.6,
                                  .partition = {.max_cluster_size = 2, .max_breadth = 0.2}};
    const RegionOfInterest plank{.name = "plank",
                                 .shape = Shape::Box,
                                 .centre = {0, 0, 0.6},
                                 .half_extent = {2, 0.3, 0.2},
                                 .partition = {.max_cluster_size = 6, .max_breadth = 0.3}};
    scene.settings.regions = {spring, plank};
    return scene;
}

/// Everything at once: kinds, masses, births, deaths, uniform fields and self-gravity.
SmallScene mixture()
{
    SmallScene scene = clouds("mixture", Motion::Flow, 16, 800);
    scene.settings.kinds.push_back({"dust", 0.02});
    add_fields(scene.settings);
    add_jets(scene.settings);
    for (EmitterSettings& emitter : scene.settings.emitters)
        emitter.particle_mass = 1e-4;
    scene.settings.emitters[1].kind = "dust";
    return scene;
}

/// A floor, a ball in the first jet's way, a block in the second's, and two balls that touch right above the
/// third one, whose particles are turned back and forth between them.
void add_colliders(SimulationSettings& settings)
{
    const double r = 0.3;
    settings.colliders = {with(plane({0, 0, -0.25}, {0.1, 0, 1}), 0.3, 0.5),
                          with(sphere({0.1, 0, 0.7}, r), 0.8, 0.1),
                          with(box({1.2, 0, 0.6}, {0.2, 0.5, 0.1}), 0.5, 0),
                          with(sphere({-1 - r, 0, 0.4}, r), 1, 0), with(sphere({-1 + r, 0, 0.4}, r), 1, 0)};
    for (std::size_t i = 0; i < settings.colliders.size(); ++i)
        settings.colliders[i].name = "collider" + std::to_string(i);
}

/// A fountain among colliders, and what comes to rest on the floor.
SmallScene obstacles(const std::string& name, Motion motion)
{
    SmallScene scene = fountain(name, motion);
    scene.settings.background.max_breadth = 1;
    add_colliders(scene.settings);
    add_cloud(scene.initial, {.count = 200, .mass = 1e-3, .scale = 0.02}, 3);
    return scene;
}

/// A fountain against two hollow cubes, one that kills and one that moves and holds, and onto hills.
SmallScene meshes()
{
    SmallScene scene = fountain("meshes", Motion::Flow);
    scene.settings.background.max_breadth = 1;
    const auto height = [](std::uint32_t x, std::uint32_t y) { return 0.05 * ((x * 7 + y * 5) % 4); };
    ColliderSettings hills = with(sheet(grid_mesh(25, 25, 0.25, height)), 0.3, 0.5);
    hills.position = {-3, -3, -0.3};
    ColliderSettings cube = with(sheet(box_mesh({0.2, 0.3, 0.1})), 0.8, 0.1), other = cube;
    cube.position = {0.1, 0, 0.7};
    cube.on_hit = OnHit::Kill;
    other.position = {1.2, 0, 0.6};
    other.velocity = {-0.5, 0.1, 0};
    other.on_hit = OnHit::Stick;
    scene.settings.colliders = {hills, cube, other};
    for (std::size_t i = 0; i < scene.settings.colliders.size(); ++i)
        scene.settings.colliders[i].name = "mesh" + std::to_string(i);
    add_cloud(scene.initial, {.count = 200, .mass = 1e-3, .scale = 0.02}, 3);
    return scene;
}

/// A fountain against a hollow ball and onto hills, both from grids of distances.
SmallScene distance_grids()
{
    SmallScene scene = fountain("distance_grids", Motion::Flow);
    scene.settings.background.max_breadth = 1;
    ColliderSettings hills = with(sheet(hilly_grid()), 0.3, 0.5);
    hills.position = {-2, -2, -0.5};
    ColliderSettings pebble = with(turned(sheet(ball_grid(0.2, 0.05)), {20, 30, 40}), 0.8, 0.1);
    pebble.position = {0.1, 0, 0.7};
    scene.settings.colliders = {hills, pebble};
    add_cloud(scene.initial, {.count = 200, .mass = 1e-3, .scale = 0.02}, 3);
    return scene;
}

/// Two clouds that attract each other across a ball between them, a cone and a rod.
SmallScene attracted_obstacles()
{
    SmallScene scene = clouds("attracted_obstacles", Motion::Flow, 16, 500);
    scene.settings.colliders = {with(sphere({0.2, 0, 0}, 0.5), 0.5, 0.2),
                                with(cone({-1.5, 0.3, 0.4}, {0, 0.1, -0.5}, 0.3), 0.9, 0),
                                with(capsule({1, -1, 0}, {1, 1, 0.3}, 0.2), 0, 0)};
    return scene;
}

/// A fountain that every acceleration of place acts on, above and in a cloud.
SmallScene fields()
{
    SmallScene scene = fountain("fields", Motion::Flow);
    scene.settings.motion.longest_life = 16;
    scene.settings.background.max_breadth = 1;
    ForceFields::for_each(
        [&]<class F> { add_element(scene.settings.fields.of<F>(), typename F::Settings{}); });
    add_cloud(scene.initial, {.count = 500}, 4);
    return scene;
}

/// Clouds that attract each other between an attractor and a vortex.
SmallScene attracted_fields()
{
    SmallScene scene = clouds("attracted_fields", Motion::Flow, 16, 500);
    scene.settings.fields.of<Attractor>() = {{.position = {0, 2, 0}, .radius = 3}};
    scene.settings.fields.of<Vortex>() = {{.strength = -0.5}};
    return scene;
}

/// A fountain in every sort of wind that drags by the square of the speed, and in a spring's pull.
SmallScene winds(const std::string& name)
{
    SmallScene scene = fountain(name, Motion::Flow);
    scene.settings.motion.longest_life = 16;
    scene.settings.background.max_breadth = 1;
    scene.settings.quadratic_drag = QuadraticDragSettings{0.3};
    AirFields::for_each([&]<class F> { add_element(scene.settings.fields.of<F>(), typename F::Settings{}); });
    scene.settings.fields.of<Spring>() = {{.stiffness = 2}};
    return scene;
}

SmallScene winds_among_obstacles()
{
    SmallScene scene = winds("winds_among_obstacles");
    scene.settings.fields.of<Spring>().clear();
    add_colliders(scene.settings);
    add_cloud(scene.initial, {.count = 200, .mass = 1e-3, .scale = 0.02}, 3);
    return scene;
}

/// The fountain in gusts that are the same everywhere.
SmallScene gusts()
{
    SmallScene scene = fountain("gusts", Motion::Flow);
    scene.settings.fields.of<Wind>() = {
        {.half_extent = Vector3d::Constant(INFINITY), .gust_amplitude = 0.5, .gust_period = 0.4}};
    return scene;
}

/// The fountain among obstacles with Brownian kicks and a limit below some droplets' speed.
SmallScene kicked()
{
    SmallScene scene = obstacles("kicked", Motion::Flow);
    scene.settings.brownian = BrownianSettings{0.5};
    scene.settings.speed_limit = SpeedLimitSettings{4};
    return scene;
}

/// Emitters of every shape, in bursts and by a schedule, one of them on its way, above a floor that takes
/// what falls on it, beside a box that does, and within a ball whose outside does.
SmallScene sinks()
{
    SmallScene scene = fountain("sinks", Motion::Flow);
    std::vector<EmitterSettings>& emitters = scene.settings.emitters;
    emitters.push_back(jet("hail"));
    emitters[0].shape = EmitterShape::Ring;
    emitters[0].radius = 0.1;
    emitters[0].burst = 50;
    emitters[0].burst_period = 0.25;
    emitters[1].shape = EmitterShape::Disc;
    emitters[1].radius = 0.2;
    emitters[1].inner_radius = 0.1;
    emitters[1].velocity = {0, 2, 0.5};
    emitters[1].inherit = 0.5;
    emitters[1].rate = 0;
    emitters[1].schedule = {{0.05, 300}, {0.2, 0}, {0.3, 1000}};
    emitters[2].shape = EmitterShape::Sphere;
    emitters[2].radius = 0.1;
    emitters[2].fill = Fill::Surface;
    emitters[3].shape = EmitterShape::Box;
    emitters[3].position = {0, 0, 1.2};
    emitters[3].half_extent = {0.5, 0.5, 0};
    emitters[3].direction = {0, 0.3, -1};
    scene.settings.sinks = {
        {.name = "floor", .position = {0, 0, 0.2}, .normal = {0.1, 0, 1}},
        {.name = "drain", .shape = SinkShape::Box, .position = {-1, 0, 0.7}, .half_extent = {0.2, 0.3, 0.1}},
        {.name = "world", .shape = SinkShape::Sphere, .radius = 1.4, .outside = true}};
    return scene;
}

/// Two clouds that attract each other about a ball that swallows what comes into it.
SmallScene attracted_sink()
{
    SmallScene scene = clouds("attracted_sink", Motion::Flow, 16, 800);
    scene.settings.sinks = {
        {.name = "hole", .shape = SinkShape::Sphere, .position = {-1.2, 0.3, 0}, .radius = 0.4}};
    return scene;
}

/// Clusters of particles that attract each other with hardly any softening, in more steps a frame than they
/// are allowed, and one particle that leaves for good.
SmallScene encounters()
{
    SmallScene scene = clouds("encounters", Motion::Flow, 4, 200);
    scene.settings.kinds.front().softening = 1e-3;
    scene.settings.time.max_substeps = 8;
    scene.settings.time.substep_angle = 0.003;
    scene.settings.fields.of<Attractor>().push_back({.strength = 30, .softening = 0.02});
    scene.initial.front().velocity = {1e29, 0, 0};
    return scene;
}

} // namespace

void add_cloud(ParticleSet& particles, const Cloud& cloud, std::uint64_t seed)
{
    for (std::uint32_t i = 0; i < cloud.count; ++i) {
        Random random(seed, 0, i);
        // The mass within r is (r / sqrt(r^2 + scale^2))^3, and the largest of three uniform numbers is
        // distributed like the cube root of one. Cut off at five scale lengths.
        const double s = 0.98 * std::max({random.uniform(), random.uniform(), random.uniform()});
        const double r = cloud.scale * s / std::sqrt(1 - s * s);
        // The one-dimensional velocity dispersion there.
        const double sigma = std::sqrt(cloud.mass / (6 * std::sqrt(r * r + cloud.scale * cloud.scale)));
        Particle particle;
        particle.position = cloud.centre + r * random_direction(random);
        for (int axis = 0; axis < 3; ++axis)
            particle.velocity[axis] = cloud.velocity[axis] + sigma * random_normal(random);
        particle.id = particles.size();
        particle.mass = float(cloud.mass / cloud.count);
        particle.kind = cloud.kind;
        particles.push_back(particle);
    }
}

SimulationSettings quiet_settings()
{
    SimulationSettings settings;
    settings.units.mass_kg = 1 / 6.67430e-11;
    settings.time.step = 0.015625;
    settings.kinds = {{"star", 0.05}};
    return settings;
}

EmitterSettings jet(const std::string& name)
{
    EmitterSettings emitter;
    emitter.name = name;
    emitter.kind = "star";
    emitter.speed = 4;
    emitter.speed_spread = 0.1;
    emitter.cone_angle_deg = 10;
    emitter.rate = 640;
    emitter.lifetime = 0.5;
    return emitter;
}

void PrintTo(const SmallScene& scene, std::ostream* out)
{
    *out << scene.name;
}

std::vector<SmallScene> small_scenes()
{
    std::vector<SmallScene> scenes;
    scenes.push_back(clouds("flow", Motion::Flow, 16, 2000));
    scenes.push_back(clouds("flow_in_double", Motion::Flow, 16, 1000));
    scenes.back().settings.gravity->precision = Precision::Double;
    scenes.push_back(clouds("stream", Motion::Stream, 16, 2000));
    scenes.push_back(clouds("rigid", Motion::Rigid, 16, 2000));
    scenes.back().settings.background.max_breadth = 1;
    scenes.push_back(clouds("unclustered", Motion::Flow, 1, 500));
    scenes.push_back(clouds("walk", Motion::Flow, 8, 2000));
    scenes.back().settings.gravity->direct_below = 0;
    scenes.back().settings.gravity->multipoles = Multipoles::Monopole;
    scenes.push_back(clouds("walk_with_quadrupoles", Motion::Flow, 8, 2000));
    scenes.back().settings.gravity->direct_below = 0;
    scenes.back().settings.gravity->multipoles = Multipoles::Quadrupole;
    scenes.push_back(fountain("fountain", Motion::Flow));
    scenes.push_back(fountain("full_fountain", Motion::Flow));
    scenes.back().settings.limits.max_particles = 300;
    scenes.push_back(fountain("rigid_fountain", Motion::Rigid));
    scenes.push_back(fountain_of_regions());
    scenes.push_back(mixture());
    scenes.push_back(obstacles("obstacles", Motion::Flow));
    scenes.push_back(obstacles("rigid_obstacles", Motion::Rigid));
    scenes.push_back(attracted_obstacles());
    scenes.push_back(meshes());
    scenes.push_back(distance_grids());
    scenes.push_back(fields());
    scenes.push_back(attracted_fields());
    scenes.push_back(winds("winds"));
    scenes.push_back(winds_among_obstacles());
    scenes.push_back(gusts());
    scenes.push_back(kicked());
    scenes.push_back(sinks());
    scenes.push_back(attracted_sink());
    scenes.push_back(encounters());
    return scenes;
}

SmallScene small_scene(const std::string& name)
{
    for (const SmallScene& scene : small_scenes())
        if (scene.name == name)
            return scene;
    throw std::invalid_argument("no small scene " + name);
}

std::uint64_t hash_of(const SmallScene& scene, int threads, int frames)
{
    std::uint64_t hash = 0;
    ThreadTeam(threads).run([&] {
        Simulation simulation(scene.settings, scene.initial, {});
        for (int frame = 0; frame < frames; ++frame)
            simulation.step({});
        if (const Problems problems = simulation.problems(); !problems.empty())
            throw std::logic_error(scene.name + ": " + problems.front());
        hash = simulation.state_hash();
    });
    return hash;
}

} // namespace slod::test
