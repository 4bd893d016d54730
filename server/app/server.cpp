#include "app/server.hpp"

#include <algorithm>
#include <chrono>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include <spdlog/spdlog.h>

#include "app/pacer.hpp"
#include "app/version.hpp"

namespace slod {
namespace {

using Clock = Pacer::Clock;

double milliseconds(Clock::duration duration)
{
    return std::chrono::duration<double, std::milli>(duration).count();
}

int thread_count(const ServerSettings& settings)
{
    return int(settings.threads > 0 ? settings.threads : std::max(std::thread::hardware_concurrency(), 1U));
}

Simulation::Options options(const ServerSettings& settings)
{
    const bool any = settings.isa == "auto";
    return {.isa = any ? std::string_view() : settings.isa,
            .tick = [] { return std::chrono::nanoseconds(Clock::now().time_since_epoch()).count(); }};
}

} // namespace

Server::Server(const Scene& scene, ParticleSet initial, Pace pace, EachSecond each_second)
    : pace_(pace), frame_rate_hz_(scene.server.frame_rate),
      frame_s_(scene.simulation.time.step * scene.simulation.units.time_s),
      each_second_(std::move(each_second)), threads_(thread_count(scene.server)), team_(threads_)
{
    const std::uint64_t particles = initial.size();
    team_.run([&] { simulation_.emplace(scene.simulation, initial, options(scene.server)); });
    if (scene.wire.enabled)
        publisher_.emplace(scene.wire, Publisher::Session{.scene_title = scene.title,
                                                          .units = scene.simulation.units,
                                                          .time_step = scene.simulation.time.step,
                                                          .particles = particles,
                                                          .threads = threads_,
                                                          .isa = std::string(simulation_->isa()),
                                                          .version = std::string(version())});
}

RunSummary Server::run(const std::stop_token& stop)
{
    RunSummary summary;
    summary.conserved_start = measure_conserved();
    const Clock::time_point start = Clock::now();
    spdlog::info("started threads={} isa={} wire={}", threads_, simulation_->isa(), publisher_.has_value());

    Pacer pacer(frame_rate_hz_, start);
    LoopMeter meter(frame_s_, start);
    const auto ended = [&] {
        return stop.stop_requested() || (pace_.frames > 0 && summary.frames == pace_.frames);
    };
    while (!ended()) {
        run_frame(meter, summary);
        if (!pace_.free_run && !ended())
            sleep_until(pacer.next(Clock::now()), stop);
    }

    summary.wall_s = std::chrono::duration<double>(Clock::now() - start).count();
    summary.conserved_end = measure_conserved();
    summary.state_hash = simulation_->state_hash();
    spdlog::info("stopped frames={} time={:.6g} wall_s={:.3f} interrupted={}", summary.frames, summary.time,
                 summary.wall_s, stop.stop_requested());
    return summary;
}

void Server::run_frame(LoopMeter& meter, RunSummary& summary)
{
    const Clock::time_point begin = Clock::now();
    const bool wanted = publisher_ && publisher_->clusters_wanted();
    const Simulation::Request request{.clusters = wanted, .conserved = wanted || (publisher_ && new_second_)};
    const Snapshot* snapshot = nullptr;
    team_.run([&] { snapshot = &simulation_->step(request); });
    if (publisher_) {
        const LoopMeans& means = meter.means();
        publisher_->offer(*snapshot, {.frame_rate_hz = means.frame_rate_hz,
                                      .work_ms = means.work_ms,
                                      .real_time_factor = means.real_time_factor});
    }
    const Clock::time_point end = Clock::now();
    const double work_ms = milliseconds(end - begin);
    summary.add(*snapshot, work_ms);
    new_second_ = meter.add(end, work_ms, snapshot->profile);
    if (new_second_)
        each_second_(*snapshot, meter.means(), simulation_->plan());
}

ConservedQuantities Server::measure_conserved()
{
    ConservedQuantities measured;
    team_.run([&] { measured = simulation_->snapshot({.conserved = true}).conserved; });
    return measured;
}

} // namespace slod
