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

void AnswerMemory::remember(const Answer& answer)
{
    if (clients_.size() == max_clients_ && !clients_.contains(answer.client))
        forget_most_silent();
    Client& client = clients_[answer.client];
    client.used = ++uses_;
    if (client.answers.size() == answers_per_client) {
        client.forgotten = std::max(client.forgotten, client.answers.front().number);
        client.answers.pop_front();
    }
    client.answers.push_back(answer);
}

void AnswerMemory::forget_most_silent()
{
    clients_.erase(std::min_element(clients_.begin(), clients_.end(), [](const auto& a, const auto& b) {
        return a.second.used < b.second.used;
    }));
}

} // namespace slod
