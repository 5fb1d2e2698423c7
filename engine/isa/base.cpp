#define PORTRAIT_ISA_NAME base
#include "engine/isa/unit.inl"
