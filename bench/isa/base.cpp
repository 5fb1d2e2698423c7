#define PORTRAIT_ISA_NAME base
#include "bench/isa/unit.inl"
