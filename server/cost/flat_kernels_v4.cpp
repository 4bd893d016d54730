#define SLOD_ISA v4

namespace slod::cost::SLOD_ISA {
namespace {
constexpr const char* name = "v4";
constexpr unsigned register_bytes = 64;
} // namespace
} // namespace slod::cost::SLOD_ISA

#include "cost/flat_kernels.inl"
