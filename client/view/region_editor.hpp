#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <string>

#include "common/commander.hpp"
#include "common/connection.hpp"
#include "view/region_shape.hpp"

namespace slod::view {

/// Lets somebody drag regions by their handles. What is dragged is shown at once; the server is told of the
/// newest pose at most twenty times a second, and of the last one when it is let go; until the server says
/// that it is so, the region is pending. Knows no screen and no network: both are handed in.
class RegionEditor {
public:
    using Clock = std::chrono::steady_clock;

    static constexpr std::chrono::milliseconds command_period{50};

    enum class Phase : unsigned char {
        Settled, ///< as the server has it
        Pending, ///< the server has not said yet that it is so
        Dragged, ///< by the mouse, at this moment
    };

    /// A handle that is under the cursor.
    struct Grip {
        std::string region;
        Handle handle;
    };

    /// The server's regions as it last said.
    void on_regions(const client::Connection::Regions& regions);

    /// The handle at a pixel; of several the nearest one.
    std::optional<Grip> grip_at(const Lens& lens, const Pixel& pixel) const;

    void begin(const Grip& grip, const Pixel& pixel);
    void drag(const Lens& lens, const Pixel& pixel);
    void release();

    /// Ends the drag and puts the region back to where it was when it began.
    void cancel();

    bool dragging() const { return drag_.has_value(); }

    /// A pose to be shown in place of the server's; null when the server's is the one.
    const RegionPose* echo(const std::string& region) const;
    Phase phase(const std::string& region) const;

    /// The next command that is due, once; call sent() with its number.
    std::optional<client::CommandRequest> next_command(Clock::time_point now);
    void sent(const std::string& region, std::uint64_t number);

    /// False when the answer is not to a command of the editor's. A refusal makes the region as the server
    /// has it.
    bool on_answer(std::uint64_t number, const client::CommandAnswer& answer);

    /// Another server: forgets all.
    void reset();

private:
    /// A region whose pose is, or was until a moment ago, ours to say.
    struct Change {
        RegionPose wanted, told;
        std::optional<std::uint64_t> unanswered{}; ///< number of a command
        bool about_to_send = false;                ///< handed out, and without a number yet
        std::uint64_t revision = 0;                ///< that the server answered with
        Clock::time_point last_command{};
    };

    struct Drag {
        Grip grip;
        Pixel from;
        RegionPose before;
    };

    std::optional<RegionPose> shown(const std::string& region) const;
    void forget_settled();

    client::Connection::Regions regions_;
    std::map<std::string, Change> changes_;
    std::optional<Drag> drag_;
};

/// The command that turns one pose of a region into another: nothing when they are the same.
std::optional<client::CommandRequest> command_between(const std::string& region, const RegionPose& from,
                                                      const RegionPose& to);

} // namespace slod::view
