#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>

#include "app/requests.hpp"

namespace slod {

/// The last answers to each client, so that a request that comes again is answered again and not applied
/// twice. When there are more clients than it holds, the one that was silent longest is forgotten.
class AnswerMemory {
public:
    static constexpr std::size_t answers_per_client = 64;

    /// `max_clients` >= 1.
    explicit AnswerMemory(std::size_t max_clients) : max_clients_(max_clients) {}

    /// The answer that was given; null when there was none, or it is forgotten.
    const Answer* find(const wire::Uuid& client, std::uint64_t number) const;

    /// Whether the request is older than those remembered: it may have been answered.
    bool too_old(const wire::Uuid& client, std::uint64_t number) const;

    void remember(const Answer& answer);

private:
    struct Client {
        std::deque<Answer> answers;  ///< in the order they were given
        std::uint64_t forgotten = 0; ///< highest request number whose answer is gone
        std::uint64_t used = 0;      ///< the larger the later
    };

    void forget_most_silent();

    std::size_t max_clients_;
    std::map<wire::Uuid, Client> clients_;
    std::uint64_t uses_ = 0;
};

} // namespace slod
