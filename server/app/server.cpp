#include "app/server.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <map>
#include <string>
#include <thread>
#include <utility>

#include <spdlog/spdlog.h>

#include "app/pacer.hpp"
#include "idl/version.hpp"

namespace slod {
namespace {

using Clock = Pacer::Clock;

/// While the loop waits it looks so often for commands.
constexpr std::chrono::milliseconds command_period{10};

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
    return {.isa = names(settings.isa)[std::size_t(settings.isa)],
            .tick = [] { return std::chrono::nanoseconds(Clock::now().time_since_epoch()).count(); }};
}

} // namespace

Server::Server(Job& job, bool free_run, Listeners listeners)
    : frames_(job.frames), free_run_(free_run),
      frame_s_(job.scene.simulation.time.step * job.scene.simulation.units.time_s),
      each_second_(std::move(listeners.each_second)), each_frame_(std::move(listeners.each_frame)),
      threads_(thread_count(job.scene.loop.server)), team_(threads_)
{
    const Scene& scene = job.scene;
    const ParticleSet initial = std::move(job.initial.particles);
    team_.run([&] { simulation_.emplace(scene.simulation, initial, options(scene.loop.server)); });
    if (scene.wire.enabled)
        publisher_.emplace(scene.wire, Publisher::Session{.scene_title = scene.title,
                                                          .units = scene.simulation.units,
                                                          .time_step = scene.simulation.time.step,
                                                          .particles = initial.size(),
                                                          .threads = threads_,
                                                          .isa = std::string(simulation_->isa()),
                                                          .version = std::string(version())});
    steering_.emplace(*simulation_, publisher_ ? &*publisher_ : nullptr,
                      Steering::Options{.wire = scene.wire,
                                        .loop = scene.loop,
                                        .replay = job.commands,
                                        .replaying = job.expected.has_value(),
                                        .paced = !free_run_,
                                        .record = std::move(listeners.record)});
}

RunSummary Server::run(const std::stop_token& stop)
{
    RunSummary summary;
    const Alarms::Start at_start = measure_conserved();
    summary.conserved_start = at_start.conserved;
    alarms_.emplace(at_start);
    for (const std::string_view name : alarms_->unwatched(steering_->loop().alarms))
        spdlog::warn("alarms.{} is not watched: nothing is known of it in this scene", name);
    start_ = Clock::now();
    const std::clock_t processor_start = std::clock();
    spdlog::info("started threads={} isa={} wire={}", threads_, simulation_->isa(), publisher_.has_value());

    Pacer pacer(steering_->loop().server.frame_rate, start_);
    LoopMeter meter(frame_s_, start_);
    steering_->prepare(1, team_);
    while (!ended(summary, stop)) {
        if (steering_->control().may_run()) {
            steering_->follow_views(summary.frames + 1, team_);
            steering_->regulate(summary.frames + 1, team_);
            run_frame(meter, summary);
            steering_->control().count_frame();
        }
        wait_for_frame(pacer, meter, summary, stop);
    }
    steering_->repeat_rest(summary.frames + 1, team_);

    summary.wall_s = std::chrono::duration<double>(Clock::now() - start_).count();
    summary.processor_s = double(std::clock() - processor_start) / CLOCKS_PER_SEC;
    const Alarms::Start at_end = measure_conserved();
    summary.conserved_end = at_end.conserved;
    alarms_->look_at_end(at_end, steering_->loop().alarms, steering_->regulation());
    log_alarms();
    log_quarantined();
    summary.alarms = alarms_->past();
    summary.alarms.insert(summary.alarms.end(), logged_alarms_.begin(), logged_alarms_.end());
    summary.state_hash = simulation_->state_hash();
    summary.error = simulation_->error();
    spdlog::info("stopped frames={} time={:.6g} wall_s={:.3f} interrupted={}", summary.frames, summary.time,
                 summary.wall_s, stop.stop_requested());
    return summary;
}

bool Server::ended(const RunSummary& summary, const std::stop_token& stop) const
{
    return stop.stop_requested() || steering_->control().stopped() ||
           (frames_ > 0 && summary.frames == frames_);
}

void Server::wait_for_frame(Pacer& pacer, LoopMeter& meter, const RunSummary& summary,
                            const std::stop_token& stop)
{
    if (ended(summary, stop))
        return; // what is answered "applied" would be in force from a frame that never runs
    const std::uint64_t next_frame = summary.frames + 1;
    pacer.set_rate(steering_->loop().server.frame_rate);
    const Clock::time_point due = free_run_ ? Clock::now() : pacer.next(Clock::now());
    steering_->prepare(next_frame, team_);
    while (!ended(summary, stop)) {
        const Clock::time_point now = Clock::now();
        const bool runs = steering_->control().may_run();
        if (!runs)
            meter.restart(now);
        else if (now >= due)
            break;
        sleep_until(runs ? std::min(due, now + command_period) : now + command_period, stop);
        steering_->prepare(next_frame, team_);
    }
}

