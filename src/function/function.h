// SPDX-License-Identifier: MIT
// Runs the scene's functions: called for every pixel, so without memory of its own, without
// messages and without an error path. The functions must have passed scene_validate() (or come from
// the converter, which makes only such), and noise_prepare() must have run.
//
// Who hands out values of pigments lies above this room: the texture room, through FunctionHooks.
#ifndef FUNCTION_FUNCTION_H
#define FUNCTION_FUNCTION_H

#include "model/function.h"

#include <stdbool.h>
#include <stdint.h>

// What a pigment or pattern function gives. world: as in FunctionPool. Both must be safe to call
// from any thread; they may run functions again.
typedef struct {
    void (*pigment)(const void *world, uint32_t pigment, Vec3 p, double color[FUNCTION_WIDTH]);
    double (*pattern)(const void *world, uint32_t pigment, Vec3 p);
} FunctionHooks;

typedef struct {
    const Function *functions; // scene->functions
    int noise_generator;       // scene->settings.noise_generator
    const FunctionHooks *hooks;
    const void *world; // for the hooks
} FunctionPool;

// Rounds of loops (sum, prod, octaves) and calls in one evaluation: without a limit a scene could
// keep a pixel busy for ever. About a second, and less where all is slower.
#ifdef HOSTILE
#define FUNCTION_BUDGET UINT64_C(1000000)
#else
#define FUNCTION_BUDGET UINT64_C(50000000)
#endif

// The value of a formula or pattern, for `parameters` arguments. An evaluation that runs out of its
// budget is NaN.
double function_value(const FunctionPool *pool, uint32_t index, const double *arguments);
// The same, of any kind, into the first function_width() components; returns how many they are.
// *budget is used up; at 0 the evaluation was stopped.
int function_vector(const FunctionPool *pool, uint32_t index, const double *arguments,
                    double out[FUNCTION_WIDTH], uint64_t *budget);

// spline.c: all components at t, with POV-Ray's bits; kind: of the call.
void spline_value(const Spline *spline, SplineKind kind, double t, double out[FUNCTION_WIDTH]);
// The second derivatives of the keys for SPLINE_NATURAL; work has 2 * key_count numbers.
void spline_prepare(Spline *spline, double *work);

#endif
