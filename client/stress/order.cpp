#include "stress/order.hpp"

namespace slod::stress {

Json json_of(const Order& order)
{
    return {{"reader", order.reader ? Json(std::uint8_t(*order.reader)) : Json()},
            {"index", order.index},
            {"run", order.run},
            {"session", order.session},
            {"domain", order.domain},
            {"profile", order.profile},
            {"seed", order.seed},
            {"region", order.region},
            {"sleep_ms", order.sleep_ms},
            {"rates",
             {order.rates.storm, order.rates.malformed, order.rates.duplicates, order.rates.reordered,
              order.rates.impostors}},
            {"regions", order.regions},
            {"extent", order.extent},
            {"commands", order.commands}};
}

Order order_of(const Json& json)
{
    Order order{.reader = {},
                .index = json.at("index"),
                .run = json.at("run"),
                .session = json.at("session"),
                .domain = json.at("domain"),
                .profile = json.at("profile"),
                .seed = json.at("seed"),
                .region = json.at("region"),
                .sleep_ms = json.at("sleep_ms"),
                .regions = json.at("regions"),
                .extent = json.at("extent"),
                .commands = json.at("commands")};
    if (!json.at("reader").is_null())
        order.reader = Reader(json.at("reader").get<std::uint8_t>());
    const Json& rates = json.at("rates");
    order.rates = {.storm = rates.at(0),
                   .malformed = rates.at(1),
                   .duplicates = rates.at(2),
                   .reordered = rates.at(3),
                   .impostors = rates.at(4)};
    return order;
}

} // namespace slod::stress
