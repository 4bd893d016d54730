#include "app/answer_memory.hpp"

#include <algorithm>

namespace slod {

const Answer* AnswerMemory::find(const wire::Uuid& client, std::uint64_t number) const
{
    const auto known = clients_.find(client);
    if (known == clients_.end())
        return nullptr;
    const auto& answers = known->second.answers;
    const auto found = std::find_if(answers.begin(), answers.end(),
                                    [number](const Answer& answer) { return answer.number == number; });
    return found != answers.end() ? &*found : nullptr;
}

bool AnswerMemory::too_old(const wire::Uuid& client, std::uint64_t number) const
{
    const auto known = clients_.find(client);
    return known != clients_.end() && number <= known->second.forgotten;
}

bool AnswerMemory::has_room(const wire::Uuid& client, Clock::time_point now)
{
    if (clients_.size() < max_clients_ || clients_.contains(client))
        return true;
    const auto most_silent =
        std::min_element(clients_.begin(), clients_.end(),
                         [](const auto& a, const auto& b) { return a.second.heard < b.second.heard; });
    if (now - most_silent->second.heard <= longest_silence)
        return false;
    clients_.erase(most_silent);
    return true;
}

void AnswerMemory::remember(const Answer& answer, Clock::time_point now)
{
    Client& client = clients_[answer.client];
    client.heard = now;
    if (client.answers.size() == answers_per_client) {
        client.forgotten = std::max(client.forgotten, client.answers.front().number);
        client.answers.pop_front();
    }
    client.answers.push_back(answer);
}

void AnswerMemory::renew(const wire::Uuid& client, Clock::time_point now)
{
    if (const auto known = clients_.find(client); known != clients_.end())
        known->second.heard = now;
}

} // namespace slod
