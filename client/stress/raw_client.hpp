#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "common/commander.hpp"
#include "idl/dds.hpp"
#include "stress/answer_book.hpp"
#include "stress/draft.hpp"

namespace slod::stress {

client::CommandRequest request_of(const Draft& draft);
Reply reply_of(const wire::CommandReply& reply);

/// Writes commands as they are, under any name and number: what client::Commander would not do.
class RawClient {
public:
    using Clock = std::chrono::steady_clock;

    /// To the server of that session.
    RawClient(const wire::Participant& participant, const wire::Uuid& session)
        : session_(session), writer_(participant)
    {}

    const wire::Uuid& client() const { return client_; }
    bool connected() const { return writer_.matched(); }

    /// Writes a new command under the client's next number; returns the number. `right`: as in AnswerBook.
    std::uint64_t send(const Draft& draft, std::vector<std::string> right);

    /// Likewise, under a number not used before.
    void send_numbered(std::uint64_t number, const Draft& draft, std::vector<std::string> right);

    /// Writes a number of this client's once more, with whatever content.
    void send_again(std::uint64_t number, const Draft& draft);

    /// Writes under another client's name.
    void send_as(const wire::Uuid& other, std::uint64_t number, const Draft& draft);

    /// Takes in an answer to this client. Returns the command when it is its first; null otherwise.
    const Draft* on_answer(std::uint64_t number, const Reply& reply);

    /// Writes again what has had no answer for long.
    void retry();

    const AnswerBook& book() const { return book_; }
    std::uint64_t last_number() const { return last_number_; } ///< highest one used

private:
    struct Waiting {
        Draft draft;
        Clock::time_point written;
    };

    void write(const wire::Uuid& client, std::uint64_t number, const Draft& draft);

    wire::Uuid client_ = wire::new_uuid();
    wire::Uuid session_;
    wire::Writer<wire::Command> writer_;
    std::uint64_t last_number_ = 0;
    std::map<std::uint64_t, Waiting> waiting_; ///< by number
    AnswerBook book_;
};

} // namespace slod::stress
