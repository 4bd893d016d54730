#define SLOD_ISA baseline

namespace slod::simd::SLOD_ISA {
namespace {
constexpr const char* name = "baseline";
constexpr unsigned register_bytes = 16;
} // namespace
} // namespace slod::simd::SLOD_ISA

#include "simd/kernel_table.inl"
