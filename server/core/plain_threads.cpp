#include "core/plain_threads.hpp"

#include "core/assert.hpp"

namespace slod {

PlainThreads& PlainThreads::instance()
{
    static PlainThreads threads;
    return threads;
}

void PlainThreads::resize(std::size_t size)
{
    SLOD_ASSERT(size > 0);
    size_ = size;
    while (waiting_.size() + 1 < size)
        waiting_.emplace_back([this](const std::stop_token& stop) { help(stop); });
}

PlainThreads::Opened::Opened(PlainThreads& threads, Loop& loop) : threads_(threads), loop_(loop)
{
    const std::lock_guard lock(threads_.mutex_);
    loop_.opened_before = threads_.last_opened_;
    threads_.last_opened_ = &loop_;
    threads_.opened_.notify_all();
}

PlainThreads::Opened::~Opened()
{
    std::unique_lock lock(threads_.mutex_);
    threads_.withdraw(loop_);
    threads_.left_.wait(lock, [&] { return loop_.helpers == 0; });
}

void PlainThreads::help(const std::stop_token& stop)
{
    std::unique_lock lock(mutex_);
    while (opened_.wait(lock, stop, [&] { return last_opened_ != nullptr; })) {
        Loop& loop = *last_opened_;
        ++loop.helpers;
        if (--loop.helpers_wanted == 0)
            withdraw(loop);
        lock.unlock();
        loop.drain(loop.context);
        lock.lock();
        if (--loop.helpers == 0)
            left_.notify_all();
    }
}

void PlainThreads::withdraw(const Loop& loop)
{
    for (Loop** link = &last_opened_; *link != nullptr; link = &(*link)->opened_before)
        if (*link == &loop) {
            *link = loop.opened_before;
            return;
        }
}

} // namespace slod
