#include "scene_contents.hpp"
#include "scene_support.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "core/random.hpp"
#include "scene/scene_check.hpp"
#include "scene/value_text.hpp"

namespace slod::test {

namespace {

/// Gives every field some value that it may have.
class Scrambler {
public:
    explicit Scrambler(std::uint64_t seed) : random_(seed, 0, 0) {}

    void operator()(const Field&, bool& value) { value = random_.bits() % 2 == 0; }
    void operator()(const Field&, std::string& value)
    {
        constexpr std::string_view letters = "ab \"\\'#=[]{}\n\t\x01\x7f";
        value.clear();
        for (std::uint32_t length = random_.bits() % 12; length > 0; --length)
            value += letters[random_.bits() % letters.size()];
        value += random_.bits() % 2 == 0 ? "\xc3\xa4" : ""; // a letter of two bytes
    }
    void operator()(const Field& field, double& value)
    {
        const Range range = range_of<double>(field);
        const bool infinite = field.infinity_allowed && random_.bits() % 4 == 0;
        value = infinite ? std::numeric_limits<double>::infinity() : number_in(range);
    }
    void operator()(const Field& field, Vector3d& value)
    {
        for (double& component : value)
            component = number_in(range_of<double>(field));
    }
    void operator()(const Field& field, NumberPairs& value)
    {
        const Range range = range_of<double>(field);
        value.clear();
        for (std::uint32_t length = below(4); length > 0; --length)
            value.push_back({number_in(range), number_in(range)});
    }
    template <std::integral T>
    void operator()(const Field& field, T& value)
    {
        const Range range = range_of<T>(field);
        value = T(range.minimum + std::floor(random_.uniform() * (range.maximum - range.minimum + 1)));
    }
    template <class E>
    requires std::is_enum_v<E>
    void operator()(const Field&, E& value) { value = E(random_.bits() % names(value).size()); }

    std::uint32_t below(std::uint32_t limit) { return random_.bits() % limit; }

private:
    /// Any double of the range, of any magnitude; sometimes a whole number or a bound.
    double number_in(const Range& range)
    {
        for (int attempt = 0; attempt < 1000; ++attempt) {
            const std::uint64_t high = random_.bits();
            double value = std::bit_cast<double>(high << 32 | random_.bits());
            if (random_.bits() % 4 == 0)
                value = std::floor(random_.uniform() * 1e21 / double(1 + random_.bits()));
            if (std::isfinite(value) && range.contains(value))
                return value;
        }
        return range.minimum;
    }

