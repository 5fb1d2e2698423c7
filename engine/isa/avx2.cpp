#define PORTRAIT_ISA_NAME avx2
#include "engine/isa/unit.inl"
