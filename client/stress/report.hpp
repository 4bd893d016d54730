#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "stress/json.hpp"
#include "stress/results.hpp"
#include "stress/server_use.hpp"

namespace slod::stress {

/// All subscribers of one kind together.
struct ReaderReport {
    Reader reader = Reader::Steady;
    std::uint64_t readers = 0;
    std::uint64_t visits = 0;
    std::uint64_t received = 0; ///< samples
    double delivered = 1;       ///< share of what was sent to them; 0 where nothing came
    double mb_s = 0;            ///< received, 10^6 bytes per second, all together
    DurationHistogram latency{};
};

/// All commanders together.
struct CommandReport {
    AnswerTally valid, rough;
    std::map<std::string, std::uint64_t> kinds; ///< rough ones by what is rough about them
    DurationHistogram round_trip;
    std::vector<std::string> problems; ///< the first few
    std::uint64_t wrong_regions = 0;
};

struct Report {
    std::string scene{}, host{}, version{};
    std::uint64_t particles = 0, clusters = 0, sample_bytes = 0;
    std::uint64_t subscribers = 0, commanders = 0;
    std::uint64_t missing_workers = 0; ///< that ended without a result
    std::string lost_server{};         ///< why it was not there from beginning to end; empty: it was
    ServerUse rest{}, load{};
    std::vector<ReaderReport> readers{}; ///< one for each kind that took part
    CommandReport commands{};
};

/// By kind. `seconds`: how long they read.
std::vector<ReaderReport> report_of(const std::vector<SubscriberResult>& results, double seconds);
CommandReport report_of(const std::vector<CommanderResult>& results);

Json json_of(const Report& report);

/// For people: some lines, with their ends.
std::string text_of(const Report& report);

} // namespace slod::stress
