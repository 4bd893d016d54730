#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "stress/draft.hpp"

namespace slod::stress {

/// How commands were answered. Several clients' add up.
struct AnswerTally {
    std::uint64_t commands = 0;     ///< sent, each counted once however often it was written
    std::uint64_t writes = 0;       ///< of them, repetitions included
    std::uint64_t answers = 0;      ///< that came, repetitions included
    std::uint64_t lost = 0;         ///< commands without an answer
    std::uint64_t contradicted = 0; ///< answers that differ from an earlier one to the same command
    std::uint64_t unexpected = 0;   ///< first answers that are none of those that are right
    std::map<std::string, std::uint64_t> results{}; ///< first answers by result

    /// Answers to nothing that was written.
    std::uint64_t surplus() const { return answers > writes ? answers - writes : 0; }

    void add(const AnswerTally& other);
};

/// Keeps account of one client's commands by request number: each must be answered, always in the same way,
/// and as is right for it. A command so old that the server has forgotten its answer may be refused.
class AnswerBook {
public:
    /// A command is written for the first time. `right`: the results that its answer may have; none: any.
    void on_sent(std::uint64_t number, const Draft& draft, std::vector<std::string> right);

    /// A number is written again, with whatever content.
    void on_sent_again() { ++tally_.writes; }

    /// An answer came. Returns the command when it is its first; null otherwise. Valid until the next call.
    const Draft* on_answer(std::uint64_t number, const Reply& reply);

    /// Sent so far, each counted once.
    std::uint64_t commands() const { return tally_.commands; }

    /// Commands that have no answer yet.
    std::size_t waiting() const { return waiting_; }

    /// So far; what waits counts as lost.
    AnswerTally tally() const;

    /// The first few things that went wrong, one sentence each.
    const std::vector<std::string>& problems() const { return problems_; }

private:
    struct Entry {
        Draft draft;
        std::vector<std::string> right;
        bool answered = false;
        Reply first{};
    };

    /// Answers remembered: four times what a server remembers.
    static constexpr std::size_t remembered = 256;
    static constexpr std::size_t max_problems = 10;

    void note(const std::string& problem);
    void forget_oldest();

    std::map<std::uint64_t, Entry> entries_; ///< by request number
    std::size_t waiting_ = 0;
    AnswerTally tally_;
    std::vector<std::string> problems_;
};

} // namespace slod::stress
