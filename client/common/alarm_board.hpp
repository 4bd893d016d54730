#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "idl/dds.hpp"

namespace slod::client {

/// The word of a severity: "info", "warning", "error".
std::string_view word_of(slod_v1_Severity severity);

/// A server's present alarms. Call it from one thread.
class AlarmBoard {
public:
    /// `participant` must outlive the board. Throws wire::DdsError.
    explicit AlarmBoard(const wire::Participant& participant) : reader_(participant) {}

    /// Takes in what has arrived.
    void poll();

    struct Entry {
        slod_v1_Severity severity;
        std::string text;
    };

    /// By session and name.
    using Entries = std::map<std::pair<wire::Uuid, std::string>, Entry>;
    const Entries& entries() const { return entries_; }

private:
    wire::Reader<wire::Alarm> reader_;
    Entries entries_;
};

} // namespace slod::client
