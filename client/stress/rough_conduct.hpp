#pragma once

#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "common/connection.hpp"
#include "stress/misuse.hpp"
#include "stress/order.hpp"
#include "stress/raw_client.hpp"
#include "stress/region_model.hpp"

namespace slod::stress {

/// What clients should not do: one that has a region of its own and sends malformed, repeated and disordered
/// commands about it, and meddles with others'. Everything is drawn from the seed.
class RoughConduct {
public:
    RoughConduct(const wire::Participant& participant, const Order& order);

    /// Adds its region.
    void add_region();

    /// Whether another of these may be done: few are under way at a time.
    bool may_go_on() const { return raw_.book().waiting() < most_waiting; }

    // One of each kind.
    void send_malformed();
    void send_duplicate();
    void send_reordered();
    void send_as_impostor(const client::Connection::Regions& regions);

    /// An answer to any client came.
    void on_answer(const wire::CommandReply& reply);

    /// Removes its region; nothing must be under way.
    void clean_up();

    RawClient& raw() { return raw_; }
    const RawClient& raw() const { return raw_; }
    const RegionModel& model() const { return model_; }
    const std::map<std::string, std::uint64_t>& kinds() const { return kinds_; }

private:
    /// With two writes each, and an old number beside, fewer than the 16 that DDS keeps of a client's.
    static constexpr std::size_t most_waiting = 4;

    Draft move();
    double uniform(double least, double most);

    Order order_;
    std::mt19937_64 random_;
    std::string box_;
    std::vector<Misuse> misuses_;
    std::size_t next_misuse_;
    RawClient raw_;
    RegionModel model_;
    std::map<wire::Uuid, std::uint64_t> others_; ///< the last answered number of each other client
    std::map<std::string, std::uint64_t> kinds_;
};

} // namespace slod::stress
