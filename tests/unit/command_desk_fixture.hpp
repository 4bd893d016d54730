#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include <gtest/gtest.h>

#include "app/command_desk.hpp"
#include "core/parallel.hpp"

namespace slod {

inline constexpr wire::Uuid alice{1}, bob{2};
inline constexpr std::uint64_t frame = 12;

inline SimulationSettings settings()
{
    SimulationSettings scene;
    scene.kinds.push_back({.name = "dust", .softening = 0.1});
    scene.gravity.emplace();
    scene.background.max_breadth = 1;
    return scene;
}

inline ParticleSet cube()
{
    ParticleSet particles;
    for (std::uint64_t id = 0; id < 8; ++id)
        particles.push_back({.position = {double(id & 1), double(id >> 1 & 1), double(id >> 2)},
                             .velocity = {0, 0, 0},
                             .id = id,
                             .mass = 1});
    return particles;
}

/// The desk over a simulation of eight particles.
class Desk : public testing::Test {
protected:
    Answer ask(const Request& request) { return desk.handle(request, frame, now); }

    /// A new request of a client.
    Request request(const std::string& kind, const std::string& region = {}, const wire::Uuid& client = alice)
    {
        return {.client = client, .number = ++number, .kind = kind, .region = region};
    }

    Request add(const std::string& region, const wire::Uuid& client = alice, double lease_s = 0)
    {
        Request adding = request("add_roi", region, client);
        adding.half_extent = {1, 1, 1};
        adding.lease_s = lease_s;
        adding.settings = {{"shape", "box"}};
        return adding;
    }

    Request move(const std::string& region, const Vector3d& centre, const wire::Uuid& client = alice)
    {
        Request moving = request("move_roi", region, client);
        moving.centre = centre;
        return moving;
    }

    /// One view before the next frame.
    void show(const ClientView& view)
    {
        desk.see(view, now);
        desk.follow_views(frame);
    }

    const RegionOfInterest* region(const std::string& name)
    {
        const RegionRecord* const record = desk.editor().find(name);
        return record ? &record->settings : nullptr;
    }

    ThreadTeam team{1};
    Simulation simulation{settings(), cube(), {}};
    CommandDesk desk{simulation, {.max_clients = 4}};
    CommandDesk::Clock::time_point now{std::chrono::hours(1)};
    std::uint64_t number = 0;
};

} // namespace slod
