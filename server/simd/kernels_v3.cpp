#define SLOD_ISA v3

namespace slod::simd::SLOD_ISA {
namespace {
constexpr const char* name = "v3";
constexpr unsigned register_bytes = 32;
} // namespace
} // namespace slod::simd::SLOD_ISA

#include "simd/kernel_table.inl"
