#pragma once

#include <chrono>
#include <deque>
#include <map>
#include <optional>
#include <string>

#include "common/commander.hpp"
#include "common/view_writer.hpp"
#include "view/region_editor.hpp"

namespace slod::viewer {

/// Sends what the viewer wants of the server, and tells how it was answered.
class Steering {
public:
    using Clock = std::chrono::steady_clock;

    /// `participant` must outlive it; `name` is what frustum regions follow. Throws wire::DdsError.
    Steering(const wire::Participant& participant, std::string name);

    /// The server that is meant from here on. True when it is another one: what was asked of the last is
    /// forgotten.
    bool set_server(const wire::Uuid& session);

    /// No server is heard. What it has not answered is forgotten: nobody wants it done minutes later.
    void lose_server();

    /// Sends a command as soon as it may be sent; without a server, says so in the notice.
    void send(client::CommandRequest request);

    /// From here on there is to be a frustum region that follows the view, or none.
    void follow(bool wanted);
    bool follows() const { return follow_wanted_; }

    /// Takes in answers, sends what is due of the editor and the queue, adds or removes the region that
    /// follows, and sends the view when it changed.
    void poll(const client::Connection::Regions& regions, const client::ClientView& view,
              Clock::time_point now);

    view::RegionEditor editor;

    /// What came of the last command that was refused, or that somebody asked for in a panel; empty: nothing.
    const std::string& notice() const { return notice_; }
    void set_notice(std::string notice) { notice_ = std::move(notice); }

private:
    void take_answers();
    void keep_following(const client::Connection::Regions& regions, const client::ClientView& view,
                        Clock::time_point now);
    void write_view(const client::ClientView& view, Clock::time_point now);

    const wire::Participant& participant_;
    std::string name_;
    wire::Uuid session_{};
    std::optional<client::Commander> commander_;    ///< of the present server: one that is gone never answers
    std::optional<client::ViewWriter> view_writer_; ///< likewise
    std::deque<client::CommandRequest> queue_;
    std::map<std::uint64_t, std::string> asked_; ///< what a command in flight asks for, by number
    std::string notice_;
    bool heard_ = false;         ///< the server is
    bool follow_wanted_ = false; ///< a region that follows the view
    Clock::time_point asked_to_follow_{};
    std::optional<client::ClientView> written_;
    Clock::time_point written_at_{};
};

} // namespace slod::viewer