    Random random_;
};

/// Makes a range of two random numbers one that holds something.
void put_in_order(double& least, double& most)
{
    if (least > most)
        std::swap(least, most);
    if (least == most)
        most = std::numeric_limits<double>::infinity();
}

/// Makes an emitter of random values one that makes sense, of its shape.
void mend(EmitterSettings& emitter)
{
    const double size = emitter.radius + 1;
    const bool round = emitter.shape != EmitterShape::Point && emitter.shape != EmitterShape::Box;
    emitter.radius = round ? size : 0;
    emitter.inner_radius = emitter.shape == EmitterShape::Disc ? 0.5 * size : 0;
    emitter.half_extent = emitter.shape == EmitterShape::Box ? Vector3d(size, 1, 0.1) : Vector3d(0, -0.0, 0);
    if (emitter.shape != EmitterShape::Box && emitter.shape != EmitterShape::Sphere)
        emitter.fill = Fill::Volume;
    std::sort(emitter.schedule.begin(), emitter.schedule.end());
    const auto same_time = [](const auto& a, const auto& b) { return a.front() == b.front(); };
    emitter.schedule.erase(std::unique(emitter.schedule.begin(), emitter.schedule.end(), same_time),
                           emitter.schedule.end());
    if (!emitter.schedule.empty())
        emitter.rate = 0;
    ++emitter.burst;
    emitter.direction = {-0.0, -0.0, 1};
    put_in_order(emitter.start, emitter.stop);
}

/// Likewise a sink.
void mend(SinkSettings& sink)
{
    const double size = sink.radius + 1;
    sink.radius = sink.shape == SinkShape::Sphere ? size : 0;
    sink.half_extent = sink.shape == SinkShape::Box ? Vector3d(size, 1, 0.1) : Vector3d(0, -0.0, 0);
    sink.normal = {0, 0, 1};
    sink.outside = sink.outside && sink.shape != SinkShape::Plane;
}

/// Likewise a collider, of a shape without a file, as there is none of that name.
void mend(ColliderSettings& collider)
{
    using enum ColliderShape;
    const ColliderSettings defaults;
    if (collider.shape == Mesh || collider.shape == Heightfield || collider.shape == DistanceGrid)
        collider.shape = Plane;
    const bool has_axis = collider.shape == Cone || collider.shape == Capsule;
    const bool round = has_axis || collider.shape == Sphere;
    collider.normal = collider.shape == Plane ? Vector3d(0, -0.0, 1) : defaults.normal;
    collider.radius = round ? collider.radius + 1 : defaults.radius;
    collider.half_extent =
        collider.shape == Box ? Vector3d(collider.half_extent.array() + 1) : defaults.half_extent;
    collider.axis = has_axis ? Vector3d(0, 1e-30, -2) : defaults.axis;
    if (collider.shape != Box)
        collider.rotation = defaults.rotation;
    collider.file.clear();
    collider.scale = defaults.scale;
    collider.spacing = defaults.spacing;
    collider.thickness = defaults.thickness;
}

/// A scene of random values that has no problems.
Scene random_scene(std::uint64_t seed)
{
    Scrambler scrambler(seed);
    Scene scene;
    for_each_section(scene, [&]<class Settings>(const Section& section, Settings& settings) {
        if constexpr (requires { settings.at(0); }) {
            settings.resize(section.name == "kind" ? 3 : scrambler.below(4));
            for (std::size_t i = 0; i < settings.size(); ++i) {
                for_each_field(settings[i], scrambler);
                if constexpr (requires { settings[i].name; })
                    settings[i].name = std::string(section.name) + "-" + std::to_string(i);
            }
        } else if constexpr (requires { settings.value(); }) {
            if (scrambler.below(2) == 0)
                for_each_field(settings.emplace(), scrambler);
        } else {
            for_each_field(settings, scrambler);
        }
    });
    // What the fields together must satisfy.
    SimulationSettings& simulation = scene.simulation;
    if (simulation.units.gravitational_constant() > 1e30)
        simulation.units.length_m = 1e30; // with the largest of the other units it is 7e19
    for (EmitterSettings& emitter : simulation.emitters) {
        emitter.kind = simulation.kinds[scrambler.below(3)].name;
        mend(emitter);
    }
    for (SinkSettings& sink : simulation.sinks)
        mend(sink);
    for (ColliderSettings& collider : simulation.colliders)
        mend(collider);
    simulation.sharing.overlap = true;
    for (RegionOfInterest& region : simulation.regions) {
        region.direction = {0, 0.5, -1};
        region.follows = "viewer";
        region.up = {0, 3, 0};
        put_in_order(region.near_distance, region.far_distance);
        put_in_order(region.least_mass, region.most_mass);
        put_in_order(region.least_speed, region.most_speed);
        put_in_order(region.least_acceleration, region.most_acceleration);
    }
    simulation.motion.shortest_life = 1U << scrambler.below(6);
    simulation.motion.longest_life = simulation.motion.shortest_life << scrambler.below(6);
    for_each_field_table(simulation.fields, [&]<class F>(typename F::Table& table) {
        const auto faulty = [&](const auto& each) {
            return !F::problems(each, simulation.time.step).empty();
        };
        if constexpr (requires { table.begin(); })
            std::erase_if(table, faulty);
        else if (table && faulty(*table))
            table.reset();
    });
    if (simulation.gravity && !problems(*simulation.gravity).empty()) // accuracy beside what it chooses
        simulation.gravity->accuracy = 0;
    if (auto& springs = simulation.fields.of<Spring>(); springs.size() > 1)
        springs.resize(1); // together they may be too stiff
    bool winds = simulation.uniform_wind.has_value();
    AirFields::for_each([&]<class F> { winds = winds || !elements(simulation.fields.of<F>()).empty(); });
    if (winds) {
        simulation.linear_drag.emplace();
        simulation.effects.on[effect_row("linear_drag")] = true;
    }
    if (simulation.motion.motion != Motion::Rigid) {
        simulation.motion.merged_velocities = MergedVelocities::Keep;
        simulation.motion.build_respects_limits = false;
    }
    std::tie(scene.loop.control.smallest_cluster_size, scene.loop.control.largest_cluster_size) =
        std::minmax({scene.loop.control.smallest_cluster_size, scene.loop.control.largest_cluster_size});
    for_each_effect(simulation, [&](std::string_view name, const auto& table) {
        if (!named(table))
            simulation.effects.on[effect_row(name)] = true;
    });
    const auto not_together = [](const std::string& problem) {
        return problem.starts_with("time.max_substeps");
    };
    if (const Problems found = problems(simulation); std::any_of(found.begin(), found.end(), not_together))
        simulation.time.max_substeps = 1;
    constexpr double any = std::numeric_limits<double>::infinity();
    if (AlarmSettings& alarms = scene.loop.alarms; !problems(alarms, simulation).empty())
        alarms.energy_drift = alarms.momentum_drift = alarms.angular_momentum_drift = any;
    scene.loop.meter.enabled = scene.loop.meter.enabled || scene.loop.control.mode == ControlMode::Error;
    scene.loop.server.isa = InstructionSet(scrambler.below(2)); // the others do not run everywhere
    scene.initial.model = scrambler.below(2) == 0 ? InitialModel::None : InitialModel::Gadget2;
    scene.initial.fallback = InitialModel::None;
    if (scene.initial.model == InitialModel::None)
        simulation.background.max_breadth = 3;
    return scene;
}

TEST(SceneText, EveryRandomSceneComesBackTheSame)
{
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        SCOPED_TRACE(seed);
        const Scene scene = random_scene(seed);
        ASSERT_TRUE(problems(scene).empty()) << problems(scene).front();
        ASSERT_EQ(contents(scene_of(to_toml(scene))), contents(scene)) << to_toml(scene);
    }
}

TEST(SceneText, HasOneLinePerKey)
{
    Scene scene = scene_of(minimal_scene);
    scene.title = "two\nlines";
    const std::string text = to_toml(scene);
    EXPECT_NE(text.find("title = \"two\\u000Alines\"\n"), std::string::npos) << text;
    EXPECT_NE(text.find("\n[[kind]]\nname = \"star\"\nsoftening = 0.0\n"), std::string::npos) << text;
    EXPECT_EQ(text.find("[gravity]"), std::string::npos) << "an absent effect is not written";
}

TEST(SceneReference, HasEveryKeyWithUnitDefaultRangeAndHelp)
{
    const std::string reference = scene_reference();
    std::istringstream stream(reference);
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);)
        lines.push_back(line);

    Scene scene;
    const auto look_for = [&](auto& settings) {
        for_each_field(settings, [&]<class T>(const Field& field, const T& value) {
            // The columns are in this order, so one search after the other finds them.
            const auto says_all = [&](const std::string& line) {
                std::size_t at = 0;
                for (const std::string& part :
                     {"  " + std::string(field.key) + " ", std::string(field.unit), value_text(value),
                      choice_text<T>(field), std::string(field.help)}) {
                    at = line.find(part, at);
                    if (at == std::string::npos)
                        return false;
                    at += part.size();
                }
                return true;
            };
            EXPECT_TRUE(std::any_of(lines.begin(), lines.end(), says_all)) << field.key << " in:\n"
                                                                           << reference;
        });
    };
    for_each_section(scene, [&]<class Settings>(const Section& section, Settings& settings) {
        EXPECT_NE(reference.find(section.help), std::string::npos) << section.name;
        if constexpr (requires { typename Settings::value_type; }) { // an array of tables, or a table if any
            typename Settings::value_type defaults{};
            look_for(defaults);
        } else {
            look_for(settings);
        }
    });
}

