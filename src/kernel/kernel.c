// SPDX-License-Identifier: MIT
// The walk of METHOD_QI through its tree, for one ray (single.h) and for packets of rays
// (packet.h). Compiled once per instruction set; exports one name.
//
// What a ray finds in a piece depends on the ray and the piece alone, never on what was found
// before: so it does not matter in which order pieces are visited, nor with which other rays.
#include "kernel/packet.h"
#include "kernel/single.h"
#include "patch/kernels.h"

#ifndef KERNEL_ISA // the Makefile says it
#define KERNEL_ISA scalar
#endif
#define PASTE(a, b) a##b
#define NAME(isa) PASTE(kernel_, isa)
#define TEXT(a) #a
#define STRING(a) TEXT(a)
extern const Kernel NAME(KERNEL_ISA);
const Kernel NAME(KERNEL_ISA) = {STRING(KERNEL_ISA), walk_query, packet_query};
