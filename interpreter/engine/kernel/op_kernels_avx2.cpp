// SPDX-License-Identifier: MIT
#define GMSIM_ISA_NAMESPACE avx2
#define GMSIM_VECTOR_BYTES 32
#include "engine/kernel/op_kernels.h"
