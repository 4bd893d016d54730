#include "stress/answer_book.hpp"

#include <algorithm>
#include <utility>

namespace slod::stress {

namespace {

constexpr const char* forgotten = "limit_reached"; ///< what a server says to a number it has forgotten

std::string described(std::uint64_t number, const Draft& draft)
{
    return "request " + std::to_string(number) + " (" + draft.kind + " " + draft.region + ")";
}

std::string described(const Reply& reply)
{
    return reply.result + " at revision " + std::to_string(reply.revision) + ", frame " +
           std::to_string(reply.applied_frame);
}

} // namespace

void AnswerTally::add(const AnswerTally& other)
{
    commands += other.commands;
    writes += other.writes;
    answers += other.answers;
    lost += other.lost;
    contradicted += other.contradicted;
    unexpected += other.unexpected;
    for (const auto& [result, count] : other.results)
        results[result] += count;
}

void AnswerBook::on_sent(std::uint64_t number, const Draft& draft, std::vector<std::string> right)
{
    entries_[number] = {.draft = draft, .right = std::move(right)};
    ++tally_.commands;
    ++tally_.writes;
    ++waiting_;
    forget_oldest();
}

const Draft* AnswerBook::on_answer(std::uint64_t number, const Reply& reply)
{
    ++tally_.answers;
    const auto found = entries_.find(number);
    if (found == entries_.end())
        return nullptr;
    Entry& entry = found->second;
    if (entry.answered) {
        if (reply != entry.first && reply.result != forgotten) {
            ++tally_.contradicted;
            note(described(number, entry.draft) + " was answered " + described(entry.first) + ", and then " +
                 described(reply));
        }
        return nullptr;
    }
    entry.answered = true;
    entry.first = reply;
    --waiting_;
    ++tally_.results[reply.result];
    const auto& right = entry.right;
    if (!right.empty() && std::find(right.begin(), right.end(), reply.result) == right.end()) {
        ++tally_.unexpected;
        note(described(number, entry.draft) + " was answered " + described(reply) + " instead of " +
             right.front());
    }
    return &entry.draft;
}

AnswerTally AnswerBook::tally() const
{
    AnswerTally tally = tally_;
    tally.lost = waiting_;
    return tally;
}

void AnswerBook::note(const std::string& problem)
{
    if (problems_.size() < max_problems)
        problems_.push_back(problem);
}

void AnswerBook::forget_oldest()
{
    if (entries_.size() <= remembered)
        return;
    const auto oldest = std::find_if(entries_.begin(), entries_.end(),
                                     [](const auto& entry) { return entry.second.answered; });
    if (oldest != entries_.end())
        entries_.erase(oldest);
}

} // namespace slod::stress
