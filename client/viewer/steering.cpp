#include "viewer/steering.hpp"

#include <utility>

namespace slod::viewer {

namespace {

/// Outlasts a hiccup of the network; the view, which is sent every second, renews it.
constexpr double view_lease_s = 10;

/// As near to the viewer's name as a region's may be: up to 32 of a-z, 0-9, _ and -.
std::string name_of_region(const std::string& viewer)
{
    constexpr std::size_t longest = 32;
    std::string name = viewer.substr(0, longest);
    for (char& letter : name) {
        const bool fits =
            (letter >= 'a' && letter <= 'z') || (letter >= '0' && letter <= '9') || letter == '_';
        letter = fits ? letter : '-';
    }
    return name;
}

} // namespace

Steering::Steering(const wire::Participant& participant, std::string name)
    : participant_(participant), name_(std::move(name))
{}

bool Steering::set_server(const wire::Uuid& session)
{
    heard_ = true;
    if (session == session_)
        return false;
    session_ = session;
    view_writer_.emplace(participant_, commander_.emplace(participant_).client(), name_);
    asked_.clear();
    editor.reset();
    queue_.clear();
    written_.reset();
    return true;
}

void Steering::lose_server()
{
    if (!std::exchange(heard_, false))
        return;
    commander_->forget();
    asked_.clear();
    editor.reset();
    queue_.clear();
}

void Steering::send(client::CommandRequest request)
{
    if (std::string wrong = client::problem(request); !wrong.empty())
        notice_ = std::move(wrong);
    else if (!heard_)
        notice_ = "there is no server to tell";
    else
        queue_.push_back(std::move(request));
}

void Steering::follow(bool wanted)
{
    follow_wanted_ = wanted;
    asked_to_follow_ = {};
}

/// Adds the region that follows the view, or removes it, until the server has it so. One of its name that is
/// not ours stays as it is.
void Steering::keep_following(const client::Connection::Regions& regions, const client::ClientView& view,
                              Clock::time_point now)
{
    constexpr std::chrono::seconds patience{2};
    const std::string name = name_of_region(name_);
    const auto known = regions.find(name);
    const bool there = known != regions.end() && known->second.owner == commander_->client();
    if (there == follow_wanted_ || now - asked_to_follow_ < patience)
        return;
    asked_to_follow_ = now;
    if (follow_wanted_)
        send({.kind = "add_roi",
              .region = name,
              .lease_s = view_lease_s,
              .centre = view.eye,
              .settings = {{"shape", "frustum"}, {"follows", name_}}});
    else
        send({.kind = "remove_roi", .region = name});
    written_.reset(); // so that the region gets the view at once
}

void Steering::poll(const client::Connection::Regions& regions, const client::ClientView& view,
                    Clock::time_point now)
{
    if (!heard_)
        return;
    commander_->poll();
    take_answers();
    keep_following(regions, view, now);
    while (!queue_.empty() && commander_->waiting() < client::Commander::max_waiting) {
        asked_[commander_->send(queue_.front(), session_)] =
            queue_.front().kind + " " + queue_.front().region;
        queue_.pop_front();
    }
    while (commander_->waiting() < client::Commander::max_waiting) {
        const auto command = editor.next_command(now);
        if (!command)
            break;
        editor.sent(command->region, commander_->send(*command, session_));
    }
    write_view(view, now);
}

void Steering::take_answers()
{
    for (const auto& [number, answer] : commander_->take_answers()) {
        const bool edited = editor.on_answer(number, answer);
        const auto asked = asked_.find(number);
        if (answer.result == slod_v1_RESULT_REGION_EXISTS && asked != asked_.end() &&
            asked->second == "add_roi " + name_of_region(name_))
            follow_wanted_ = false; // somebody else's
        if (!answer.applied())
            notice_ = std::string(client::word_of(answer.result)) + ": " + answer.text;
        else if (!edited && asked != asked_.end())
            notice_ = asked->second + ": applied from frame " + std::to_string(answer.applied_frame);
        if (asked != asked_.end())
            asked_.erase(asked);
    }
}

/// On change, and every second for servers and regions that came meanwhile.
void Steering::write_view(const client::ClientView& view, Clock::time_point now)
{
    constexpr std::chrono::milliseconds shortest{50}, longest{1000};
    const auto age = now - written_at_;
    if (age < shortest || (written_ == view && age < longest))
        return;
    if (view_writer_->write(view, session_))
        written_ = view;
    written_at_ = now;
}

} // namespace slod::viewer
