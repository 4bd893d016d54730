#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include <dds/dds.h>

#include "idl/profile.hpp"
#include "idl/topics.hpp"

/// A thin layer over Cyclone DDS's C API: ownership, types and errors, nothing else.
namespace slod::wire {

/// DDS could not set something up; what() says what, why and what to do.
class DdsError : public std::runtime_error {
public:
    DdsError(const std::string& what, dds_return_t code) : std::runtime_error(what), code_(code) {}

    bool not_permitted() const { return code_ == DDS_RETCODE_NOT_ALLOWED_BY_SECURITY; }

private:
    dds_return_t code_;
};

/// Returns `result`, a handle or a count, or throws when it is an error. `what` was tried, as a verb phrase.
dds_return_t checked(dds_return_t result, std::string_view what);

/// Owns a DDS entity, and with it everything created in it.
class Entity {
public:
    Entity() = default;
    Entity(dds_entity_t handle, std::string_view what) : handle_(checked(handle, what)) {}
    Entity(Entity&& other) noexcept : handle_(std::exchange(other.handle_, 0)) {}
    Entity& operator=(Entity&& other) noexcept
    {
        std::swap(handle_, other.handle_);
        return *this;
    }
    ~Entity()
    {
        if (handle_ != 0)
            dds_delete(handle_);
    }

    dds_entity_t handle() const { return handle_; }

private:
    dds_entity_t handle_ = 0;
};

/// Keeps a DDS domain configured while it lives. A process has one of each number: the first holder's
/// profile configures it, the last one deletes it.
class Domain {
public:
    Domain(std::uint32_t number, Profile profile);
    ~Domain();
    Domain(const Domain&) = delete;
    Domain& operator=(const Domain&) = delete;

    std::uint32_t number() const { return number_; }

private:
    std::uint32_t number_;
};

/// A member of a domain: what servers and clients are to each other.
class Participant {
public:
    /// Throws DdsError with a remedy when the network is not as the profile needs it.
    Participant(std::uint32_t domain, Profile profile);

    dds_entity_t handle() const { return entity_.handle(); }

private:
    Domain domain_;
    Entity entity_;
};

/// A topic's writer or reader with the entities it needs, the inner ones last.
struct Endpoint {
    Entity topic;
    Entity group; ///< DDS publisher or subscriber: has the partition
    Entity end;
};

/// What a reader does about a fragment that was lost: asks for it again, or goes on with the next sample.
enum class Repair : std::uint8_t { AskAgain, GoOn };

/// `partition` is empty, or a region_partition().
Endpoint make_writer(const Participant& participant, const TopicInfo& info, std::string_view partition);
Endpoint make_reader(const Participant& participant, const TopicInfo& info, std::string_view partition,
                     Repair repair);

template <class Message>
class Writer {
public:
    explicit Writer(const Participant& participant, std::string_view partition = {})
        : endpoint_(make_writer(participant, topic<Message>(), partition))
    {}

    /// Never waits for a reader. False: DDS refused the sample; go on without it and count it.
    [[nodiscard]] bool write(const Message& message)
    {
        return dds_write(endpoint_.end.handle(), &message) == DDS_RETCODE_OK;
    }

    /// Tells readers that the instance with this message's key is no more.
    [[nodiscard]] bool dispose(const Message& message)
    {
        return dds_dispose(endpoint_.end.handle(), &message) == DDS_RETCODE_OK;
    }

    /// Likewise, and forgets the instance, which otherwise takes memory as long as the writer lives.
    [[nodiscard]] bool forget(const Message& message)
    {
        return dispose(message) &&
               dds_unregister_instance(endpoint_.end.handle(), &message) == DDS_RETCODE_OK;
    }

    /// Waits until every reader has what was written, or `timeout` passes: a writer that ends takes along
    /// what is still under way.
    void flush(std::chrono::nanoseconds timeout)
    {
        dds_wait_for_acks(endpoint_.end.handle(), timeout.count());
    }

    /// Whether any reader is there. Any thread may ask.
    bool matched() const
    {
        dds_publication_matched_status_t status;
        return dds_get_publication_matched_status(endpoint_.end.handle(), &status) == DDS_RETCODE_OK &&
               status.current_count > 0;
    }

private:
    Endpoint endpoint_;
};

template <class Message>
class Reader {
public:
    explicit Reader(const Participant& participant, std::string_view partition = {},
                    Repair repair = Repair::AskAgain)
        : endpoint_(make_reader(participant, topic<Message>(), partition, repair)),
          arrival_(dds_create_readcondition(endpoint_.end.handle(), DDS_ANY_STATE), "watch a reader")
    {}

    /// Calls visit(const Message&, const dds_sample_info_t&) for at most `limit` samples and returns how many
    /// there were. The messages are DDS's own memory, valid during the call alone. Without valid_data a
    /// message has its key fields only: the instance's state changed.
    template <class Visitor>
    int take_each(int limit, Visitor&& visit)
    {
        int taken = 0;
        while (taken < limit) {
            const Loan loan(endpoint_.end.handle(), std::min(limit - taken, batch));
            for (int i = 0; i < loan.count; ++i)
                visit(*static_cast<const Message*>(loan.samples[std::size_t(i)]), loan.infos[std::size_t(i)]);
            taken += loan.count;
            if (loan.count == 0)
                break;
        }
        return taken;
    }

    /// Triggered while samples wait to be taken.
    const Entity& arrival() const { return arrival_; }

    /// Whether any writer is there. Any thread may ask.
    bool matched() const
    {
        dds_subscription_matched_status_t status;
        return dds_get_subscription_matched_status(endpoint_.end.handle(), &status) == DDS_RETCODE_OK &&
               status.current_count > 0;
    }

    /// How often a writer of this topic was met whose type or QoS does not fit: another version of SLOD.
    std::uint32_t misfits() const
    {
        dds_requested_incompatible_qos_status_t status;
        const bool known =
            dds_get_requested_incompatible_qos_status(endpoint_.end.handle(), &status) == DDS_RETCODE_OK;
        return known ? status.total_count : 0;
    }

private:
    static constexpr int batch = 16;

    /// Samples lent by DDS, given back at the end of the scope whatever happens.
    struct Loan {
        Loan(dds_entity_t lender, int limit) : reader(lender)
        {
            count = std::max(
                dds_take(reader, samples.data(), infos.data(), std::size_t(limit), std::uint32_t(limit)), 0);
        }
        ~Loan()
        {
            if (count > 0)
                dds_return_loan(reader, samples.data(), count);
        }
        Loan(const Loan&) = delete;
        Loan& operator=(const Loan&) = delete;

        dds_entity_t reader;
        std::array<void*, batch> samples{};
        std::array<dds_sample_info_t, batch> infos;
        int count = 0;
    };

    Endpoint endpoint_;
    Entity arrival_;
};

/// Waits for samples of several readers, or for a call from another thread.
class WaitSet {
public:
    explicit WaitSet(const Participant& participant);

    template <class Message>
    void watch(const Reader<Message>& reader)
    {
        watch(reader.arrival());
    }

    /// Ends the present wait() or, if there is none, the next. Any thread may call it.
    void wake();

    /// Returns when a watched reader has samples, after wake(), or after `timeout`.
    void wait(std::chrono::nanoseconds timeout);

private:
    void watch(const Entity& condition);

    Entity set_;
    Entity woken_;
};

} // namespace slod::wire
