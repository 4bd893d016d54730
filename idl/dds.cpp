#include "idl/dds.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <mutex>

namespace slod::wire {

namespace {

/// The domains of this process and their holders.
struct Domains {
    struct Entry {
        Entity entity;
        int holders = 0;
    };
    std::mutex lock;
    std::map<std::uint32_t, Entry> entries;
};

Domains& domains()
{
    static Domains instance;
    return instance;
}

using Qos = std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)>;

Qos new_qos()
{
    return {dds_create_qos(), &dds_delete_qos};
}

/// All that the table says, explicitly: shared memory is used only when nothing is left to defaults.
Qos qos_of(const Delivery& delivery)
{
    constexpr dds_duration_t longest_write = DDS_MSECS(100);
    Qos qos = new_qos();
    dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, longest_write);
    dds_qset_durability(qos.get(),
                        delivery.late_joiners ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
    dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, delivery.depth);
    dds_qset_durability_service(qos.get(), 0, DDS_HISTORY_KEEP_LAST, delivery.depth, DDS_LENGTH_UNLIMITED,
                                DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
    dds_qset_liveliness(qos.get(), DDS_LIVELINESS_AUTOMATIC,
                        delivery.lease > 0s ? delivery.lease.count() : DDS_INFINITY);
    dds_qset_lifespan(qos.get(), delivery.lifespan > 0s ? delivery.lifespan.count() : DDS_INFINITY);
    dds_qset_deadline(qos.get(), DDS_INFINITY);
    // What a server leaves behind when it dies is told from what it disposes of.
    dds_qset_writer_data_lifecycle(qos.get(), false);
    return qos;
}

Qos group_qos(std::string_view partition)
{
    Qos qos = new_qos();
    if (!partition.empty()) {
        const std::string name(partition);
        const char* names[] = {name.c_str()};
        dds_qset_partition(qos.get(), 1, names);
    }
    return qos;
}

Entity make_topic(const Participant& participant, const TopicInfo& info)
{
    const std::string name = std::string(topic_prefix) + std::string(info.name);
    return {dds_create_topic(participant.handle(), info.descriptor, name.c_str(), nullptr, nullptr),
            "create topic " + name};
}

std::string described(std::uint32_t domain, Profile profile)
{
    return "join DDS domain " + std::to_string(domain) + " (" + configuration_source(profile) +
           "; the interface it names must be up, and UDP ports from " + std::to_string(7400 + 250 * domain) +
           " must be free)";
}

} // namespace

dds_return_t checked(dds_return_t result, std::string_view what)
{
    if (result < 0)
        throw DdsError("cannot " + std::string(what) + ": " + dds_strretcode(result), result);
    return result;
}

Domain::Domain(std::uint32_t number, Profile profile) : number_(number)
{
    const std::scoped_lock guard(domains().lock);
    Domains::Entry& entry = domains().entries[number];
    if (entry.holders == 0)
        entry.entity =
            Entity(dds_create_domain(number, configuration(profile).c_str()), described(number, profile));
    ++entry.holders;
}

Domain::~Domain()
{
    const std::scoped_lock guard(domains().lock);
    const auto found = domains().entries.find(number_);
    if (--found->second.holders == 0)
        domains().entries.erase(found);
}

Participant::Participant(std::uint32_t domain, Profile profile)
    : domain_(domain, profile),
      entity_(dds_create_participant(domain, nullptr, nullptr), described(domain, profile))
{}

Endpoint make_writer(const Participant& participant, const TopicInfo& info, std::string_view partition)
{
    Endpoint made;
    made.topic = make_topic(participant, info);
    made.group = Entity(dds_create_publisher(participant.handle(), group_qos(partition).get(), nullptr),
                        "create a publisher");
    made.end = Entity(
        dds_create_writer(made.group.handle(), made.topic.handle(), qos_of(info.delivery).get(), nullptr),
        "write topic " + std::string(info.name));
    return made;
}

Endpoint make_reader(const Participant& participant, const TopicInfo& info, std::string_view partition,
                     Repair repair)
{
    const Qos qos = qos_of(info.delivery);
    if (repair == Repair::GoOn)
        dds_qset_reliability(qos.get(), DDS_RELIABILITY_BEST_EFFORT, 0);
    Endpoint made;
    made.topic = make_topic(participant, info);
    made.group = Entity(dds_create_subscriber(participant.handle(), group_qos(partition).get(), nullptr),
                        "create a subscriber");
    made.end = Entity(dds_create_reader(made.group.handle(), made.topic.handle(), qos.get(), nullptr),
                      "read topic " + std::string(info.name));
    return made;
}

WaitSet::WaitSet(const Participant& participant)
    : set_(dds_create_waitset(participant.handle()), "create a waitset"),
      woken_(dds_create_guardcondition(participant.handle()), "create a guard condition")
{
    watch(woken_);
}

void WaitSet::watch(const Entity& condition)
{
    checked(dds_waitset_attach(set_.handle(), condition.handle(), condition.handle()), "watch a condition");
}

void WaitSet::wake()
{
    dds_set_guardcondition(woken_.handle(), true);
}

void WaitSet::wait(std::chrono::nanoseconds timeout)
{
    dds_waitset_wait(set_.handle(), nullptr, 0, std::max<dds_duration_t>(timeout.count(), 0));
    bool was_woken = false;
    dds_take_guardcondition(woken_.handle(), &was_woken);
}

} // namespace slod::wire
