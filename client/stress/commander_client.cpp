#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>

#include "common/commander.hpp"
#include "common/connection.hpp"
#include "stress/clients.hpp"
#include "stress/rough_conduct.hpp"
#include "stress/storm.hpp"
#include "stress/ticker.hpp"

namespace slod::stress {

namespace {

using client::Clock;

/// Between two looks for something to do.
constexpr std::chrono::milliseconds longest_wait{4};

/// An unanswered command is lost after that: longer than anything about it is kept under way.
constexpr Clock::duration longest_answer =
    wire::topic<wire::Command>().delivery.lifespan + std::chrono::seconds(2);

/// Regions that were changed are told of at once; more than that is a fault.
constexpr std::chrono::seconds longest_news{5};

RegionState state_of(const client::RegionInfo& region)
{
    return {.shape = region.shape,
            .centre = region.centre,
            .half_extent = region.half_extent,
            .radius = region.radius,
            .max_cluster_size = region.max_cluster_size,
            .revision = region.revision};
}

/// One who commands: properly through client::Commander, and beside it roughly.
class CommandingClient {
public:
    explicit CommandingClient(const Order& order)
        : order_(order), connection_(order.domain, wire::Profile(order.profile), {.regions = true}),
          commander_(connection_.participant()), answers_(connection_.participant()),
          storm_({.prefix = order.run + std::to_string(order.index) + "-",
                  .regions = order.regions,
                  .extent = order.extent,
                  .seed = order.seed}),
          rough_(connection_.participant(), order)
    {}

    bool ready() const
    {
        return connection_.server() && commander_.connected() && rough_.raw().connected() &&
               answers_.matched();
    }

    /// Takes in what came, and waits a little for more.
    void take(const std::stop_token& stop)
    {
        commander_.wait(stop, longest_wait);
        const Clock::time_point now = Clock::now();
        for (const auto& [number, answer] : commander_.take_answers())
            if (const auto sent = sent_.find(number); sent != sent_.end()) {
                const std::chrono::duration<double, std::milli> took = now - sent->second;
                round_trip_.add(took.count());
                sent_.erase(sent);
            }
        constexpr int most = 1024;
        answers_.take_each(most, [this](const wire::CommandReply& reply, const dds_sample_info_t& info) {
            if (info.valid_data && wire::uuid_of(reply.session) == order_.session)
                on_answer(reply);
        });
        connection_.poll();
        rough_.raw().retry();
        for (; !removals_.empty() && may_send(); removals_.pop_back())
            send(removals_.back());
    }

    void begin();

    /// Sends what is due.
    void act();

    /// Whether it has sent all that it was to send.
    bool done() const
    {
        return order_.commands > 0 && book_.commands() + rough_.raw().book().commands() >= order_.commands;
    }

    bool waiting() const { return !removals_.empty() || book_.waiting() + rough_.raw().book().waiting() > 0; }

    /// What differs from what the answers say.
    std::vector<std::string> wrong_regions() const;

    /// From then on removes the regions that it has left, as answers come.
    void clean_up();

    CommanderResult result() const;

private:
    bool may_send() const { return commander_.waiting() < client::Commander::max_waiting; }
    void send(const Draft& draft);
    void on_answer(const wire::CommandReply& reply);