void Server::run_frame(LoopMeter& meter, RunSummary& summary)
{
    const Clock::time_point begin = Clock::now();
    const bool wanted = publisher_ && publisher_->clusters_wanted();
    const MeterSettings metering = steering_->loop().meter;
    const AlarmSettings limits = steering_->loop().alarms;
    const Simulation::Request request{.clusters = wanted,
                                      .conserved = wanted || new_second_,
                                      .potential_energy = new_second_ && std::isfinite(limits.energy_drift),
                                      .error_pairs = meter_budget_.pairs(metering)};
    if (!metering.enabled)
        simulation_->forget_errors();
    const Snapshot* snapshot = nullptr;
    team_.run([&] { snapshot = &simulation_->step(request); });
    if (publisher_) {
        const LoopMeans& means = meter.means();
        publisher_->offer(*snapshot,
                          {.frame_rate_hz = means.frame_rate_hz,
                           .work_ms = means.work_ms,
                           .real_time_factor = means.real_time_factor,
                           .frame_rate_target_hz = free_run_ ? 0 : steering_->loop().server.frame_rate,
                           .regulation = steering_->regulation(),
                           .errors = errors_,
                           .effects = effects_});
    }
    const Clock::time_point end = Clock::now();
    const FrameTime took{.wall_s = std::chrono::duration<double>(end - start_).count(),
                         .step_ms = milliseconds(end - begin),
                         .encode_ms = encoding_ms()};
    steering_->add_work(*snapshot, took.step_ms + took.encode_ms, simulation_->take_error_samples());
    const double period_ms = free_run_ ? 0 : 1000 / steering_->loop().server.frame_rate;
    meter_budget_.add(metering, std::max(took.step_ms, period_ms), snapshot->profile[Phase::Meter],
                      snapshot->counts.error_pairs);
    summary.add(*snapshot, took.step_ms);
    alarms_->add(*snapshot, simulation_->settings().time.step);
    taken_out_ += snapshot->quarantined;
    new_second_ = meter.add(end, took.step_ms, snapshot->profile);
    const ControlReport regulation = steering_->regulation();
    if (each_frame_)
        each_frame_(*snapshot, took, regulation);
    if (new_second_) {
        report_errors(metering, regulation);
        report_effects(*snapshot);
        const std::uint64_t effects = steering_->effect_changes();
        if (taken_out_.particles > 0 || std::exchange(effects_known_, effects) != effects)
            alarms_->begin_anew(measure_conserved());
        if (alarms_->look(limits, regulation))
            log_alarms();
        log_quarantined();
        each_second_({*snapshot, meter.means(), simulation_->plan(), regulation, simulation_->error(),
                      alarms_->present()});
    }
}

void Server::report_errors(const MeterSettings& metering, const ControlReport& regulation)
{
    errors_.reset();
    if (!metering.enabled || !publisher_ || !publisher_->errors_wanted())
        return;
    ErrorReport report{.all = simulation_->error(), .regions = {}, .target = regulation.target_error};
    std::map<RegionRow, std::string> names;
    for (const Simulation::Region& region : simulation_->regions())
        names[region.row] = region.settings.name;
    for (const RegionError& measured : simulation_->region_errors())
        if (const auto name = names.find(measured.row); name != names.end())
            report.regions[name->second] = measured.error;
    errors_ = std::make_shared<ErrorReport>(std::move(report));
}

void Server::report_effects(const Snapshot& snapshot)
{
    effects_.reset();
    if (!publisher_ || !publisher_->effects_wanted())
        return;
    EffectReport report{.frame = snapshot.frame, .effects = {}};
    const std::vector<PlannedEffect>& planned = simulation_->plan().effects;
    for (std::size_t row = 0; row < planned.size(); ++row)
        report.effects.push_back({planned[row], snapshot.effects[row]});
    effects_ = std::make_shared<EffectReport>(std::move(report));
}

double Server::encoding_ms()
{
    if (!publisher_)
        return 0;
    const Publisher::Counters counters = publisher_->counters();
    const bool encoded =
        std::exchange(frames_encoded_, counters.frames_published) != counters.frames_published;
    return encoded ? counters.encode_ms : 0;
}

/// What is new in the log, once; all of it to those who read it.
void Server::log_alarms()
{
    const auto among = [](const std::vector<Alarm>& alarms, std::string_view name) {
        return std::any_of(alarms.begin(), alarms.end(),
                           [&](const Alarm& alarm) { return alarm.name == name; });
    };
    const std::vector<Alarm>& now = alarms_->present();
    for (const Alarm& alarm : now)
        if (!among(logged_alarms_, alarm.name))
            spdlog::log(alarm.severity == AlarmSeverity::Error ? spdlog::level::err : spdlog::level::warn,
                        "alarm {} frame={} {}", alarm.name, alarm.first_frame, alarm.text);
    for (const Alarm& alarm : logged_alarms_)
        if (!among(now, alarm.name))
            spdlog::info("alarm {} is over, last in frame {}", alarm.name, alarm.last_frame);
    logged_alarms_ = now;
    if (publisher_)
        publisher_->tell(std::vector<Alarm>(now));
}

/// Names who was taken out since the last time.
void Server::log_quarantined()
{
    if (taken_out_.particles > 0)
        spdlog::error("taken out, out of the range of numbers: {} particles of mass {:.6g}, ids {}{}",
                      taken_out_.particles, taken_out_.mass, fmt::join(taken_out_.ids(), ", "),
                      taken_out_.particles > taken_out_.ids().size() ? " and others" : "");
    taken_out_ = {};
}

Alarms::Start Server::measure_conserved()
{
    Alarms::Start measured;
    team_.run([&] {
        const Snapshot& now = simulation_->snapshot({.conserved = true, .potential_energy = true});
        measured = {now.conserved, now.potential_energy};
    });
    return measured;
}

} // namespace slod
