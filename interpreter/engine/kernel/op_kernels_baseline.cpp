// SPDX-License-Identifier: MIT
#define GMSIM_ISA_NAMESPACE baseline
#define GMSIM_VECTOR_BYTES 16
#include "engine/kernel/op_kernels.h"
