#include <chrono>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <thread>

#include "common/connection.hpp"
#include "stress/clients.hpp"

namespace slod::stress {

namespace {

using Milliseconds = std::chrono::duration<double, std::milli>;
using client::Clock;

/// A subscriber looks so often whether its work begins or ends.
constexpr std::chrono::milliseconds look_period{50};

/// Takes cluster states and the numbers off the wire, and keeps nothing of them but counts.
class Tap {
public:
    explicit Tap(const Order& order)
        : connection_(order.domain, wire::Profile(order.profile), {.stats = true}),
          arrivals_(connection_.participant()),
          clusters_(connection_.participant(),
                    wire::region_partition(order.region.empty() ? "*" : order.region), repair(order)),
          run_(order.run), session_(order.session),
          slow_ms_(order.reader == Reader::Slow ? order.sleep_ms : 0)
    {
        arrivals_.watch(clusters_);
        if (order.region.empty())
            arrivals_.watch(
                shared_clusters_.emplace(connection_.participant(), wire::shared_partition, repair(order)));
    }

    bool ready() const { return connection_.server() && clusters_.matched(); }

    /// Takes in what comes within `timeout`.
    void take(std::chrono::nanoseconds timeout)
    {
        arrivals_.wait(timeout);
        connection_.poll();
        take_from(clusters_);
        if (shared_clusters_)
            take_from(*shared_clusters_);
    }

    StreamTally tally;
    std::uint64_t bytes = 0;
    DurationHistogram latency;

private:
    static wire::Repair repair(const Order& order)
    {
        return order.reader == Reader::BestEffort ? wire::Repair::GoOn : wire::Repair::AskAgain;
    }

    /// A slow reader takes one at a time.
    void take_from(wire::Reader<wire::Clusters>& reader)
    {
        constexpr int most = 256;
        const int taken = reader.take_each(slow_ms_ > 0 ? 1 : most, [this](const wire::Clusters& clusters,
                                                                           const dds_sample_info_t& info) {
            if (!info.valid_data || wire::uuid_of(clusters.session) != session_)
                return;
            if (!std::string_view(clusters.region).starts_with(run_))
                tally.on_sample(clusters.region, clusters.serial);
            bytes += wire::wire_bytes(clusters);
            latency.add(Milliseconds(std::chrono::nanoseconds(dds_time() - info.source_timestamp)).count());
        });
        if (taken > 0 && slow_ms_ > 0)
            std::this_thread::sleep_for(Milliseconds(slow_ms_));
    }

    client::Connection connection_;
    wire::WaitSet arrivals_;
    wire::Reader<wire::Clusters> clusters_;
    std::optional<wire::Reader<wire::Clusters>> shared_clusters_; ///< of regions without a partition
    std::string run_; ///< regions of this run come and go, and a gap in their numbers may be no loss
    wire::Uuid session_;
    double slow_ms_;
};

/// Adds what a tap got; of a reader that stays, the streams that go on.
void add(SubscriberResult& result, const Tap& tap, bool stays)
{
    result.received += tap.tally.received();
    result.sent += tap.tally.sent();
    result.bytes += tap.bytes;
    result.latency.add(tap.latency);
    if (stays)
        result.open = tap.tally.open();
}

/// Sees that the client is under way until it is to end.
class Shift {
public:
    Shift(Tether& tether, const std::stop_token& stop) : tether_(tether), stop_(stop) {}

    bool begun() { return tether_.begun(); }
    bool over() { return stop_.stop_requested() || tether_.ended(); }

private:
    Tether& tether_;
    const std::stop_token& stop_;
};

/// Joins, reads for a while, leaves, and so on.
void come_and_go(const Order& order, Shift& shift, SubscriberResult& result)
{
    std::mt19937_64 random(order.seed);
    const auto some_ms = [&random](double least, double most) {
        return std::chrono::duration_cast<Clock::duration>(
            Milliseconds(std::uniform_real_distribution(least, most)(random)));
    };
    for (result.visits = 0; !shift.over(); ++result.visits) {
        Tap tap(order);
        const Clock::time_point leaves = Clock::now() + some_ms(500, 3000);
        while (!shift.over() && Clock::now() < leaves)
            tap.take(look_period);
        add(result, tap, false);
        std::this_thread::sleep_for(some_ms(50, 500));
    }
}

void stay(const Order& order, Tether& tether, Shift& shift, SubscriberResult& result)
{
    Tap tap(order);
    for (bool ready = false; !shift.begun() && !shift.over();) {
        tap.take(look_period);
        if (!ready && tap.ready()) {
            tether.report_ready();
            ready = true;
        }
    }
    tap.tally = {};
    tap.bytes = 0;
    tap.latency = {};
    while (!shift.over())
        tap.take(look_period);
    add(result, tap, true);
}

} // namespace

SubscriberResult subscribe(const Order& order, Tether& tether, const std::stop_token& stop)
{
    SubscriberResult result{.reader = *order.reader};
    Shift shift(tether, stop);
    if (order.reader == Reader::Joining) {
        tether.report_ready();
        come_and_go(order, shift, result);
    } else {
        stay(order, tether, shift, result);
    }
    return result;
}

} // namespace slod::stress
