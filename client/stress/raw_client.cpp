#include "stress/raw_client.hpp"

#include <algorithm>
#include <utility>

namespace slod::stress {

namespace {

/// Silence after which a command is written again: longer than a frame of most scenes takes.
constexpr std::chrono::milliseconds retry_period{500};

} // namespace

client::CommandRequest request_of(const Draft& draft)
{
    return {.kind = draft.kind,
            .region = draft.region,
            .if_revision = draft.if_revision,
            .lease_s = draft.lease_s,
            .frames = draft.frames,
            .centre = draft.centre,
            .half_extent = draft.half_extent,
            .radius = draft.radius,
            .settings = draft.settings};
}

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
    std::vector<wire::Assignment> settings;
    client::fill(command, settings, request_of(draft));
    static_cast<void>(writer_.write(command));
}

} // namespace slod::stress
