#include "app/publish_alarms.hpp"

#include <algorithm>

namespace slod {

wire::Alarm PublishedAlarms::message_of(const Alarm& alarm) const
{
    wire::Alarm message{};
    wire::set(message.session, session_);
    wire::set(message.name, alarm.name);
    message.severity =
        alarm.severity == AlarmSeverity::Error ? slod_v1_SEVERITY_ERROR : slod_v1_SEVERITY_WARNING;
    message.first_frame = alarm.first_frame;
    message.last_frame = alarm.last_frame;
    message.occurrences = alarm.occurrences;
    wire::set_sentence(message.text, alarm.text);
    return message;
}

void PublishedAlarms::update(const std::vector<Alarm>& present)
{
    std::erase_if(told_, [&](const auto& told) {
        const auto is_told = [&](const Alarm& alarm) { return alarm.name == told.first; };
        if (std::any_of(present.begin(), present.end(), is_told))
            return false;
        outlet_.forget(writer_, message_of(told.second));
        return true;
    });
    for (const Alarm& alarm : present) {
        const auto [told, is_new] = told_.try_emplace(std::string(alarm.name), alarm);
        if (!is_new && told->second == alarm)
            continue;
        told->second = alarm;
        outlet_.send(writer_, message_of(alarm));
    }
}

} // namespace slod
