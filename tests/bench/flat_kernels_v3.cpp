#define SLOD_ISA v3

namespace slod::bench::SLOD_ISA {
namespace {
constexpr const char* name = "v3";
constexpr unsigned register_bytes = 32;
} // namespace
} // namespace slod::bench::SLOD_ISA

#include "bench/flat_kernels.inl"
