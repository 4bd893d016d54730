#include "stress/rough_conduct.hpp"

#include <algorithm>

#include "stress/storm.hpp"

namespace slod::stress {

namespace {

/// A server remembers so many answers of a client.
constexpr std::uint64_t remembered_answers = 64;

Draft removal(const std::string& region)
{
    return {.kind = "remove_roi", .region = region};
}

} // namespace

RoughConduct::RoughConduct(const wire::Participant& participant, const Order& order)
    : order_(order), random_(order.seed + 1), box_(order.run + std::to_string(order.index) + "-box"),
      misuses_(misuses(box_)), next_misuse_(order.index % misuses_.size()), raw_(participant, order.session)
{}

void RoughConduct::add_region()
{
    raw_.send(add_box(box_, {}, order_.extent / 10, 0), {"applied"});
}

double RoughConduct::uniform(double least, double most)
{
    return std::uniform_real_distribution(least, most)(random_);
}

Draft RoughConduct::move()
{
    const double extent = order_.extent;
    return {.kind = "move_roi",
            .region = box_,
            .centre = {uniform(-extent, extent), uniform(-extent, extent), uniform(-extent, extent)}};
}

/// One after the other, so that every way of misuse has its turn.
void RoughConduct::send_malformed()
{
    const Misuse& misuse = misuses_[next_misuse_];
    next_misuse_ = (next_misuse_ + 1) % misuses_.size();
    raw_.send(misuse.draft, {std::string(misuse.right_result)});
    ++kinds_["malformed"];
}

/// With the same content, or as often with another that would remove the region.
void RoughConduct::send_duplicate()
{
    const Draft draft = move();
    const std::uint64_t number = raw_.send(draft, {"applied"});
    const bool same = uniform(0, 1) < 0.5;
    raw_.send_again(number, same ? draft : removal(box_));
    ++kinds_[same ? "duplicate" : "duplicate with other content"];
}

/// The later number first: both are new, and apply as they come. Or, once nothing is under way, a number that
/// was answered long ago, and maybe forgotten.
void RoughConduct::send_reordered()
{
    const bool old = raw_.book().waiting() == 0 && uniform(0, 1) < 0.5;
    if (old) {
        const std::uint64_t back = 1 + std::uint64_t(uniform(0, 3 * remembered_answers));
        raw_.send_again(raw_.last_number() - std::min(back, raw_.last_number()), removal(box_));
        ++kinds_["old number"];
    } else {
        const std::uint64_t next = raw_.last_number() + 1;
        raw_.send_numbered(next + 1, move(), {"applied"});
        raw_.send_numbered(next, move(), {"applied"});
        ++kinds_["numbers out of order"];
    }
}

/// About a region that another client owns: under the own name, which is refused, or under the owner's with
/// a number that it has used, which is answered as then.
void RoughConduct::send_as_impostor(const client::Connection::Regions& regions)
{
    std::vector<const client::RegionInfo*> owned;
    for (const auto& [name, region] : regions)
        if (others_.contains(region.owner) && name.starts_with(order_.run))
            owned.push_back(&region);
    if (owned.empty())
        return;
    const auto chosen = std::uniform_int_distribution<std::size_t>(0, owned.size() - 1)(random_);
    const client::RegionInfo& victim = *owned[chosen];
    if (uniform(0, 1) < 0.5) {
        raw_.send(removal(victim.region), {"not_owner", "unknown_region"});
        ++kinds_["another's region"];
    } else {
        raw_.send_as(victim.owner, others_.at(victim.owner), removal(victim.region));
        ++kinds_["another's name"];
    }
}

void RoughConduct::on_answer(const wire::CommandReply& reply)
{
    const wire::Uuid client = wire::uuid_of(reply.client);
    if (client != raw_.client()) {
        std::uint64_t& last = others_[client];
        last = std::max<std::uint64_t>(last, reply.request);
        return;
    }
    const Reply answer = reply_of(reply);
    if (const Draft* const draft = raw_.on_answer(reply.request, answer))
        model_.on_answer(*draft, answer);
}

void RoughConduct::clean_up()
{
    if (model_.contains(box_))
        raw_.send(removal(box_), {"applied"});
}

} // namespace slod::stress
