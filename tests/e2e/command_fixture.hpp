#pragma once

#include <array>
#include <chrono>
#include <map>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "common/commander.hpp"
#include "common/connection.hpp"
#include "ctl/command_line.hpp"
#include "e2e/wire_support.hpp"
#include "support/scratch_folder.hpp"

namespace slod {

/// The real server and the real slodctl on a domain of the test's own.
class CommandTest : public testing::Test {
protected:
    using Words = std::vector<std::string>;

    /// A few thousand stars at a rate that lets every frame be published.
    Words server(const Words& more = {}) const
    {
        Words words{SLOD_SERVER,    SLOD_SCENES "/galaxy.toml", "--domain", domain.text(),
                    "--output-dir", scratch.path().string(),    "--set",    "galaxy.particles=2000",
                    "--set",        "server.frame_rate=100",    "--set",    "wire.clusters_rate=1000"};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }

    Words slodctl(Words words) const
    {
        words.insert(words.begin(), SLODCTL);
        words.insert(words.end(), {"--domain", domain.text(), "--timeout", "30"});
        return words;
    }

    /// Runs slodctl to its end; its exit code, and in `answer` what it printed.
    int control(Words words)
    {
        words.emplace_back("--json");
        test::Child child(slodctl(words));
        const int code = child.wait();
        const std::string output = child.output();
        answer =
            output.empty() ? nlohmann::json() : nlohmann::json::parse(output.substr(0, output.find('\n')));
        return code;
    }

    client::Connection connect(const client::Subscription& subscription) const
    {
        return client::Connection(domain.number(), wire::Profile::Loopback, subscription);
    }

    /// Waits until `condition` holds of what the connection knows.
    template <class Condition>
    static bool sees(client::Connection& connection, const Condition& condition)
    {
        return test::eventually([&] {
            connection.wait(std::stop_token(), std::chrono::milliseconds(20));
            return condition();
        });
    }

    std::filesystem::path log() const { return scratch.path() / "input.log"; }

    /// Runs the log again; the exit code says whether the outcome was the same.
    int replay() const
    {
        test::Child again({SLOD_SERVER, "--replay", log().string(), "--free-run", "--no-dds"});
        return again.wait();
    }

    test::FreeDomain domain;
    const ScratchFolder scratch;
    nlohmann::json answer;
};

class Commands : public CommandTest {};

} // namespace slod