TEST(SceneReference, IsAligned)
{
    // The default of each key starts in the column of the heading "default".
    const std::string reference = scene_reference();
    const auto column = reference.find("default");
    std::istringstream stream(reference);
    int checked = 0;
    for (std::string line; std::getline(stream, line);)
        if (line.starts_with("  ") && line.size() > column) {
            EXPECT_EQ(line[column - 1], ' ') << line;
            EXPECT_NE(line[column], ' ') << line;
            ++checked;
        }
    EXPECT_GT(checked, 60);
}

TEST(NumberText, IsTheShortestThatReadsBack)
{
    EXPECT_EQ(number_text(0.1), "0.1");
    EXPECT_EQ(number_text(64), "64");
    EXPECT_EQ(number_text(1.0 / 3), "0.3333333333333333");
    EXPECT_EQ(float_text(64), "64.0");
    EXPECT_EQ(float_text(0x1p70), "1180591620717411303424.0") << "no integer of TOML's";
    EXPECT_EQ(float_text(-std::numeric_limits<double>::infinity()), "-inf");
}

TEST(ChoiceText, OfAVectorHasTheRangeOfItsComponentsIfThereIsOne)
{
    EXPECT_EQ(choice_text<Vector3d>(Field{"a", "", "", -2, 30}), "3 numbers, each -2 to 30");
    EXPECT_EQ(choice_text<Vector3d>(Field{"a", "", "", 0}), "3 numbers, each at least 0");
    EXPECT_EQ(choice_text<Vector3d>(Field{"a", "", ""}), "3 numbers");
}

TEST(RangeText, SaysWhatIsBounded)
{
    const double infinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(range_text({0.5, 100e6}, false), "0.5 to 100000000");
    EXPECT_EQ(range_text({0, infinity}, true), "at least 0, or inf");
    EXPECT_EQ(range_text({-infinity, 1e30}, false), "at most 1e+30");
    EXPECT_EQ(range_text({-infinity, infinity}, false), "any finite number");
}

} // namespace

} // namespace slod::test