    Order order_;
    client::Connection connection_;
    client::Commander commander_;
    wire::Reader<wire::CommandReply> answers_; ///< to whomever
    Storm storm_;
    AnswerBook book_;                                 ///< of the storm
    std::map<std::uint64_t, Clock::time_point> sent_; ///< by number, of what the storm waits for
    std::vector<Draft> removals_;                     ///< still to be sent, to tidy up
    RoughConduct rough_;
    DurationHistogram round_trip_;
    Ticker storm_due_, malformed_due_, duplicates_due_, reordered_due_, impostors_due_;
    std::size_t turn_ = 0; ///< of rough conduct that may go first
};

void CommandingClient::begin()
{
    const Clock::time_point now = Clock::now();
    storm_due_ = Ticker(order_.rates.storm, now);
    malformed_due_ = Ticker(order_.rates.malformed, now);
    duplicates_due_ = Ticker(order_.rates.duplicates, now);
    reordered_due_ = Ticker(order_.rates.reordered, now);
    impostors_due_ = Ticker(order_.rates.impostors, now);
    if (order_.rates.rough())
        rough_.add_region();
}

void CommandingClient::act()
{
    const Clock::time_point now = Clock::now();
    const auto act_if_due = [now](Ticker& due, bool may, const auto& action) {
        if (!due.due(now) || !may)
            return;
        action();
        due.mark(now);
    };
    act_if_due(storm_due_, may_send(), [this] {
        if (const auto draft = storm_.next())
            send(*draft);
    });
    // Few may be under way, so that whoever came first each time might leave nothing to the others.
    const std::array<std::pair<Ticker*, std::function<void()>>, 4> conducts{{
        {&malformed_due_, [this] { rough_.send_malformed(); }},
        {&duplicates_due_, [this] { rough_.send_duplicate(); }},
        {&reordered_due_, [this] { rough_.send_reordered(); }},
        {&impostors_due_, [this] { rough_.send_as_impostor(connection_.regions()); }},
    }};
    ++turn_;
    for (std::size_t i = 0; i < conducts.size(); ++i) {
        const auto& [due, send_one] = conducts[(turn_ + i) % conducts.size()];
        act_if_due(*due, rough_.may_go_on(), send_one);
    }
}

void CommandingClient::send(const Draft& draft)
{
    const std::uint64_t number = commander_.send(request_of(draft), order_.session);
    sent_[number] = Clock::now();
    book_.on_sent(number, draft, {"applied"});
}

void CommandingClient::on_answer(const wire::CommandReply& reply)
{
    if (wire::uuid_of(reply.client) != commander_.client())
        return rough_.on_answer(reply);
    const Reply answer = reply_of(reply);
    if (const Draft* const draft = book_.on_answer(reply.request, answer))
        storm_.on_answer(*draft, answer);
}

std::vector<std::string> CommandingClient::wrong_regions() const
{
    std::map<std::string, RegionState> told;
    for (const auto& [name, region] : connection_.regions())
        told[name] = state_of(region);
    std::vector<std::string> problems = storm_.model().problems(told);
    const std::vector<std::string> more = rough_.model().problems(told);
    problems.insert(problems.end(), more.begin(), more.end());
    return problems;
}

void CommandingClient::clean_up()
{
    removals_ = storm_.clean_up();
    rough_.clean_up();
}

CommanderResult CommandingClient::result() const
{
    CommanderResult result{.valid = book_.tally(),
                           .rough = rough_.raw().book().tally(),
                           .kinds = rough_.kinds(),
                           .round_trip = round_trip_,
                           .wrong_answers = book_.problems()};
    result.valid.writes += commander_.rewrites();
    const std::vector<std::string>& more = rough_.raw().book().problems();
    result.wrong_answers.insert(result.wrong_answers.end(), more.begin(), more.end());
    return result;
}

/// Takes in what comes until `condition()`; gives up after `patience`.
template <class Condition>
void take_until(CommandingClient& client, Clock::duration patience, const Condition& condition)
{
    const Clock::time_point end = Clock::now() + patience;
    while (!condition() && Clock::now() < end)
        client.take(std::stop_token());
}

} // namespace

CommanderResult command(const Order& order, Tether& tether, const std::stop_token& stop)
{
    CommandingClient client(order);
    const auto over = [&] { return stop.stop_requested() || tether.ended(); };
    for (bool ready = false; !tether.begun() && !over();) {
        client.take(stop);
        if (!ready && client.ready()) {
            tether.report_ready();
            ready = true;
        }
    }
    client.begin();
    while (!over() && !client.done()) {
        client.act();
        client.take(stop);
    }
    const auto answered = [&] { return !client.waiting(); };
    take_until(client, longest_answer, answered);
    take_until(client, longest_news, [&] { return client.wrong_regions().empty(); });
    const std::vector<std::string> wrong_regions = client.wrong_regions();
    client.clean_up();
    take_until(client, longest_answer, answered);
    CommanderResult result = client.result();
    result.wrong_regions = wrong_regions;
    return result;
}

} // namespace slod::stress
