#define SLOD_ISA v4

namespace slod::bench::SLOD_ISA {
namespace {
constexpr const char* name = "v4";
constexpr unsigned register_bytes = 64;
} // namespace
} // namespace slod::bench::SLOD_ISA

#include "bench/flat_kernels.inl"
