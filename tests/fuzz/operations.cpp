#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "app/command_desk.hpp"
#include "fuzz/byte_reader.hpp"
#include "fuzz/inputs.hpp"
#include "scene/scene.hpp"

namespace slod::test {
namespace {

constexpr int most_operations = 200; ///< of one input; what follows is not looked at

/// The fountain with some 200 droplets: in exact flow, about an attractor, where clusters live by the clock,
/// or in rigid motion at the first particle's velocity.
Simulation small_world(ByteReader& bytes)
{
    const auto fountain = [](std::vector<std::string> overrides) {
        overrides.insert(overrides.end(), {"emitter.0.rate=2000", "emitter.0.lifetime=0.1"});
        const auto loaded = load_scene(std::filesystem::path(SLOD_SCENES) / "fountain.toml", overrides);
        return std::get<Scene>(loaded).simulation;
    };
    static const std::array worlds{
        fountain({}),
        fountain({"attractor=[{strength=1}]", "motion.shortest_life=4", "motion.longest_life=4"}),
        fountain({"motion.kind=rigid", "background.cluster_velocity=first"})};
    return {bytes.one_of(worlds), {}, {}};
}

std::string one_region(ByteReader& bytes)
{
    constexpr std::array<std::string_view, 6> names{"spring", "plank", "r1", "r2", "background", ""};
    return bytes.below(8) == 0 ? bytes.text() : std::string(bytes.one_of(names));
}

/// A value as a client may write it.
std::string one_value(ByteReader& bytes)
{
    constexpr std::array<std::string_view, 14> values{
        "4",       "0.5",    "-1",        "1e300",  "nan",     "inf",        "true",
        "\"box\"", "sphere", "[0, 1, 2]", "[0, 0]", "frustum", "\"smooth\"", ""};
    return bytes.below(4) == 0 ? bytes.text() : std::string(bytes.one_of(values));
}

Request one_request(ByteReader& bytes, std::uint64_t number)
{
    constexpr std::array<std::string_view, 12> kinds{"set",     "add_roi",    "move_roi",   "resize_roi",
                                                     "set_roi", "remove_roi", "keep_alive", "checkpoint",
                                                     "step",    "pause",      "resume",     "stop"};
    constexpr std::array<std::string_view, 19> keys{"max_cluster_size",
                                                    "max_breadth",
                                                    "shape",
                                                    "centre",
                                                    "radius",
                                                    "precedence",
                                                    "bin_by",
                                                    "follows",
                                                    "least_mass",
                                                    "pool_factor",
                                                    "control.mode",
                                                    "background.max_breadth",
                                                    "effects.uniform_gravity",
                                                    "linear_drag.rate",
                                                    "attractor.0.strength",
                                                    "attractor.1.position",
                                                    "collider.0.shape",
                                                    "sink.0.radius",
                                                    "emitter.0.rate"};
    Request request{.client = {std::uint8_t(1 + bytes.below(3))}, .number = number, .kind = {}};
    request.kind = bytes.below(16) == 0 ? bytes.text() : std::string(bytes.one_of(kinds));
    request.region = one_region(bytes);
    const std::size_t flags = bytes.byte();
    if ((flags & 1) != 0)
        request.number -= bytes.below(8);
    if ((flags & 2) != 0)
        request.if_revision = bytes.below(16);
    if ((flags & 4) != 0)
        request.lease_s = bytes.number();
    if ((flags & 8) != 0)
        request.centre = bytes.vector();
    if ((flags & 16) != 0)
        request.half_extent = bytes.vector();
    if ((flags & 32) != 0)
        request.radius = bytes.number();
    request.frames = std::uint32_t(bytes.below(4));
    for (std::size_t left = bytes.below(4); left > 0; --left) {
        std::string key = bytes.below(16) == 0 ? bytes.text() : std::string(bytes.one_of(keys));
        request.settings.push_back({.key = std::move(key), .value = one_value(bytes)});
    }
    return request;
}

ClientView one_view(ByteReader& bytes)
{
    ClientView view{.client = {std::uint8_t(1 + bytes.below(3))}, .client_name = bytes.text()};
    view.eye = bytes.vector();
    view.look_at = bytes.vector();
    view.up = bytes.vector();
    view.field_of_view_deg = bytes.number();
    view.aspect = bytes.number();
    return view;
}

RegionSettings one_partition(ByteReader& bytes)
{
    RegionSettings partition;
    partition.max_cluster_size = bytes.number();
    partition.max_breadth = bytes.number();
    partition.pool_factor = bytes.number();
    partition.bin_by = BinBy(bytes.below(names(BinBy{}).size()));
    partition.cluster_velocity = ClusterVelocity(bytes.below(names(ClusterVelocity{}).size()));
    return partition;
}

RegionOfInterest one_shape(ByteReader& bytes, std::string name)
{
    RegionOfInterest region;
    region.name = std::move(name);
    region.precedence = std::int64_t(bytes.below(5)) - 2;
    region.shape = Shape(bytes.below(names(Shape{}).size()));
    region.centre = bytes.vector();
    region.half_extent = bytes.vector();
    region.radius = bytes.number();
    region.direction = bytes.vector();
    region.up = bytes.vector();
    region.field_of_view_deg = bytes.number();
    region.far_distance = bytes.number();
    if (bytes.below(4) == 0)
        region.most_speed = bytes.number();
    region.partition = one_partition(bytes);
    return region;
}

Detail one_detail(ByteReader& bytes)
{
    const auto factor = [&] { return std::exp2(int(bytes.below(33)) / 4.0 - 4); };
    Detail detail{.cluster_size = factor(), .breadth = factor(), .opening = factor(), .life = factor()};
    detail.dithered = bytes.below(2) == 1;
    return detail;
}

/// The first problem, with what it came after.
std::string told(const Problems& problems, std::string_view after)
{
    return problems.empty() ? std::string() : "after " + std::string(after) + ": " + problems.front();
}

} // namespace

Dealt deal_with_commands(std::string_view input)
{
    ByteReader bytes(input);
    Simulation simulation = small_world(bytes);
    CommandDesk desk(simulation, {.max_clients = 2});
    Dealt dealt;
    std::uint64_t frame = 1;
    CommandDesk::Clock::time_point now{}; // a second for each frame
    for (std::uint64_t number = 9; number < 9 + most_operations && !bytes.at_end(); ++number) {
        const std::size_t what = bytes.below(8);
        if (what == 0) {
            desk.see(one_view(bytes), now);
        } else if (what == 1) {
            desk.expire_leases(frame, now);
            desk.follow_views(frame);
            simulation.step({});
            ++frame;
            now += std::chrono::seconds(1);
        } else {
            const Request request = one_request(bytes, number);
            const Answer answer = desk.handle(request, frame, now);
            dealt.taken |= answer.result == slod_v1_RESULT_APPLIED;
            if (answer.result != slod_v1_RESULT_APPLIED && answer.text.empty())
                dealt.wrong = "refused without a reason: " + request.kind;
            if (answer.client != request.client || answer.number != request.number)
                dealt.wrong = "answered to somebody else: " + request.kind;
        }
    }
    simulation.step({});
    if (dealt.wrong.empty())
        dealt.wrong = told(simulation.problems(), "all commands");
    return dealt;
}

Dealt deal_with_regions(std::string_view input)
{
    ByteReader bytes(input);
    Simulation simulation = small_world(bytes);
    SceneEditor editor(simulation);
    Dealt dealt;
    std::uint64_t frame = 1;
    for (int count = 0; count < most_operations && !bytes.at_end() && dealt.wrong.empty(); ++count) {
        const std::size_t what = bytes.below(8);
        const std::string name = one_region(bytes);
        const bool known = editor.find(name) != nullptr;
        if (what < 3) {
            simulation.step({});
            dealt.wrong = told(simulation.problems(), "frame " + std::to_string(frame++));
        } else if (what == 3) {
            dealt.taken |= editor.add(one_shape(bytes, name), {}, 0, frame).empty();
        } else if (what == 4) {
            dealt.taken |= known && editor.change(one_shape(bytes, name), frame).empty();
        } else if (what == 5) {
            RegionOfInterest region = known ? editor.find(name)->settings : RegionOfInterest{};
            region.centre = bytes.vector();
            region.partition = one_partition(bytes);
            dealt.taken |= known && editor.change(region, frame).empty();
        } else if (what == 6) {
            dealt.taken |= known && editor.remove(name, frame).empty();
        } else {
            dealt.taken |= editor.set_detail(one_detail(bytes), frame);
        }
    }
    simulation.step({});
    if (dealt.wrong.empty())
        dealt.wrong = told(simulation.problems(), "all operations");
    return dealt;
}

} // namespace slod::test
