#pragma once

// toml++ 3.3 asserts what a malformed file can break ("[=x]", "[[[x]]]", "1979-05-27T:7:00"), each time just
// before it finds the same fault itself and reports it with its line. Without its assertions a typing error
// is an error message; with them it would end the program.
#define TOML_ASSERT(claim) static_cast<void>(0)
#include <toml++/toml.h>
