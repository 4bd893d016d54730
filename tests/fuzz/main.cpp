#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "core/parallel.hpp"
#include "fuzz/inputs.hpp"

/// Of libFuzzer, which calls it with one input after another. SLOD_FUZZ_INPUT is one of fuzz/inputs.hpp. On
/// one thread, so that what was covered does not depend on who took which task.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    slod::ThreadTeam(1).run([&] {
        const slod::test::Dealt dealt =
            slod::test::SLOD_FUZZ_INPUT({reinterpret_cast<const char*>(data), size});
        if (!dealt.wrong.empty()) {
            std::fprintf(stderr, "%s\n", dealt.wrong.c_str());
            std::abort();
        }
    });
    return 0;
}
