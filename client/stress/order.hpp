#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "stress/json.hpp"
#include "stress/results.hpp"

namespace slod::stress {

/// How often a commander does what [Hz]; 0: never.
struct Rates {
    double storm = 5;      ///< valid commands about regions of its own
    double malformed = 0;  ///< commands that are wrong in themselves
    double duplicates = 0; ///< a command written twice, the second time with the same content or with another
    double reordered = 0;  ///< request numbers out of order, and old ones again
    double impostors = 0;  ///< commands about others' regions, and under others' names

    /// Whether anything is to be done that no client should do.
    bool rough() const { return malformed > 0 || duplicates > 0 || reordered > 0 || impostors > 0; }
};

/// What one client of a run is to do.
struct Order {
    std::optional<Reader> reader;           ///< none: it commands
    std::uint32_t index = 0;                ///< among those of its run
    std::string run;                        ///< what its regions' names begin with
    std::array<std::uint8_t, 16> session{}; ///< of the server that is loaded
    std::uint32_t domain = 0;
    std::uint32_t profile = 0; ///< of wire::Profile
    std::uint64_t seed = 1;
    std::string region{}; ///< whose clusters it reads; empty: all
    double sleep_ms = 0;  ///< of a slow reader, after each sample
    Rates rates{};
    std::uint32_t regions = 1;  ///< of its own, at most
    double extent = 1;          ///< its regions lie within so far of the origin, in scene lengths
    std::uint64_t commands = 0; ///< at most; 0: any number
};

Json json_of(const Order& order);

/// The reverse. Throws Json::exception for what is no order.
Order order_of(const Json& json);

} // namespace slod::stress
