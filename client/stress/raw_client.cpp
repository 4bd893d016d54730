#include "stress/raw_client.hpp"

#include <algorithm>
#include <utility>

#include "common/commander.hpp"

namespace slod::stress {

namespace {

/// Silence after which a command is written again: longer than a frame of most scenes takes.
constexpr std::chrono::milliseconds retry_period{500};

slod_v1_Vector message_of(const Vector& vector)
{
    return {vector[0], vector[1], vector[2]};
}

} // namespace

Reply reply_of(const wire::CommandReply& reply)
{
    return {.result = std::string(client::word_of(reply.result)),
            .applied_frame = reply.applied_frame,
            .revision = reply.revision};
}

std::uint64_t RawClient::send(const Draft& draft, std::vector<std::string> right)
{
    const std::uint64_t number = last_number_ + 1;
    send_numbered(number, draft, std::move(right));
    return number;
}

void RawClient::send_numbered(std::uint64_t number, const Draft& draft, std::vector<std::string> right)
{
    last_number_ = std::max(last_number_, number);
    book_.on_sent(number, draft, std::move(right));
    waiting_[number] = {draft, Clock::now()};
    write(client_, number, draft);
}

void RawClient::send_again(std::uint64_t number, const Draft& draft)
{
    book_.on_sent_again();
    write(client_, number, draft);
}

void RawClient::send_as(const wire::Uuid& other, std::uint64_t number, const Draft& draft)
{
    write(other, number, draft);
}

const Draft* RawClient::on_answer(std::uint64_t number, const Reply& reply)
{
    waiting_.erase(number);
    return book_.on_answer(number, reply);
}

void RawClient::retry()
{
    const Clock::time_point now = Clock::now();
    for (auto& [number, waiting] : waiting_)
        if (now - waiting.written >= retry_period) {
            waiting.written = now;
            send_again(number, waiting.draft);
        }
}

/// What DDS refuses is written again by retry().
void RawClient::write(const wire::Uuid& client, std::uint64_t number, const Draft& draft)
{
    wire::Command command{};
    wire::set(command.client, client);
    command.request = number;
    wire::set(command.session, session_);
    wire::set(command.kind, draft.kind);
    wire::set(command.region, draft.region);
    command.if_revision = draft.if_revision;
    command.lease_s = draft.lease_s;
    command.frames = draft.frames;
    command.centre = message_of(draft.centre);
    command.half_extent = message_of(draft.half_extent);
    command.radius = draft.radius;
    std::vector<wire::Assignment> settings(draft.settings.size());
    for (std::size_t i = 0; i < settings.size(); ++i) {
        wire::set(settings[i].setting, draft.settings[i].first);
        wire::set(settings[i].value, draft.settings[i].second);
    }
    wire::lend(command.settings, settings);
    static_cast<void>(writer_.write(command));
}

} // namespace slod::stress
