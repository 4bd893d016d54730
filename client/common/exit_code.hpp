#pragma once

namespace slod::client {

/// What a client tells its caller; the codes of BSD's sysexits.h where they fit.
enum class ExitCode : int {
    Success = 0,
    Failure = 1,          ///< network or screen not usable; of slod-stress: not all that must be so was
    Usage = 2,            ///< the command line is wrong, which is seen without a server
    InvalidArgument = 65, ///< the server refuses what was asked of it
    NotFound = 66,        ///< a name that was asked for does not exist
    NoServer = 69,
    TimedOut = 75,     ///< a server is there, but the answer did not come in time
    NotPermitted = 77, ///< the domain's security forbids it
};

} // namespace slod::client
