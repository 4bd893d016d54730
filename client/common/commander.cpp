#include "common/commander.hpp"

#include <algorithm>
#include <stdexcept>

namespace slod::client {

namespace {

/// Silence after which a request is sent again: a frame of most scenes is far shorter.
constexpr std::chrono::milliseconds retry_period{300};

constexpr int answers_per_poll = 256;

/// The bound of Command.settings.
constexpr std::size_t max_settings = 64;

slod_v1_Vector message_of(const std::array<double, 3>& vector)
{
    return {vector[0], vector[1], vector[2]};
}

template <class Field>
constexpr std::size_t capacity()
{
    return sizeof(Field) - 1;
}

CommandAnswer answer_of(const wire::CommandReply& reply)
{
    return {.result = reply.result,
            .field = reply.field,
            .text = reply.text,
            .applied_frame = reply.applied_frame,
            .revision = reply.revision};
}

} // namespace

std::string problem(const CommandRequest& request)
{
    if (request.region.size() > capacity<decltype(wire::Command::region)>())
        return "region = " + request.region + " is no name; use 1 to 32 of a-z, 0-9, _ and -";
    if (request.settings.size() > max_settings)
        return std::to_string(request.settings.size()) +
               " settings are too many for one command; use at most " + std::to_string(max_settings);
    for (const auto& [setting, value] : request.settings) {
        if (setting.size() > capacity<decltype(wire::Assignment::setting)>())
            return setting + " is no setting: it is longer than any";
        if (value.size() > capacity<decltype(wire::Assignment::value)>())
            return setting + " = " + value + " is too long for the wire; use at most " +
                   std::to_string(capacity<decltype(wire::Assignment::value)>()) + " characters";
    }
    return {};
}

void fill(wire::Command& command, std::vector<wire::Assignment>& settings, const CommandRequest& request)
{
    wire::set(command.kind, request.kind);
    wire::set(command.region, request.region);
    command.if_revision = request.if_revision;
    command.lease_s = request.lease_s;
    command.frames = request.frames;
    command.centre = message_of(request.centre);
    command.half_extent = message_of(request.half_extent);
    command.radius = request.radius;
    settings.resize(request.settings.size());
    for (std::size_t i = 0; i < settings.size(); ++i) {
        wire::set(settings[i].setting, request.settings[i].first);
        wire::set(settings[i].value, request.settings[i].second);
    }
    wire::lend(command.settings, settings);
}

std::string_view word_of(wire::ResultCode result)
{
    switch (result) {
    case slod_v1_RESULT_APPLIED:
        return "applied";
    case slod_v1_RESULT_UNSUPPORTED:
        return "unsupported";
    case slod_v1_RESULT_INVALID:
        return "invalid";
    case slod_v1_RESULT_UNKNOWN_REGION:
        return "unknown_region";
    case slod_v1_RESULT_REGION_EXISTS:
        return "region_exists";
    case slod_v1_RESULT_STALE_REVISION:
        return "stale_revision";
    case slod_v1_RESULT_NOT_OWNER:
        return "not_owner";
    case slod_v1_RESULT_NOT_PERMITTED:
        return "not_permitted";
    case slod_v1_RESULT_LIMIT_REACHED:
        return "limit_reached";
    default:
        return "failed";
    }
}

Commander::Commander(const wire::Participant& participant)
    : arrivals_(participant), writer_(participant), reader_(participant)
{
    arrivals_.watch(reader_);
}

std::uint64_t Commander::send(const CommandRequest& request, const wire::Uuid& session)
{
    if (waiting() >= max_waiting)
        throw std::logic_error("a command was sent while " + std::to_string(max_waiting) +
                               " others wait for answers");
    Unanswered& unanswered = unanswered_[++last_number_];
    unanswered.request = request;
    unanswered.session = session;
    write(last_number_, unanswered);
    return last_number_;
}

/// A write that DDS refuses, or that nobody hears, is made again by poll().
void Commander::write(std::uint64_t number, Unanswered& unanswered)
{
    if (!connected())
        return;
    wire::Command command{};
    std::vector<wire::Assignment> settings;
    wire::set(command.client, client_);
    command.request = number;
    wire::set(command.session, unanswered.session);
    fill(command, settings, unanswered.request);
    if (!writer_.write(command))
        return;
    if (unanswered.sent)
        ++rewrites_;
    unanswered.sent = Clock::now();
}

void Commander::poll()
{
    reader_.take_each(answers_per_poll, [&](const wire::CommandReply& reply, const dds_sample_info_t& info) {
        if (!info.valid_data || wire::uuid_of(reply.client) != client_)
            return;
        if (unanswered_.erase(reply.request) > 0)
            answers_[reply.request] = answer_of(reply);
    });
    const Clock::time_point now = Clock::now();
    for (auto& [number, unanswered] : unanswered_)
        if (!unanswered.sent || now - *unanswered.sent >= retry_period)
            write(number, unanswered);
}

void Commander::forget()
{
    unanswered_.clear();
    answers_.clear();
}

void Commander::wait(const std::stop_token& stop, std::chrono::nanoseconds timeout)
{
    constexpr std::chrono::milliseconds until_connected{10}; // DDS tells of matches by no condition here
    const std::chrono::nanoseconds retry = connected() ? retry_period : until_connected;
    const std::stop_callback wake(stop, [this] { arrivals_.wake(); });
    if (!stop.stop_requested())
        arrivals_.wait(unanswered_.empty() ? timeout : std::min(timeout, retry));
    poll();
}

std::optional<CommandAnswer> Commander::take_answer(std::uint64_t number)
{
    const auto found = answers_.find(number);
    if (found == answers_.end())
        return {};
    CommandAnswer answer = std::move(found->second);
    answers_.erase(found);
    return answer;
}

} // namespace slod::client
