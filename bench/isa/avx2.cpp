#define PORTRAIT_ISA_NAME avx2
#include "bench/isa/unit.inl"
