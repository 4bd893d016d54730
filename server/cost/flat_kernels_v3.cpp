#define SLOD_ISA v3

namespace slod::cost::SLOD_ISA {
namespace {
constexpr const char* name = "v3";
constexpr unsigned register_bytes = 32;
} // namespace
} // namespace slod::cost::SLOD_ISA

#include "cost/flat_kernels.inl"
