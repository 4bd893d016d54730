#include "app/steering.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <spdlog/spdlog.h>

namespace slod {

Steering::Steering(Simulation& simulation, Publisher* publisher, Options options)
    : simulation_(simulation), regulating_(!options.replaying), publisher_(publisher),
      max_commands_(options.wire.max_commands), replay_(std::move(options.replay)),
      record_(std::move(options.record)), desk_(simulation, {.max_clients = options.wire.max_commanders,
                                                             .read_only = options.replaying,
                                                             .loop = options.loop}),
      regulator_(options.paced)
{
    if (publisher && options.wire.commands)
        inbox_.emplace(publisher->participant(), publisher->session());
    tell();
}

void Steering::prepare(std::uint64_t frame, ThreadTeam& team)
{
    team.run([&] {
        repeat_log(frame);
        if (inbox_)
            take_commands(frame);
        desk_.expire_leases(frame, CommandDesk::Clock::now());
    });
    record_changes();
    tell();
}

void Steering::follow_views(std::uint64_t frame, ThreadTeam& team)
{
    team.run([&] { desk_.follow_views(frame); });
    record_changes();
    tell();
}

void Steering::regulate(std::uint64_t frame, ThreadTeam& team)
{
    if (!regulating_)
        return;
    team.run([&] {
        regulator_.set(desk_.loop(), desk_.editor(), simulation_);
        regulator_.apply(desk_.editor(), frame);
    });
    record_changes();
}

void Steering::record_changes()
{
    for (const LoggedCommand& command : desk_.editor().take_log()) {
        spdlog::debug("changed frame={} {} region={}", command.frame,
                      names(command.kind)[std::size_t(command.kind)], command.region);
        if (record_)
            record_(command);
    }
}

void Steering::repeat_rest(std::uint64_t frame, ThreadTeam& team)
{
    team.run([&] { repeat_log(frame); });
}

void Steering::repeat_log(std::uint64_t frame)
{
    for (; repeated_ < replay_.size() && replay_[repeated_].frame <= frame; ++repeated_)
        if (const Problems found = desk_.editor().repeat(replay_[repeated_]); !found.empty())
            throw std::runtime_error("frame " + std::to_string(frame) +
                                     " of the log cannot be repeated: " + found.front());
}

void Steering::take_commands(std::uint64_t frame)
{
    const CommandDesk::Clock::time_point now = CommandDesk::Clock::now();
    for (const Request& request : inbox_->take_requests(std::min(max_commands_, publisher_->answer_room())))
        answers_.push_back(desk_.handle(request, frame, now));
    for (const ClientView& view : inbox_->take_views())
        desk_.see(view, now);
}

void Steering::tell()
{
    std::vector<RegionRecord> news = desk_.editor().take_news();
    if (publisher_)
        publisher_->tell(std::exchange(answers_, {}), std::move(news), desk_.control().paused());
}

} // namespace slod
