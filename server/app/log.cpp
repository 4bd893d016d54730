#include "app/log.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <mutex>
#include <sys/ioctl.h>
#include <unistd.h>
#include <utility>

#include <spdlog/async.h>
#include <spdlog/cfg/env.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>

namespace slod {
namespace {

constexpr std::size_t queue_length = 8192;
constexpr const char* erase_line = "\r\033[K";

std::size_t terminal_width()
{
    winsize size{};
    return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

} // namespace

/// Writes to stderr and keeps one line below what it has written.
class TerminalSink : public spdlog::sinks::base_sink<std::mutex> {
public:
    void show(std::string status)
    {
        const std::lock_guard lock(mutex_);
        if (status.empty() && status_.empty())
            return;
        status_ = std::move(status);
        std::fputs(erase_line, stderr);
        draw_status();
    }

protected:
    void sink_it_(const spdlog::details::log_msg& message) override
    {
        spdlog::memory_buf_t text;
        formatter_->format(message, text);
        if (!status_.empty())
            std::fputs(erase_line, stderr);
        std::fwrite(text.data(), 1, text.size(), stderr);
        draw_status();
    }

    void flush_() override { std::fflush(stderr); }

private:
    void draw_status()
    {
        // One column is left free: a terminal that has just filled its last one may wrap.
        std::fwrite(status_.data(), 1, std::min(status_.size(), terminal_width() - 1), stderr);
        std::fflush(stderr);
    }

    std::string status_;
};

Logging::Logging() : on_terminal_(isatty(STDERR_FILENO) == 1), sink_(std::make_shared<TerminalSink>())
{
    spdlog::init_thread_pool(queue_length, 1);
    auto logger = std::make_shared<spdlog::async_logger>("slod-server", sink_, spdlog::thread_pool(),
                                                         spdlog::async_overflow_policy::overrun_oldest);
    logger->set_pattern("%Y-%m-%dT%H:%M:%S.%e %l %v");
    spdlog::set_default_logger(std::move(logger));
    spdlog::cfg::load_env_levels();
}

Logging::~Logging()
{
    show_status({});
    spdlog::shutdown();
}

void Logging::show_status(std::string line)
{
    if (on_terminal_)
        sink_->show(std::move(line));
}

} // namespace slod
