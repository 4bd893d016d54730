#include <exception>
#include <signal.h>
#include <string_view>
#include <variant>

#include "idl/dds.hpp"
#include "idl/stop_on_signal.hpp"
#include "stress/clients.hpp"
#include "stress/options.hpp"
#include "stress/run.hpp"

int main(int argc, char** argv)
try {
    const slod::StopOnSignal signals; // first: every later thread inherits the blocked signals
    signal(SIGPIPE, SIG_IGN);         // a client that died is seen at its result
    if (argc == 3 && argv[1] == std::string_view("client"))
        return slod::stress::run_client(argv[2], signals.token());
    const auto parsed = slod::stress::parse_options(argc, argv);
    if (const auto* code = std::get_if<slod::stress::ExitCode>(&parsed))
        return int(*code);
    return int(slod::stress::run(std::get<slod::stress::Options>(parsed), signals.token()));
} catch (const slod::wire::DdsError& error) {
    slod::stress::complain(error.what());
    return int(error.not_permitted() ? slod::stress::ExitCode::NotPermitted
                                     : slod::stress::ExitCode::Failure);
} catch (const std::exception& error) {
    slod::stress::complain(error.what());
    return int(slod::stress::ExitCode::Failure);
}
