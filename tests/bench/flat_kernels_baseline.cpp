#define SLOD_ISA baseline

namespace slod::bench::SLOD_ISA {
namespace {
constexpr const char* name = "baseline";
constexpr unsigned register_bytes = 16;
} // namespace
} // namespace slod::bench::SLOD_ISA

#include "bench/flat_kernels.inl"
