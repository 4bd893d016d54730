#include "common/alarm_board.hpp"

namespace slod::client {

std::string_view word_of(slod_v1_Severity severity)
{
    switch (severity) {
    case slod_v1_SEVERITY_INFO:
        return "info";
    case slod_v1_SEVERITY_WARNING:
        return "warning";
    case slod_v1_SEVERITY_ERROR:
        return "error";
    default:
        return "unknown";
    }
}

void AlarmBoard::poll()
{
    constexpr int alarms_per_poll = 64;
    reader_.take_each(alarms_per_poll, [this](const wire::Alarm& alarm, const dds_sample_info_t& info) {
        const std::pair key{wire::uuid_of(alarm.session), std::string(alarm.name)};
        if (info.valid_data)
            entries_[key] = {.severity = alarm.severity, .text = alarm.text};
        if (info.instance_state != DDS_IST_ALIVE)
            entries_.erase(key);
    });
}

} // namespace slod::client
