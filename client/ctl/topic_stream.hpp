#pragma once

#include <chrono>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>

#include "ctl/waiting.hpp"
#include "idl/dds.hpp"

namespace slod::ctl {

/// The samples of one topic, whoever writes them; of topics by region those of `region`, or of all when it is
/// empty.
template <class Message>
class TopicStream {
public:
    TopicStream(const wire::Participant& participant, const std::string& region)
        : arrivals_(participant), reader_(participant, partition_of(region))
    {
        arrivals_.watch(reader_);
        if (by_region && region.empty())
            arrivals_.watch(shared_.emplace(participant, wire::shared_partition));
    }

    /// Waits until samples arrive, `timeout` passes or stop is requested; then calls visit(const Message&,
    /// const dds_sample_info_t&) for each.
    template <class Visitor>
    void wait(const std::stop_token& stop, std::chrono::nanoseconds timeout, const Visitor& visit)
    {
        const std::stop_callback wake(stop, [this] { arrivals_.wake(); });
        if (!stop.stop_requested())
            arrivals_.wait(timeout);
        constexpr int samples_at_a_time = 256;
        reader_.take_each(samples_at_a_time, visit);
        if (shared_)
            shared_->take_each(samples_at_a_time, visit);
    }

    static constexpr bool by_region = wire::topic<Message>().by_region;

private:
    static std::string partition_of(const std::string& region)
    {
        return by_region ? wire::region_partition(region.empty() ? "*" : region) : std::string();
    }

    wire::WaitSet arrivals_;
    wire::Reader<Message> reader_;
    std::optional<wire::Reader<Message>> shared_; ///< of regions without a partition
};

/// Calls run.operator()<Message>() for the topic of that name, with or without "slod/v1/" before it; NotFound
/// when there is none.
template <class Run>
ExitCode with_topic(std::string_view name, const Run& run)
{
    if (name.starts_with(wire::topic_prefix))
        name.remove_prefix(wire::topic_prefix.size());
    std::optional<ExitCode> code;
    std::string known;
    const auto look_at = [&]<class Message>(const wire::Topic<Message>& row) {
        known += (known.empty() ? "" : ", ") + std::string(row.name);
        if (row.name == name)
            code = run.template operator()<Message>();
    };
    std::apply([&](const auto&... rows) { (look_at(rows), ...); }, wire::topic_table);
    if (!code)
        complain("there is no topic " + std::string(name) + "; there are " + known);
    return code.value_or(ExitCode::NotFound);
}

} // namespace slod::ctl
