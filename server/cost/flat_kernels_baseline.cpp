#define SLOD_ISA baseline

namespace slod::cost::SLOD_ISA {
namespace {
constexpr const char* name = "baseline";
constexpr unsigned register_bytes = 16;
} // namespace
} // namespace slod::cost::SLOD_ISA

#include "cost/flat_kernels.inl"
