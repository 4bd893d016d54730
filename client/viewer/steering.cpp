#include "viewer/steering.hpp"

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
    if (session == session_)
        return false;
    session_ = session;
    view_writer_.emplace(participant_, commander_.emplace(participant_).client(), name_);
    asked_.clear();
    editor.reset();
    queue_.clear();
    follows_ = false;
    written_.reset();
    return true;
}

void Steering::send(client::CommandRequest request)
{
    if (std::string wrong = client::problem(request); !wrong.empty())
        notice_ = std::move(wrong);
    else if (!commander_)
        notice_ = "there is no server to tell";
    else
        queue_.push_back(std::move(request));
}

void Steering::follow(bool wanted, const client::ClientView& view)
{
    const std::string region = name_of_region(name_);
    if (wanted && !follows_)
        send({.kind = "add_roi",
              .region = region,
              .lease_s = view_lease_s,
              .centre = view.eye,
              .settings = {{"shape", "frustum"}, {"follows", name_}}});
    if (!wanted && follows_)
        send({.kind = "remove_roi", .region = region});
    follows_ = wanted;
    written_.reset(); // so that the region gets the view at once
}

void Steering::poll(const client::ClientView& view, Clock::time_point now)
{
    if (!commander_)
        return;
    commander_->poll();
    take_answers();
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
