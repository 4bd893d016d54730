#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "idl/dds.hpp"

namespace slod::client {

/// A command to a server, with the fields of Command in slod.idl that its kind reads.
struct CommandRequest {
    std::string kind;
    std::string region{};
    std::uint64_t if_revision = 0;
    double lease_s = 0;
    std::uint32_t frames = 0;
    std::array<double, 3> centre{};
    std::array<double, 3> half_extent{};
    double radius = 0;
    std::vector<std::pair<std::string, std::string>> settings{}; ///< setting and value, as in a scene file
};

/// What is too long or too much for the wire, in a sentence; empty when nothing is.
std::string problem(const CommandRequest& request);

/// Puts what is requested into the message. Its settings are lent from `settings`, which are overwritten and
/// must outlive the message's use. The request must have no problem().
void fill(wire::Command& command, std::vector<wire::Assignment>& settings, const CommandRequest& request);

/// What the server said to it, as in CommandReply.
struct CommandAnswer {
    wire::ResultCode result = slod_v1_RESULT_APPLIED;
    std::string field;
    std::string text;
    std::uint64_t applied_frame = 0;
    std::uint64_t revision = 0;

    bool applied() const { return result == slod_v1_RESULT_APPLIED; }
};

/// The word of a result: "applied", "stale_revision".
std::string_view word_of(wire::ResultCode result);

/// One client's commands to the servers of a domain. Each is sent until it is answered; the server applies it
/// once. Call it from one thread.
class Commander {
public:
    using Clock = std::chrono::steady_clock;

    /// Requests that may wait for answers at a time: half of what DDS keeps of a client's, so that none
    /// pushes another out.
    static constexpr std::size_t max_waiting = 8;

    /// `participant` must outlive the commander. Throws wire::DdsError.
    explicit Commander(const wire::Participant& participant);

    const wire::Uuid& client() const { return client_; }

    /// Whether there is a server for commands, and one for answers.
    bool connected() const { return writer_.matched() && reader_.matched(); }

    /// Sends a request, which must have no problem(), to the server of that session (all 0: any) as soon as
    /// there is one; returns its number. Throws std::logic_error when max_waiting are unanswered.
    std::uint64_t send(const CommandRequest& request, const wire::Uuid& session = {});

    /// Takes in answers; sends again what has none yet.
    void poll();

    /// Waits until an answer arrives, or it is time to send again, `timeout` passes or stop is requested;
    /// then polls.
    void wait(const std::stop_token& stop, std::chrono::nanoseconds timeout);

    /// The answer to a request, once: it is then forgotten.
    std::optional<CommandAnswer> take_answer(std::uint64_t number);

    /// All answers that came, by number; they are then forgotten.
    std::map<std::uint64_t, CommandAnswer> take_answers() { return std::exchange(answers_, {}); }

    /// Forgets what was sent and what came: nothing of it is sent again.
    void forget();

    std::size_t waiting() const { return unanswered_.size(); }

    /// Requests sent again so far.
    std::uint64_t rewrites() const { return rewrites_; }

private:
    struct Unanswered {
        CommandRequest request;
        wire::Uuid session;
        std::optional<Clock::time_point> sent{}; ///< last; none: not yet
    };

    void write(std::uint64_t number, Unanswered& unanswered);

    wire::Uuid client_ = wire::new_uuid();
    wire::WaitSet arrivals_;
    wire::Writer<wire::Command> writer_;
    wire::Reader<wire::CommandReply> reader_;
    std::uint64_t last_number_ = 0;
    std::uint64_t rewrites_ = 0;
    std::map<std::uint64_t, Unanswered> unanswered_; ///< by request number
    std::map<std::uint64_t, CommandAnswer> answers_; ///< likewise
};

} // namespace slod::client
