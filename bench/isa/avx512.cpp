#define PORTRAIT_ISA_NAME avx512
#include "bench/isa/unit.inl"
