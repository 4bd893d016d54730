#define SLOD_ISA v4

namespace slod::simd::SLOD_ISA {
namespace {
constexpr const char* name = "v4";
constexpr unsigned register_bytes = 64;
} // namespace
} // namespace slod::simd::SLOD_ISA

#include "simd/kernel_table.inl"
