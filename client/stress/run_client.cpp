#include "stress/clients.hpp"

namespace slod::stress {

int run_client(const char* order, const std::stop_token& stop)
{
    Tether tether;
    const Order mine = order_of(Json::parse(order));
    const Json result =
        mine.reader ? json_of(subscribe(mine, tether, stop)) : json_of(command(mine, tether, stop));
    tether.report(result.dump());
    return 0;
}

} // namespace slod::stress
