#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "idl/duration_histogram.hpp"
#include "stress/answer_book.hpp"
#include "stress/json.hpp"
#include "stress/stream_tally.hpp"

namespace slod::stress {

/// How a subscriber treats what it subscribes to.
enum class Reader : std::uint8_t {
    Steady,     ///< reads all it gets
    BestEffort, ///< likewise, and does not ask again for what got lost
    Slow,       ///< sleeps after each sample
    Stopped,    ///< is stopped by SIGSTOP every few seconds
    Joining,    ///< comes and goes
};

constexpr std::array<std::string_view, 5> names(Reader)
{
    return {"steady", "best_effort", "slow", "stopped", "joining"};
}

/// Whether a reader's losses and latencies are the server's and the network's, and not its own.
constexpr bool counts_against_limits(Reader reader)
{
    return reader == Reader::Steady || reader == Reader::BestEffort;
}

/// What one subscriber got of the cluster states.
struct SubscriberResult {
    Reader reader = Reader::Steady;
    std::uint64_t received = 0;
    std::uint64_t sent = 0;             ///< to it, from its first sample to its last one of each stream
    std::map<std::string, Span> open{}; ///< streams by region, of a reader that never left
    std::uint64_t bytes = 0;
    std::uint64_t visits = 1;    ///< how often it joined
    DurationHistogram latency{}; ///< from the write to the read
};

/// What became of one commander's commands.
struct CommanderResult {
    AnswerTally valid{};                          ///< of its storm
    AnswerTally rough{};                          ///< of the commands that no client should send
    std::map<std::string, std::uint64_t> kinds{}; ///< commands by what is rough about them
    DurationHistogram round_trip{};               ///< of the storm, from the first write to the answer
    std::vector<std::string> wrong_answers{};     ///< the first few, one sentence each
    std::vector<std::string> wrong_regions{};     ///< where the state is not what the answers say
};

Json json_of(const SubscriberResult& result);
Json json_of(const CommanderResult& result);

/// The reverse. Throw Json::exception for what is no such result.
SubscriberResult subscriber_result(const Json& json);
CommanderResult commander_result(const Json& json);

} // namespace slod::stress
