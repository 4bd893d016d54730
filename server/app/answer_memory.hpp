#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>

#include "app/requests.hpp"
#include "idl/topics.hpp"

namespace slod {

/// The last answers to each client, so that a request that comes again is answered again and not applied
/// twice. A client is forgotten, where another needs its place, once it was silent for longer than any
/// request of its is under way; meanwhile there is no room for more. Knows no clock: it is told the time.
class AnswerMemory {
public:
    using Clock = std::chrono::steady_clock;

    static constexpr std::size_t answers_per_client = 64;
    /// Silence after which nothing that the client sent can still arrive.
    static constexpr Clock::duration longest_silence = wire::topic<wire::Command>().delivery.lifespan;

    /// `max_clients` >= 1.
    explicit AnswerMemory(std::size_t max_clients) : max_clients_(max_clients) {}

    /// The answer that was given; null when there was none, or it is forgotten.
    const Answer* find(const wire::Uuid& client, std::uint64_t number) const;

    /// Whether the request is older than those remembered: it may have been answered.
    bool too_old(const wire::Uuid& client, std::uint64_t number) const;

    /// Whether an answer to the client can be remembered at `now`; forgets another client where that makes
    /// room.
    bool has_room(const wire::Uuid& client, Clock::time_point now);

    /// There must be room. The client is heard from at `now`.
    void remember(const Answer& answer, Clock::time_point now);

    /// A request came again.
    void renew(const wire::Uuid& client, Clock::time_point now);

private:
    struct Client {
        std::deque<Answer> answers;  ///< in the order they were given
        std::uint64_t forgotten = 0; ///< highest request number whose answer is gone
        Clock::time_point heard{};   ///< when it last asked
    };

    std::size_t max_clients_;
    std::map<wire::Uuid, Client> clients_;
};

} // namespace slod
