#include "app/publish_effects.hpp"

#include <utility>

namespace slod {

PublishedEffects::PublishedEffects(const wire::Participant& participant, const wire::Uuid& session,
                                   Outlet& outlet)
    : session_(session), outlet_(outlet), writer_(participant)
{}

void PublishedEffects::update(const std::shared_ptr<const EffectReport>& report)
{
    if (std::exchange(last_, report) == report || !report)
        return;
    ++serial_;
    for (const EffectReport::Entry& entry : report->effects) {
        wire::EffectStats message{};
        wire::set(message.session, session_);
        wire::set(message.effect, entry.effect.name);
        wire::set(message.state, entry.effect.state());
        wire::set(message.acts_on_clusters, entry.effect.acts_on_clusters);
        message.serial = serial_;
        message.frame = report->frame;
        message.clusters = entry.work.clusters;
        message.particles = entry.work.particles;
        message.straddling = entry.work.straddling;
        message.ms = entry.work.ms;
        outlet_.send(writer_, message);
    }
}

} // namespace slod
