// SPDX-License-Identifier: MIT
#define GMSIM_ISA_NAMESPACE avx512
#define GMSIM_VECTOR_BYTES 64
#include "engine/kernel/op_kernels.h"
