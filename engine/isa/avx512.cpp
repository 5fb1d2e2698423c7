#define PORTRAIT_ISA_NAME avx512
#include "engine/isa/unit.inl"
